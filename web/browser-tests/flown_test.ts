import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { violationsOf } from './axe';
import { keepPicture, openBrowser } from './chromium';
import { pixelOf } from './field_pixels';
import { kEmptyField } from './missions';
import { serve, type Program } from './program';
import { Views, type ViewOptions } from './views';

/** The real program with a simulated fleet, in a real browser. */

let browser: Browser;
let folder: string;
let program: Program;
const views = new Views();

beforeAll(async () => {
  [browser, folder] = [await openBrowser(), await mkdtemp(join(tmpdir(), 'vigil-console-'))];
  await writeFile(join(folder, 'empty.yaml'), kEmptyField);
});
afterAll(async () => {
  await browser.close();
  await rm(folder, { recursive: true });
});
afterEach(async () => {
  const complaints = await views.close();
  await program.stop();
  expect(complaints).toEqual([]);
});

const look = (options: ViewOptions = {}): Promise<Page> => views.look(browser, program.address, 'SIM', options);

const flyPaper = async (): Promise<Page> => {
  program = await serve('paper.yaml');
  return look();
};

const flyEmptyField = async (): Promise<Page> => {
  program = await serve(join(folder, 'empty.yaml'));
  return look();
};

async function clickAt(page: Page, x: number, y: number): Promise<void> {
  const pixel = await pixelOf(page, x, y);
  await page.mouse.click(pixel.x, pixel.y);
}

async function dragAlong(page: Page, places: readonly (readonly [number, number])[]): Promise<void> {
  for (const [i, place] of places.entries()) {
    const pixel = await pixelOf(page, ...place);
    await page.mouse.move(pixel.x, pixel.y, { steps: 3 });
    if (i === 0) await page.mouse.down();
  }
  await page.mouse.up();
}

const circle = (x: number, y: number, radius: number): [number, number][] =>
  Array.from({ length: 17 }, (_, i) => [x + radius * Math.cos(i / 2.55), y + radius * Math.sin(i / 2.55)]);

const staged = (page: Page) => page.getByRole('region', { name: 'Staged edits' });
const areaRow = (page: Page, name: string) => page.getByTestId(`area-${name}`);
const metric = async (page: Page): Promise<number> =>
  Number.parseFloat(
    /: ([\d.e-]+) %/.exec((await page.getByRole('img', { name: /^Metric/ }).getAttribute('aria-label'))!)?.[1] ?? 'NaN',
  );
const speedUp = (page: Page, factor: number) => page.getByLabel('Speed of the simulation').selectOption(String(factor));

describe('a newcomer', () => {
  it('goes from an empty field to a falling metric', async () => {
    const page = await flyEmptyField();
    await page.getByRole('heading', { name: 'Drop points on the field to start' }).waitFor();
    await keepPicture(page, 'newcomer_1_empty');
    await page.getByRole('button', { name: 'Take the point tool' }).click();
    for (const [x, y] of [[-0.8, 0.8], [-0.6, 0.9], [-0.7, 0.6]] as const) await clickAt(page, x, y); // prettier-ignore
    await staged(page).getByText('3 staged edits').waitFor();
    await keepPicture(page, 'newcomer_2_staged');
    await page.keyboard.press('Enter');
    await staged(page).waitFor({ state: 'detached' });
    await areaRow(page, 'targets').waitFor();
    await speedUp(page, 10);
    await expect.poll(() => metric(page)).toBeLessThan(20);
    expect(await page.getByTestId('active-count').textContent()).toBe('3 of 3 active');
    await keepPicture(page, 'newcomer_3_covering');
  });

  it('may start from the example', async () => {
    const page = await flyEmptyField();
    await page.getByRole('button', { name: 'Load an example' }).click();
    await staged(page)
      .getByRole('button', { name: /Commit/ })
      .click();
    await areaRow(page, 'north').waitFor();
    await staged(page).waitFor({ state: 'detached' });
    await expect.poll(() => metric(page)).toBeGreaterThan(0);
  });
});

