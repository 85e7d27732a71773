import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { violationsOf } from './axe';
import { keepPicture, openBrowser, openView, type View } from './chromium';
import { serve, type Program } from './program';

/** Looking ahead, with the real program in a real browser. */

let browser: Browser;
let program: Program;
let view: View;
let page: Page;

beforeAll(async () => {
  browser = await openBrowser();
});
afterAll(() => browser.close());
afterEach(async () => {
  expect(view.complaints).toEqual([]);
  await view.context.close();
  await program.stop();
});

async function fly(mission: string, options: Parameters<typeof openView>[1] = {}): Promise<void> {
  program = await serve(mission);
  view = await openView(browser, options);
  page = view.page;
  await page.goto(program.address);
  await page.getByTestId('badge').getByText('SIM').waitFor();
}

const ahead = () => page.getByRole('region', { name: 'In 60 s' });
const row = (name: string) => page.getByTestId(`ahead-${name}`);

/** How many pixels of the map's notes have about this colour. */
const countOf = (red: number, green: number, blue: number): Promise<number> =>
  page.locator('canvas.map-notes').evaluate(
    (canvas: HTMLCanvasElement, wanted) => {
      const { data } = canvas.getContext('2d')!.getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4)
        if (data[i + 3]! > 200 && wanted.every((part, k) => Math.abs(data[i + k]! - part) < 12)) count++;
      return count;
    },
    [red, green, blue],
  );

describe('looking ahead', () => {
  it('W shows what will be; a selected drone is missed; W ends it', async () => {
    await fly('paper.yaml');
    expect(await countOf(0xc9, 0xa7, 0xff)).toBe(0);
    await page.locator('.map-field').focus();
    await page.keyboard.press('w');
    await row('east').waitFor();
    expect(await row('east').textContent()).toMatch(/\d/);
    // What is near is drawn in full; the rest fades, and is not counted.
    await expect.poll(() => countOf(0xc9, 0xa7, 0xff)).toBeGreaterThan(60);
    await keepPicture(page, 'ahead_as_is');
    await page.keyboard.press('2');
    await ahead().getByText('without cf2').waitFor();
    await ahead().getByRole('columnheader', { name: 'what if' }).waitFor();
    await keepPicture(page, 'ahead_without');
    await page.keyboard.press('w');
    await ahead().waitFor({ state: 'detached' });
    await expect.poll(() => countOf(0xc9, 0xa7, 0xff)).toBe(0);
  });

  it('Staged edits are foreseen by themselves, and no more once they are dropped', async () => {
    await fly('paper.yaml');
    await page.getByTestId('area-east').click();
    await page.getByRole('textbox', { name: 'Weight' }).fill('9');
    await page.getByRole('textbox', { name: 'Weight' }).press('Enter');
    await ahead().getByText('with 1 staged edit').waitFor();
    await row('south').locator('.ghostly').first().waitFor();
    await keepPicture(page, 'ahead_staged');
    await page.locator('.map-field').focus();
    await page.keyboard.press('Escape');
    await ahead().waitFor({ state: 'detached' });
  });
});

describe('with every drone taken away', () => {
  it('It says that nothing is covered, and leaves out what would speak of covering', async () => {
    await fly('paper.yaml', { width: 1366, height: 768 });
    await page.locator('.map-field').focus();
    await page.keyboard.press('Control+a');
    await page.keyboard.press('w');
    await ahead().getByText('What if: nothing is covered').waitFor();
    const whatIf = (name: string) => ahead().getByRole('row', { name }).locator('.ghostly').first();
    for (const name of ['metric', 'closest pair', 'east']) expect(await whatIf(name).textContent()).toBe('–');
    expect(await whatIf('oldest place').textContent()).toMatch(/\d/);
    await keepPicture(page, 'ahead_nobody');
  });

  it('All areas are above the fold on a small screen', async () => {
    await fly('paper.yaml', { width: 1366, height: 768 });
    await page.locator('.map-field').focus();
    await page.keyboard.press('w');
    await row('south').waitFor();
    const figures = ahead().getByRole('group', { name: 'Figures of the look ahead' });
    const [line, shown] = [await row('south').boundingBox(), await figures.boundingBox()];
    expect(line!.y + line!.height).toBeLessThanOrEqual(shown!.y + shown!.height);
    await keepPicture(page, 'ahead_small');
  });
});

describe.each(['dark', 'light'] as const)('in the %s theme', (theme) => {
  it('axe finds nothing, with edits staged and a drone missed', async () => {
    await fly('wildfire.yaml', { theme });
    await page.getByRole('button', { name: 'Look ahead' }).click();
    await page.keyboard.press('1');
    await page.getByTestId('area-camp').click();
    await page.getByRole('textbox', { name: 'Weight' }).fill('6');
    await page.getByRole('textbox', { name: 'Weight' }).press('Enter');
    await ahead().getByText('with 1 staged edit, without north1').waitFor();
    await keepPicture(page, `ahead_${theme}`);
    expect(await violationsOf(page)).toEqual([]);
    await page.getByRole('button', { name: 'Stop looking ahead' }).click();
    await ahead()
      .getByText(/^with 1 staged edit$/)
      .waitFor();
  });
});
