import { execFile } from 'node:child_process';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { promisify } from 'node:util';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { violationsOf } from './axe';
import { keepPicture, openBrowser } from './chromium';
import { kProgram, replay, type Program } from './program';
import { Views, type ViewOptions } from './views';

/** The console on a recording of the paper's mission, 30 s of it: a drone lands after 23 s. */

const kSeconds = 30;
let browser: Browser;
let folder: string;
let program: Program;
const views = new Views();

beforeAll(async () => {
  [browser, folder] = [await openBrowser(), await mkdtemp(join(tmpdir(), 'vigil-replay-'))];
  const mission = new URL('../../missions/paper.yaml', import.meta.url).pathname;
  const flown = ['simulate', mission, '--out', join(folder, 'flight'), '--seconds', String(kSeconds)];
  await promisify(execFile)(kProgram, flown);
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

async function open(options: ViewOptions = {}): Promise<Page> {
  program = await replay(join(folder, 'flight'));
  return views.look(browser, program.address, 'REPLAY', options);
}

const moment = (page: Page) => page.getByRole('slider', { name: 'Moment of the recording' });
const standing = (page: Page) => page.getByTestId('replay-standing');
const clock = (page: Page) => page.getByTestId('mission-clock');

async function seek(page: Page, timeS: number): Promise<void> {
  await moment(page).fill(String(timeS));
}

describe('a recording', () => {
  it('is scrubbed with the mouse and with keys, and shows what had happened until then', async () => {
    const page = await open();
    const box = (await moment(page).boundingBox())!;
    await page.mouse.click(box.x + 0.87 * box.width, box.y + box.height / 2);
    await expect.poll(() => clock(page).textContent()).toMatch(/0:2[67]/);
    await page.getByRole('button', { name: 'Event log' }).click();
    await page.getByText('cf2 lands').waitFor();
    await keepPicture(page, 'replay_scrubbed');
    await moment(page).focus();
    await page.keyboard.press('Home');
    await expect.poll(() => clock(page).textContent()).toMatch(/0:00/);
    await expect.poll(() => page.getByText('cf2 lands').count()).toBe(0);
  });

  it('goes on and back by one tick', async () => {
    const page = await open();
    await seek(page, 10);
    await expect.poll(() => standing(page).textContent()).toContain('tick 501 of 1500');
    await page.getByRole('button', { name: 'One tick on' }).click();
    await expect.poll(() => standing(page).textContent()).toContain('tick 502 of 1500');
    await moment(page).focus(); // where nobody types
    await page.keyboard.press('[');
    await page.keyboard.press('[');
    await expect.poll(() => standing(page).textContent()).toContain('tick 500 of 1500');
  });

  it('plays at a hundred times the speed to its end, and says that it ends there', async () => {
    const page = await open();
    await page.getByLabel('Speed of the recording').selectOption('100');
    await page.getByRole('button', { name: 'Play' }).click();
    await expect.poll(() => standing(page).textContent()).toContain('end of the recording');
    await expect.poll(() => clock(page).textContent()).toContain('paused');
    await keepPicture(page, 'replay_end');
  });

  it('cannot be changed, and says why', async () => {
    const page = await open();
    for (const name of ['LAND ALL', 'Land', 'Hold', 'Take off'])
      expect(await page.getByRole('button', { name, exact: true }).isDisabled()).toBe(true);
    await page.locator('body').press('Shift+L');
    await page.getByText('this is a recording: what happened in it cannot be changed').waitFor();
    await page.locator('body').press('w');
    await page.getByText('This is a recording: play it to see what came.').waitFor();
    await keepPicture(page, 'replay_refused');
  });

  for (const theme of ['dark', 'light'] as const)
    it(`has nothing that axe objects to: ${theme}`, async () => {
      const page = await open({ theme });
      await seek(page, 25);
      await expect.poll(() => standing(page).textContent()).toContain('recomputed');
      await page.keyboard.press('1');
      await page.getByRole('region', { name: 'Drone cf1' }).waitFor();
      expect(await violationsOf(page)).toEqual([]);
      await keepPicture(page, `replay_${theme}`);
    });
});
