import { execFile } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { keepPicture, openBrowser, openView, type View } from './chromium';
import { kProgram, replay, serve, type Program } from './program';

/** Plots keep their past: over a reload of the page, and over jumps in a recording. */

let browser: Browser;
let folder: string;
let program: Program;
let view: View;
let page: Page;

beforeAll(async () => {
  [browser, folder] = [await openBrowser(), await mkdtemp(join(tmpdir(), 'vigil-plots-'))];
  const mission = new URL('../../missions/paper.yaml', import.meta.url).pathname;
  await promisify(execFile)(kProgram, ['simulate', mission, '--out', join(folder, 'flight'), '--seconds', '30']);
});
afterAll(async () => {
  await browser.close();
  await rm(folder, { recursive: true });
});
afterEach(async () => {
  await view.context.close();
  await program.stop();
  expect(view.complaints).toEqual([]);
});

async function look(shown: Program, badge: string): Promise<void> {
  program = shown;
  view = await openView(browser);
  page = view.page;
  await page.goto(program.address);
  await page.getByTestId('badge').getByText(badge).waitFor();
}

const kPlots = ['Metric', 'Worst age', 'Distances', 'Inputs |u|'] as const;
const plot = (title: string) => page.getByRole('img', { name: title });

/** From when to when each plot says that it shows the flight, in seconds. */
async function ranges(): Promise<string[]> {
  const labels = await Promise.all(kPlots.map(async (title) => (await plot(title).getAttribute('aria-label')) ?? ''));
  return labels.map((label) => /from (\d+:\d\d to \d+:\d\d)/.exec(label)?.[1] ?? 'nothing');
}

/** In how many of ten upright strips of a plot's frame, from left to right, something of these colours is drawn. */
const strips = (title: string): Promise<number> =>
  plot(title)
    .locator('canvas')
    .evaluate((canvas: HTMLCanvasElement) => {
      const { data, width, height } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
      const drawn = new Set<number>();
      const [left, right] = [50 * devicePixelRatio, width - 10 * devicePixelRatio];
      for (let y = 0; y < height; y++)
        for (let x = Math.ceil(left); x < right; x++) {
          const [r, g, b, a] = data.slice(4 * (y * width + x), 4 * (y * width + x) + 4);
          // Grid and words are grey; curves are not.
          const isColoured = Math.max(r!, g!, b!) - Math.min(r!, g!, b!) > 60;
          if (a! > 200 && isColoured) drawn.add(Math.floor((10 * (x - left)) / (right - left)));
        }
      return drawn.size;
    });

const all = (range: string): string[] => kPlots.map(() => range);

describe('plots of a recording', () => {
  const seek = (timeS: number) => page.getByRole('slider', { name: 'Moment of the recording' }).fill(String(timeS));

  it('show the flight up to the moment that is shown, also after a jump and a reload', async () => {
    await look(await replay(join(folder, 'flight')), 'REPLAY');
    await seek(25);
    await expect.poll(ranges).toEqual(all('0:00 to 0:25'));
    for (const title of kPlots) await expect.poll(() => strips(title)).toBeGreaterThanOrEqual(9);
    await keepPicture(page, 'plots_jumped');
    await seek(10);
    await expect.poll(ranges).toEqual(all('0:00 to 0:10'));
    await seek(20);
    await expect.poll(ranges).toEqual(all('0:00 to 0:20'));
    await page.reload();
    await expect.poll(ranges).toEqual(all('0:00 to 0:20'));
    for (const title of kPlots) await expect.poll(() => strips(title)).toBeGreaterThanOrEqual(9);
  });
});

describe('plots of a flight', () => {
  const wentOnTo = async (): Promise<number> => {
    const [minutes, seconds] = (await ranges())[0]!.split(' to ')[1]!.split(':').map(Number);
    return 60 * minutes! + seconds!;
  };

  it('show it from its beginning, also to who comes later, or its last two minutes', async () => {
    await look(await serve('paper.yaml'), 'SIM');
    const faster = { type: 'set_speed', id: 1, factor: 20 };
    const headers = { 'Content-Type': 'application/json' };
    await fetch(`${program.address}/api/commands`, { method: 'POST', headers, body: JSON.stringify(faster) });
    await expect.poll(wentOnTo, { timeout: 30_000 }).toBeGreaterThan(150);
    await page.reload();
    await expect.poll(async () => (await ranges())[0]).toMatch(/^0:00 to/);
    expect(await wentOnTo()).toBeGreaterThan(150);
    for (const title of kPlots) await expect.poll(() => strips(title)).toBeGreaterThanOrEqual(9);
    await keepPicture(page, 'plots_reloaded');
    await page.getByRole('button', { name: 'Plots: All' }).click();
    await expect.poll(async () => (await ranges())[0]).not.toMatch(/^0:0/);
    await page.getByRole('button', { name: 'Plots: 2 min' }).click();
    await expect.poll(async () => (await ranges())[0]).toMatch(/^0:00 to/);
  });
});
