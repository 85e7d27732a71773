import { existsSync } from 'node:fs';
import { mkdir } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import { chromium, type Browser, type BrowserContext, type Page } from 'playwright-core';

/** Debian's browser; another one by the environment. */
const kChromium = process.env['VIGIL_CHROMIUM'] ?? '/usr/bin/chromium';
const kQuiet = [
  '--no-sandbox',
  '--disable-quic',
  '--no-first-run',
  '--disable-background-networking',
  '--disable-component-update',
  '--disable-sync',
];

/** Pictures for people to look at; not part of the repository. */
export const kArtefacts = fileURLToPath(new URL('../artefacts', import.meta.url));

export async function openBrowser(): Promise<Browser> {
  if (!existsSync(kChromium)) throw new Error(`no browser at ${kChromium}: install chromium, or set VIGIL_CHROMIUM`);
  return chromium.launch({
    executablePath: kChromium,
    // WebGL2 without a GPU.
    args: [...kQuiet, '--enable-unsafe-swiftshader'],
  });
}

export interface View {
  readonly context: BrowserContext;
  readonly page: Page;
  /** What the page complained about: a test that ends with any of it has failed. */
  readonly complaints: string[];
}

export async function openView(
  browser: Browser,
  options: {
    theme?: 'dark' | 'light';
    width?: number;
    height?: number;
    hasTouch?: boolean;
    ignoreHTTPSErrors?: boolean;
  } = {},
): Promise<View> {
  const context = await browser.newContext({
    viewport: { width: options.width ?? 1440, height: options.height ?? 900 },
    hasTouch: options.hasTouch ?? false,
    ignoreHTTPSErrors: options.ignoreHTTPSErrors ?? false,
  });
  await context.addInitScript(
    (theme) => localStorage.setItem('vigil.theme', localStorage.getItem('vigil.theme') ?? theme),
    options.theme ?? 'dark',
  );
  const page = await context.newPage();
  const complaints: string[] = [];
  page.on('pageerror', (error) => complaints.push(String(error)));
  page.on('console', (message) => {
    // A browser reports every failed connection attempt; those are what some tests are about.
    const isExpected = /WebSocket connection to .* failed|ERR_CONNECTION_REFUSED/.test(message.text());
    if (message.type() === 'error' && !isExpected) complaints.push(message.text());
  });
  return { context, page, complaints };
}

export async function keepPicture(page: Page, name: string): Promise<void> {
  await mkdir(kArtefacts, { recursive: true });
  await page.screenshot({ path: `${kArtefacts}/${name}.png` });
}
