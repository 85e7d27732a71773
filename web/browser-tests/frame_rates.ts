import { openBrowser, openView } from './chromium';
import { FakeProgram } from './fake_program';
import { servePage } from './page_server';

/**
 * How many pictures a second the map draws while a played program sends 20 snapshots a second, and what one costs the page's
 * own thread: npm run frame-rates [DRONES ...]. Chromium renders in software here, so the rates are a lower bound that has
 * little to do with a GPU's; the cost on the page's thread is the same with one.
 */
const kSeconds = 6;

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

async function measure(
  drones: number,
  address: string,
  browser: Awaited<ReturnType<typeof openBrowser>>,
): Promise<string> {
  const { page, context } = await openView(browser);
  await page.addInitScript(countPictures);
  const program = new FakeProgram(drones, [Math.sqrt(drones), Math.sqrt(drones)]);
  await program.attach(page);
  const steps = setInterval(() => program.step(), 50);
  await page.goto(address);
  await page.getByTestId('badge').getByText('SIM').waitFor();
  const counted = (): Promise<Counts> =>
    page.evaluate(() => ({ ...(window as unknown as { counts: Counts }).counts, at: performance.now() }));
  const before = await counted();
  await page.waitForTimeout(1000 * kSeconds);
  const after = await counted();
  clearInterval(steps);
  await context.close();
  const pictures = after.pictures - before.pictures;
  const rate = (1000 * pictures) / (after.at - before.at);
  const cost = (after.costMs - before.costMs) / Math.max(1, pictures);
  return `${String(drones).padStart(6)} drones: ${rate.toFixed(1).padStart(5)} pictures/s, ${cost.toFixed(2)} ms of the page's thread each`;
}

const wanted = process.argv
  .slice(2)
  .map(Number)
  .filter((count) => count > 0);
const browser = await openBrowser();
const site = await servePage();
for (const drones of wanted.length > 0 ? wanted : [3, 100, 1000, 10_000])
  console.log(await measure(drones, site.address, browser));
await browser.close();
await site.close();
