import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser } from 'playwright-core';
import { openBrowser, openView } from './chromium';
import { serve } from './program';

/**
 * How many pictures a second the map draws while the real program flies so many drones, and what one picture costs the
 * page's own thread: npm run frame-rates [DRONES ...]. Chromium renders in software here, on the cores that also fly the
 * swarm: the rates say little of a GPU, the cost on the page's thread is the same with one.
 */
const kSeconds = 8;

const missionOf = (drones: number): string => `
format: 1
name: crowd of ${drones}
field: {size_m: [${Math.ceil(Math.sqrt(drones)) + 2}, ${Math.ceil(Math.sqrt(drones)) + 2}]}
targets: {uniform_floor: 1}
drone_grid: {count: ${drones}}
control: {speed_limit_m_s: 0.3, rate_hz: 10, controller: gradient}
safety: {separation_m: 0.2, wall_distance_m: 0.17}
`;

interface Counts {
  pictures: number;
  costMs: number;
  at: number;
}

/** Runs in the page before its own script: counts the display frames in which the map drew, and how long that took. */
function countPictures(): void {
  const counts = { pictures: 0, costMs: 0, at: 0 };
  Object.assign(window, { counts });
  let draws = 0;
  const draw = WebGL2RenderingContext.prototype.drawArraysInstanced;
  WebGL2RenderingContext.prototype.drawArraysInstanced = function (...args) {
    draws++;
    draw.apply(this, args);
  };
  const next = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (call) =>
    next((time) => {
      const [drawsBefore, started] = [draws, performance.now()];
      call(time);
      if (draws === drawsBefore) return;
      counts.pictures++;
      counts.costMs += performance.now() - started;
    });
}

async function measure(drones: number, folder: string, browser: Browser): Promise<string> {
  const file = join(folder, `${drones}.yaml`);
  await writeFile(file, missionOf(drones));
  const program = await serve(file);
  const { page, context } = await openView(browser);
  await page.addInitScript(countPictures);
  await page.goto(program.address);
  await page.getByTestId('badge').getByText('SIM').waitFor();
  const counted = (): Promise<Counts> =>
    page.evaluate(() => ({ ...(window as unknown as { counts: Counts }).counts, at: performance.now() }));
  const before = await counted();
  await page.waitForTimeout(1000 * kSeconds);
  const after = await counted();
  await context.close();
  await program.stop();
  const pictures = after.pictures - before.pictures;
  const rate = (1000 * pictures) / (after.at - before.at);
  const cost = (after.costMs - before.costMs) / Math.max(1, pictures);
  return `${String(drones).padStart(6)} drones: ${rate.toFixed(1).padStart(5)} pictures/s, ${cost.toFixed(2)} ms of the page's thread each`;
}

const wanted = process.argv
  .slice(2)
  .map(Number)
  .filter((count) => count > 0);
const folder = await mkdtemp(join(tmpdir(), 'vigil-frames-'));
const browser = await openBrowser();
for (const drones of wanted.length > 0 ? wanted : [3, 100, 1000, 10_000])
  console.log(await measure(drones, folder, browser));
await browser.close();
await rm(folder, { recursive: true });