describe('editing', () => {
  it('Weights are staged, committed, undone and redone', async () => {
    const page = await flyPaper();
    await areaRow(page, 'east').click();
    await page.getByRole('textbox', { name: 'Weight' }).fill('4');
    await page.getByRole('textbox', { name: 'Weight' }).press('Enter');
    await areaRow(page, 'east').getByText('staged').waitFor();
    await page.locator('.map-field').focus();
    await page.keyboard.press('Control+z');
    await areaRow(page, 'east').getByText('×1').waitFor();
    await page.keyboard.press('Control+Shift+Z');
    await areaRow(page, 'east').getByText('×4').waitFor();
    await keepPicture(page, 'edit_staged');
    await page.keyboard.press('Enter');
    await staged(page).waitFor({ state: 'detached' });
    expect(await areaRow(page, 'east').textContent()).toMatch(/east×4/);
    await page.keyboard.press('Control+z');
    await areaRow(page, 'east').getByText('×1').waitFor();
    await page.keyboard.press('Control+Shift+Z');
    await areaRow(page, 'east').getByText('×4').waitFor();
  });

  it('A cluster is dragged by its centre, a point is moved by numbers; Escape drops it all', async () => {
    const page = await flyPaper();
    await areaRow(page, 'east').click();
    await page.getByRole('radio', { name: 'Select' }).click();
    const x = page.getByRole('textbox', { name: 'Centre x, m' });
    const before = Number(await x.inputValue());
    await dragAlong(page, [[0.81, 0.32], [0.6, 0.32], [0.31, 0.32]]); // prettier-ignore
    await expect.poll(async () => Number(await x.inputValue())).toBeLessThan(before - 0.4);
    await page.getByRole('textbox', { name: 'Point 1, x in metres' }).fill('1.2');
    await page.getByRole('textbox', { name: 'Point 1, x in metres' }).press('Enter');
    await staged(page).getByText('2 staged edits').waitFor();
    await keepPicture(page, 'edit_dragged');
    await page.locator('.map-field').focus();
    await page.keyboard.press('Escape');
    await expect.poll(async () => Number(await x.inputValue())).toBe(before);
  });

  it('A lasso is filled with points; areas and no-fly polygons are drawn by corners or by hand', async () => {
    const page = await flyEmptyField();
    await page.keyboard.press('b');
    await dragAlong(page, circle(-0.7, 0.6, 0.35));
    await staged(page)
      .getByText(/points in targets/)
      .waitFor();
    await page.keyboard.press('a');
    for (const [x, y] of [[0.4, 0.4], [1.2, 0.5], [1.1, 1.2], [0.5, 1.1]] as const) await clickAt(page, x, y); // prettier-ignore
    await page.keyboard.press('Enter');
    await areaRow(page, 'area').waitFor();
    await page.keyboard.press('n');
    await dragAlong(page, circle(0.5, -0.7, 0.3));
    await areaRow(page, 'no-fly').waitFor();
    await staged(page).getByText('3 staged edits').waitFor();
    await keepPicture(page, 'lasso_and_polygons_staged');
    await page.keyboard.press('Enter');
    await staged(page).waitFor({ state: 'detached' });
    await speedUp(page, 10);
    await expect.poll(() => metric(page)).toBeLessThan(60);
    await keepPicture(page, 'lasso_and_polygons');
  });

  it('An edit that breaks a rule is refused with the reason, and stays staged', async () => {
    const page = await flyPaper();
    await page.keyboard.press('a');
    for (const [x, y] of [[0, 0], [0.5, 0.5], [0.5, 0], [0, 0.5]] as const) await clickAt(page, x, y); // prettier-ignore
    await page.keyboard.press('Enter');
    await page
      .getByTestId('notices')
      .getByText(/crosses itself/)
      .waitFor();
    await areaRow(page, 'east').click();
    await page.getByRole('textbox', { name: 'Revisit within, s' }).fill('20000000');
    expect(await page.getByRole('textbox', { name: 'Revisit within, s' }).getAttribute('aria-invalid')).toBe('true');
  });
});

