import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import type { Page } from 'playwright-core';

const kAxe = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');
const kRules = ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice'];

interface Violation {
  readonly id: string;
  readonly help: string;
  readonly nodes: { readonly html: string; readonly failureSummary?: string }[];
}

/** What axe finds on the page as it is, one line each; nothing is excused. */
export async function violationsOf(page: Page): Promise<string[]> {
  await page.evaluate(kAxe);
  const found = await page.evaluate(async (rules) => {
    const axe = (
      globalThis as unknown as {
        axe: { run(context: Document, options: unknown): Promise<{ violations: Violation[] }> };
      }
    ).axe;
    return (await axe.run(document, { runOnly: { type: 'tag', values: rules } })).violations;
  }, kRules);
  return found.flatMap((violation) =>
    violation.nodes.map(
      (node) => `${violation.id}: ${violation.help}: ${node.html.slice(0, 160)} ${node.failureSummary ?? ''}`,
    ),
  );
}
