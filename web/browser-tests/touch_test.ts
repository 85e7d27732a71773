import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, CDPSession, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { spreadHandle } from '../src/map/targets_overlay';
import { spreadOf, type Point } from '../src/model/geometry';
import { keepPicture, openBrowser, openView, type View } from './chromium';
import { pixelOf } from './field_pixels';
import { kEmptyField } from './missions';
import { serve, type Program } from './program';

/**
 * The map under fingers, on a tablet. Panels are clicked, not tapped: within milliseconds of a flick that two fingers end,
 * the browser takes a tap for what stops the flick, and no click comes of it.
 */

const kTriangle: readonly Point[] = [[-0.4, -0.3], [0.4, -0.3], [0, 0.6]]; // prettier-ignore

let browser: Browser;
let folder: string;
let program: Program;
let view: View;
let page: Page;
let fingers: CDPSession;

beforeAll(async () => {
  [browser, folder] = [await openBrowser(), await mkdtemp(join(tmpdir(), 'vigil-touch-'))];
  const targets = `targets: {clusters: [{name: triangle, points_m: ${JSON.stringify(kTriangle)}}]}`;
  await writeFile(join(folder, 'triangle.yaml'), kEmptyField + targets);
});
afterAll(async () => {
  await browser.close();
  await rm(folder, { recursive: true });
});
beforeEach(async () => {
  program = await serve(join(folder, 'triangle.yaml'));
  view = await openView(browser, { width: 1180, height: 820, hasTouch: true });
  page = view.page;
  fingers = await view.context.newCDPSession(page);
  await page.goto(program.address);
  await page.getByTestId('badge').getByText('SIM').waitFor();
});
afterEach(async () => {
  await view.context.close();
  await program.stop();
  expect(view.complaints).toEqual([]);
});

interface Pixel {
  readonly x: number;
  readonly y: number;
}
const between = (from: Pixel, to: Pixel, share: number): Pixel => ({
  x: from.x + share * (to.x - from.x),
  y: from.y + share * (to.y - from.y),
});

/** Every finger goes down at its first place, moves to its second one and goes up, all at once. */
async function drag(...ways: readonly (readonly [Pixel, Pixel])[]): Promise<void> {
  const send = (type: 'touchStart' | 'touchMove' | 'touchEnd', share: number): Promise<unknown> =>
    fingers.send('Input.dispatchTouchEvent', {
      type,
      touchPoints: type === 'touchEnd' ? [] : ways.map(([from, to], id) => ({ ...between(from, to, share), id })),
    });
  await send('touchStart', 0);
  for (let step = 1; step <= 8; step++) await send('touchMove', step / 8);
  await send('touchEnd', 1);
}

const commit = async (): Promise<void> => {
  const staged = page.getByRole('region', { name: 'Staged edits' });
  await staged.getByRole('button', { name: /Commit/ }).click();
  await staged.waitFor({ state: 'detached' });
};

const points = async (): Promise<Point[]> => {
  const mission = (await (await fetch(`${program.address}/api/mission`)).json()) as {
    targets: { clusters: { points_m: Point[] }[] };
  };
  return mission.targets.clusters[0]!.points_m;
};

/** The place that a tap at a pixel adds as a target. */
async function placeTappedAt(pixel: Pixel): Promise<Point> {
  const before = (await points()).length;
  await page.getByTestId('area-triangle').click();
  await page.getByRole('radio', { name: 'Point' }).click();
  await page.touchscreen.tap(pixel.x, pixel.y);
  await commit();
  await expect.poll(async () => (await points()).length).toBe(before + 1);
  return (await points()).at(-1)!;
}

describe('fingers', () => {
  it('Two of them that part zoom in around their middle, and add no point', async () => {
    const [middle, corner] = [await pixelOf(page, 0, 0), await pixelOf(page, 0.8, 0.6)];
    const beside = (dx: number): Pixel => ({ x: middle.x + dx, y: middle.y });
    await drag([beside(-60), beside(-120)], [beside(60), beside(120)]);
    await keepPicture(page, 'touch_zoomed');
    const [x, y] = await placeTappedAt(corner);
    expect(x).toBeCloseTo(0.4, 1);
    expect(y).toBeCloseTo(0.3, 1);
  });

  it('Two of them that move together move the map, whatever the tool is', async () => {
    await page.getByRole('radio', { name: 'Lasso' }).click();
    const [from, to] = [await pixelOf(page, 0, 0), await pixelOf(page, 0.5, -0.25)];
    const above = (pixel: Pixel): Pixel => ({ x: pixel.x, y: pixel.y - 80 });
    await drag([from, to], [above(from), above(to)]);
    const [x, y] = await placeTappedAt(await pixelOf(page, 1, 0.5));
    expect(x).toBeCloseTo(0.5, 1);
    expect(y).toBeCloseTo(0.75, 1);
  });

  it('One of them drags the handle that spreads a cluster', async () => {
    const handle = spreadHandle(spreadOf(kTriangle, 0.01));
    const centre = spreadOf(kTriangle, 0.01).centre;
    const outside: Point = [2 * handle[0] - centre[0], 2 * handle[1] - centre[1]];
    await page.getByTestId('area-triangle').click();
    await page.getByRole('radio', { name: 'Select' }).click();
    await drag([await pixelOf(page, ...handle), await pixelOf(page, ...outside)]);
    await keepPicture(page, 'touch_spread');
    await commit();
    const spread = spreadOf(await points(), 0.01);
    for (const [i, coordinate] of centre.entries()) expect(spread.centre[i]).toBeCloseTo(coordinate, 1);
    const reach = (of: readonly Point[]): number => Math.hypot(of[2]![0] - centre[0], of[2]![1] - centre[1]);
    expect(reach(await points()) / reach(kTriangle)).toBeCloseTo(2, 0);
  });
});