describe('drones', () => {
  it('One that is marked failed is out of coverage, with the reason; the log says what it means', async () => {
    const page = await flyPaper();
    await page.getByRole('button', { name: 'cf3', exact: true }).click();
    await page.getByRole('button', { name: 'Mark failed' }).click();
    await page.getByRole('row', { name: /cf3/ }).getByText('Marked failed').waitFor();
    expect(await page.getByTestId('why').textContent()).toMatch(/operator declared it failed/);
    await expect.poll(() => page.getByTestId('active-count').textContent()).toMatch('2 of 3 active');
    await page.getByRole('button', { name: 'Event log' }).click();
    await page.getByRole('list', { name: 'Events, newest first' }).getByText(/cf3/).first().waitFor();
    await keepPicture(page, 'drone_lost');
  });

  it('The paper’s drone 2 lands at 23 s, and the others go on', async () => {
    const page = await flyPaper();
    await speedUp(page, 20);
    await page.getByRole('row', { name: /cf2/ }).getByText('Grounded').waitFor();
    expect(await page.getByTestId('active-count').textContent()).toMatch('2 of 3 active');
    await keepPicture(page, 'paper_after_23_s');
  });

  it('LAND ALL needs one press and no dialog', async () => {
    const page = await flyPaper();
    await page.getByRole('button', { name: 'LAND ALL' }).click();
    await expect
      .poll(() =>
        page
          .getByRole('row')
          .getByText(/Landing|Grounded/)
          .count(),
      )
      .toBe(3);
    await page.getByRole('row', { name: /cf1/ }).getByText('Grounded').waitFor();
    await keepPicture(page, 'land_all');
    await page.getByRole('button', { name: 'Take off' }).click();
    await page.getByRole('row', { name: /cf1/ }).getByText('Active').waitFor();
  });

  it('Landing and marking as failed want drones that were chosen: nobody ends a flight by a click too few', async () => {
    const page = await flyPaper();
    const [land, fail] = ['Land', 'Mark failed'].map((name) => page.getByRole('button', { name, exact: true }));
    expect([await land!.isDisabled(), await fail!.isDisabled()]).toEqual([true, true]);
    await keepPicture(page, 'nothing_selected');
    await page.getByRole('button', { name: 'cf1', exact: true }).click();
    await land!.click();
    await page.getByRole('row', { name: /cf1/ }).getByText('Grounded').waitFor();
    await expect.poll(() => page.getByTestId('active-count').textContent()).toMatch('2 of 3 active');
  });

  it('An order under a paused clock is said to wait, and done once the clock goes on', async () => {
    const page = await flyPaper();
    await page.getByRole('button', { name: 'Pause the simulation' }).click();
    await page.getByRole('button', { name: 'Go on' }).waitFor();
    await page.getByRole('button', { name: 'LAND ALL' }).click();
    const waiting = page.getByText('Waiting: the clock is paused. Not done yet: LAND ALL');
    await waiting.waitFor();
    await keepPicture(page, 'order_waits');
    await page.getByRole('button', { name: 'Go on' }).click();
    await waiting.waitFor({ state: 'detached' });
    await page.getByText('LAND ALL: every drone comes down.').waitFor();
    await page.getByRole('row', { name: /cf1/ }).getByText('Grounded').waitFor();
  });

  it('The emergency stop needs its two presses', async () => {
    const page = await flyPaper();
    await page.locator('.map-field').focus();
    await page.keyboard.press('.');
    await page.locator('.stop.is-armed').waitFor();
    await page.locator('.stop.is-armed').waitFor({ state: 'detached' });
    expect(await page.getByTestId('active-count').textContent()).toBe('3 of 3 active');
    await page.keyboard.press('.');
    await page.keyboard.press('.');
    await page.getByRole('row', { name: /cf1/ }).getByText('Motors off').waitFor();
    await keepPicture(page, 'emergency_stop_flown');
  });

  it('One is sent to a place, waits there, returns to where it started, and goes back to covering', async () => {
    const page = await flyPaper();
    await speedUp(page, 5);
    await page.getByRole('button', { name: 'cf1', exact: true }).click();
    await page.keyboard.press('j');
    await clickAt(page, 0.2, 0.3);
    const row = page.getByRole('row', { name: /cf1/ });
    await row.getByText('Travelling').waitFor();
    await row.getByText('0.20, 0.30').waitFor();
    await keepPicture(page, 'sent_to_a_place');
    await page.getByRole('button', { name: 'Return' }).click();
    await row.getByText('-1.00, -1.00').waitFor();
    await page.getByRole('button', { name: 'Resume' }).click();
    await row.getByText('Active').waitFor();
  });

  it('Orders from the keyboard go to the drones that digits select', async () => {
    const page = await flyPaper();
    await page.keyboard.press('2');
    await page.keyboard.press('h');
    await page.getByRole('row', { name: /cf2/ }).getByText('Held').waitFor();
    await page.keyboard.press('u');
    await page.getByRole('row', { name: /cf2/ }).getByText('Active').waitFor();
  });
});

