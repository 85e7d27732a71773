import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { agesRead, agesSaid, watchAges, type AgeSaid } from './age_watch';
import { keepPicture, openBrowser, openView, type View } from './chromium';
import { kThousandDrones } from './missions';
import { serve, type Program } from './program';
import { slowLink, type SlowLink } from './slow_link';

/** The page behind a way that carries 25 kB/s and buffers whatever comes: it never says that an old picture is a fresh one. */

const kBytesASecond = 25_000;

let browser: Browser;
let folder: string;
let program: Program;
let link: SlowLink;
let view: View;

beforeAll(async () => {
  [browser, folder] = [await openBrowser(), await mkdtemp(join(tmpdir(), 'vigil-slow-link-'))];
  await writeFile(join(folder, 'thousand.yaml'), kThousandDrones);
});
afterAll(async () => {
  await browser.close();
  await rm(folder, { recursive: true });
});
afterEach(async () => {
  await view.context.close();
  await link.close();
  await program.stop();
  expect(view.complaints).toEqual([]);
});

/** A page that shows the mission; the way to it is slow from then on. */
async function lookFromAfar(mission: string): Promise<Page> {
  program = await serve(mission);
  link = await slowLink(program.address);
  view = await openView(browser);
  await watchAges(view.context);
  await view.page.goto(link.address);
  await view.page.getByTestId('badge').getByText('SIM').waitFor();
  link.carry(kBytesASecond);
  return view.page;
}

/** The next ages that the page says, and how old what it showed was then. */
async function nextAges(page: Page, count: number): Promise<AgeSaid[]> {
  await agesSaid(page);
  const ages: AgeSaid[] = [];
  await expect.poll(async () => ages.push(...(await agesSaid(page)))).toBeGreaterThanOrEqual(count);
  return ages;
}

const median = (values: readonly number[]): number => [...values].sort((a, b) => a - b)[values.length >> 1]!;
const errors = (ages: readonly AgeSaid[]): number[] => ages.map(({ trueS, shownS }) => Math.abs(trueS - shownS));

/** For whoever wants the figures. */
function print(what: string, ages: readonly AgeSaid[]): void {
  const trueS = ages.map((age) => age.trueS);
  const [middle, most, wrong] = [median(trueS), Math.max(...trueS), Math.max(...errors(ages))];
  console.log(
    `${what}: ${middle.toFixed(2)} s old, ${most.toFixed(2)} s at most; said with ${wrong.toFixed(3)} s of error`,
  );
}

describe('over a slow way', () => {
  it('Pictures of a few drones stay young, and their age is said as it is', async () => {
    const page = await lookFromAfar('paper.yaml');
    await nextAges(page, 40);
    await agesRead(page);
    const ages = await nextAges(page, 40);
    expect(Math.max(...errors(ages))).toBeLessThan(0.3);
    expect(median(ages.map((age) => age.trueS))).toBeLessThan(0.6);
    expect(median(await agesRead(page))).toBeLessThan(0.5);
    print('3 drones', ages);
    await keepPicture(page, 'slow_link');
  });

  it('Pictures of a thousand drones come late and are called stale; all of them land when that is asked', async () => {
    const page = await lookFromAfar(join(folder, 'thousand.yaml'));
    await page.getByTestId('disconnected').getByText('Stale picture.').waitFor();
    const ages = await nextAges(page, 10);
    expect(Math.max(...errors(ages))).toBeLessThan(0.3);
    for (const { trueS, badge } of ages) expect(trueS < 1.6 || badge === 'STALE', `${trueS} s: ${badge}`).toBe(true);
    expect(await page.getByRole('button', { name: 'Take off' }).isDisabled()).toBe(true);
    const began = performance.now();
    await page.getByRole('button', { name: 'LAND ALL' }).click();
    await page.getByText('LAND ALL: every drone comes down.').waitFor();
    const confirmedMs = performance.now() - began;
    expect(confirmedMs).toBeLessThan(3000);
    print('1000 drones', ages);
    console.log(`LAND ALL confirmed after ${confirmedMs.toFixed(0)} ms`);
    await keepPicture(page, 'slow_link_stale');
    const state = await (await fetch(`${program.address}/api/state`)).json();
    expect((state as { active: number }).active).toBe(0);
  });
});

describe('a page that falls behind', () => {
  it('Finds no queue of old pictures when it is back, and says how old the one was that it had', async () => {
    const page = await lookFromAfar('paper.yaml');
    link.carry(100 * kBytesASecond);
    await nextAges(page, 20);
    await agesRead(page);
    await page.evaluate(() => {
      const until = performance.now() + 2500;
      while (performance.now() < until);
    });
    await nextAges(page, 5);
    const old = (await agesRead(page)).filter((ageS) => ageS > 1);
    expect(old.length).toBeGreaterThan(0);
    expect(old.length).toBeLessThanOrEqual(2);
  });
});
