import { execFile } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { violationsOf } from './axe';
import { keepPicture, openBrowser, openView, type View } from './chromium';
import { kProgram, replay, serve, type Program } from './program';

/** Why the selected drone flies as it does: in a flight, and at moments of a recording. */

const kMission = new URL('../../missions/crowd.yaml', import.meta.url).pathname;
const kAtS = 12.34;
let browser: Browser;
let folder: string;
let program: Program;
let view: View;
let page: Page;

beforeAll(async () => {
  [browser, folder] = [await openBrowser(), await mkdtemp(join(tmpdir(), 'vigil-why-'))];
  await promisify(execFile)(kProgram, ['simulate', kMission, '--out', join(folder, 'flight'), '--seconds', '20']);
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

async function look(shown: Program, badge: string, options: Parameters<typeof openView>[1] = {}): Promise<void> {
  program = shown;
  view = await openView(browser, options);
  page = view.page;
  await page.goto(program.address);
  await page.getByTestId('badge').getByText(badge).waitFor();
}

const answer = () => page.getByTestId('why-answer');
const tick = async (): Promise<number> => Number(await answer().getAttribute('data-tick'));
const rows = () => page.getByRole('region', { name: 'Rows of the safety filter' });

async function ask(key: string): Promise<void> {
  await page.locator('.map-field').focus();
  await page.keyboard.press(key);
  await page.getByRole('button', { name: 'Why this velocity' }).click();
  await answer().waitFor();
}

async function seek(timeS: number): Promise<void> {
  await page.getByRole('slider', { name: 'Moment of the recording' }).fill(String(timeS));
  await expect.poll(tick).toBe(Math.round(timeS * 50));
}

interface Printed {
  readonly u_nom_m_s: number[];
  readonly u_m_s: number[];
  readonly rows: { kind: string; drone: string; offset_m_s: number; slack_m_s: number; holds: boolean }[];
}

async function printed(drone: string, timeS: number): Promise<Printed> {
  const options = ['--why', drone, '--at', String(timeS), '--json'];
  const { stdout } = await promisify(execFile)(kProgram, ['replay', join(folder, 'flight'), ...options]);
  return JSON.parse(stdout) as Printed;
}

/** What the panel shows, as the page writes it. */
const three = (value: number): string => value.toFixed(3).replace('-0.000', '0.000');
const vector = (v: readonly number[]): string => `[${v.map(three).join(', ')}] m/s`;

async function expectShown(why: Printed): Promise<void> {
  expect(await page.getByTestId('why-wanted').textContent()).toBe(vector(why.u_nom_m_s));
  expect(await page.getByTestId('why-allowed').textContent()).toBe(vector(why.u_m_s));
  const shown = await rows().locator('tbody tr').allTextContents();
  expect(shown.length).toBe(why.rows.length);
  why.rows.forEach((row, i) => {
    expect(shown[i]).toContain(`${three(row.offset_m_s)}${three(row.slack_m_s)}`);
    expect(shown[i]!.includes('(holds)')).toBe(row.holds);
    if (row.kind === 'drone') expect(shown[i]).toContain(`drone ${row.drone}`);
  });
}

describe('why, in a recording', () => {
  it('shows the numbers that the command prints, at every step', async () => {
    await look(await replay(join(folder, 'flight')), 'REPLAY');
    await ask('7');
    await seek(kAtS);
    const why = await printed('cf7', kAtS);
    expect(why.rows.some((row) => row.holds)).toBe(true);
    await expectShown(why);
    await rows().scrollIntoViewIfNeeded();
    expect(await page.evaluate(() => document.documentElement.scrollHeight - window.innerHeight)).toBe(0);
    expect(await answer().locator('p').first().textContent()).toMatch(/ by drone cf\d+, [\d.]+ m away/);
    await keepPicture(page, 'why_recorded');
    await page.getByRole('button', { name: 'One tick on' }).click();
    await expect.poll(tick).toBe(618);
    await expectShown(await printed('cf7', kAtS + 0.02));
  });
});

describe('why, in a flight', () => {
  it('follows the flight while it is open, and the selection', async () => {
    await look(await serve('crowd.yaml'), 'SIM');
    await ask('7');
    const first = await tick();
    await expect.poll(tick).toBeGreaterThan(first + 25);
    await page.getByRole('img', { name: 'Velocities of cf7' }).waitFor();
    await keepPicture(page, 'why_live');
    await page.locator('.map-field').focus();
    await page.keyboard.press('8');
    await page.getByRole('img', { name: 'Velocities of cf8' }).waitFor();
    await page.getByRole('button', { name: 'Why this velocity' }).click();
    await answer().waitFor({ state: 'detached' });
  });
});

describe.each(['dark', 'light'] as const)('why, in the %s theme', (theme) => {
  it('axe finds nothing', async () => {
    await look(await replay(join(folder, 'flight')), 'REPLAY', { theme });
    await ask('7');
    await seek(kAtS);
    await keepPicture(page, `why_${theme}`);
    expect(await violationsOf(page)).toEqual([]);
  });
});