describe('the connection', () => {
  it('A program that dies leaves a frozen page that says so; when it is back, the page goes on', async () => {
    const page = await flyPaper();
    const port = Number(new URL(program.address).port);
    await program.kill();
    await page.getByTestId('disconnected').waitFor();
    await page.getByTestId('badge').getByText('STALE').waitFor();
    expect(await page.getByRole('button', { name: 'LAND ALL' }).isDisabled()).toBe(true);
    await keepPicture(page, 'program_died');
    program = await serve('paper.yaml', [], port);
    await page.getByTestId('badge').getByText('SIM').waitFor();
    await page.getByTestId('disconnected').waitFor({ state: 'detached' });
    await page.getByTestId('notices').getByText('The program was restarted').waitFor();
  });

  it('Two operators see each other’s edits at once, and who edits what', async () => {
    const first = await flyPaper();
    const second = await look();
    await areaRow(first, 'east').click();
    await first.getByRole('textbox', { name: 'Weight' }).fill('3');
    await first.getByRole('textbox', { name: 'Weight' }).press('Enter');
    await areaRow(second, 'east').getByText('✎').waitFor();
    await keepPicture(second, 'two_operators');
    await staged(first)
      .getByRole('button', { name: /Commit/ })
      .click();
    await areaRow(second, 'east').getByText('×3').waitFor();
    await areaRow(second, 'east').getByText('✎').waitFor({ state: 'detached' });
  });

  it('A viewer sees everything and may change nothing', async () => {
    const page = await flyPaper();
    await page.getByRole('button', { name: /^Operators/ }).click();
    await page.getByLabel('Role').selectOption('viewer');
    await page.getByRole('button', { name: 'Connect' }).click();
    await page.getByTestId('badge').getByText('SIM').waitFor();
    await expect.poll(() => page.getByRole('button', { name: 'LAND ALL' }).isDisabled()).toBe(true);
    expect(await page.getByRole('radio', { name: 'Point' }).isDisabled()).toBe(true);
  });
});

describe('files', () => {
  const chosen = async (page: Page, item: string, name: string, text: string): Promise<void> => {
    await page.getByRole('button', { name: 'Mission', exact: true }).click();
    const chooser = page.waitForEvent('filechooser');
    await page.getByRole('button', { name: item }).click();
    await (await chooser).setFiles({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
  };
  const saved = async (page: Page, item: string): Promise<string> => {
    await page.getByRole('button', { name: 'Mission', exact: true }).click();
    const download = page.waitForEvent('download');
    await page.getByRole('button', { name: item }).click();
    return readFile(await (await download).path(), 'utf8');
  };

  it('A mission is saved as YAML, and another one is loaded', async () => {
    const page = await flyPaper();
    const yaml = await saved(page, 'Save mission (YAML)');
    expect(yaml).toMatch(/name: paper/);
    expect(yaml).toMatch(/north-west/);
    await chosen(page, 'Load mission (YAML)…', 'empty.yaml', kEmptyField);
    await page.getByRole('heading', { name: 'Drop points on the field to start' }).waitFor();
  });

  it('Areas go out as GeoJSON and come in again, staged', async () => {
    const page = await flyPaper();
    const geojson = await saved(page, 'Export areas (GeoJSON)');
    expect(JSON.parse(geojson)).toMatchObject({ type: 'FeatureCollection' });
    const changed = geojson.replaceAll('"weight": 1', '"weight": 7').replace('"south"', '"south as well"');
    await chosen(page, 'Import areas (GeoJSON)…', 'areas.geojson', changed);
    await areaRow(page, 'south as well').getByText('×7').waitFor();
    await areaRow(page, 'east').getByText('×7').waitFor();
    await areaRow(page, 'south').getByText('×1').waitFor();
    await chosen(page, 'Import areas (GeoJSON)…', 'broken.geojson', '{"type": "FeatureCollection"}');
    await page
      .getByTestId('notices')
      .getByText(/broken.geojson: file.features/)
      .waitFor();
  });
});

describe('without a mouse', () => {
  it('A target is placed, committed and the swarm commanded by keys alone', async () => {
    const page = await flyEmptyField();
    const isOnMap = (): Promise<boolean> =>
      page.evaluate(() => document.activeElement?.classList.contains('map-field') ?? false);
    for (let i = 0; i < 60 && !(await isOnMap()); i++) await page.keyboard.press('Tab');
    expect(await isOnMap()).toBe(true);
    await page.keyboard.press('p');
    for (let i = 0; i < 5; i++) await page.keyboard.press('Shift+ArrowLeft');
    await page.keyboard.press('Space');
    await page.keyboard.press('Shift+ArrowUp');
    await page.keyboard.press('Space');
    await staged(page).getByText('2 staged edits').waitFor();
    await keepPicture(page, 'keyboard_only');
    await page.keyboard.press('Enter');
    await areaRow(page, 'targets').waitFor();
    await staged(page).waitFor({ state: 'detached' });
    await page.keyboard.press('Shift+L');
    await page
      .getByRole('row', { name: /cf1/ })
      .getByText(/Landing|Grounded/)
      .waitFor();
  });

  it('axe finds nothing on the page of a flying swarm, on a tablet neither', async () => {
    const page = await flyPaper();
    expect(await violationsOf(page)).toEqual([]);
    await page.setViewportSize({ width: 1180, height: 820 });
    await keepPicture(page, 'tablet_landscape');
    await page.setViewportSize({ width: 820, height: 1180 });
    await keepPicture(page, 'tablet');
    expect(await violationsOf(page)).toEqual([]);
  });
});
