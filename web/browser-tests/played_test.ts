import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, it } from 'vitest';
import { violationsOf } from './axe';
import { keepPicture, openBrowser, openView, type View } from './chromium';
import { FakeProgram } from './fake_program';
import { servePage } from './page_server';

/** What a simulated flight cannot be asked for at will: the test itself plays the program. */

let browser: Browser;
let site: Awaited<ReturnType<typeof servePage>>;
let view: View;
let page: Page;
let program: FakeProgram;
let steps: NodeJS.Timeout | undefined;

beforeAll(async () => {
  [browser, site] = [await openBrowser(), await servePage()];
});
afterAll(async () => {
  await browser.close();
  await site.close();
});

async function begin(drones: number, options: Parameters<typeof openView>[1] = {}): Promise<void> {
  view = await openView(browser, options);
  page = view.page;
  program = new FakeProgram(drones, [3, 3]);
  await program.attach(page);
}

/** Snapshots at the program's own rate, until the test ends or wants silence; large ones are slow to hand to a browser. */
function fly(): void {
  steps = setInterval(() => program.step(), program.drones.length > 1000 ? 700 : 50);
}
function fallSilent(): void {
  clearInterval(steps);
}

async function beginFlying(drones: number, options: Parameters<typeof openView>[1] = {}): Promise<void> {
  await begin(drones, options);
  fly();
  await page.goto(site.address);
  await page.getByTestId('badge').getByText('SIM').waitFor();
}

afterEach(async () => {
  fallSilent();
  expect(view.complaints).toEqual([]);
  await view.context.close();
});

describe('a console whose program is played', () => {
  it('Before anything comes it says which step it waits for', async () => {
    await begin(3);
    program.isMute = true;
    await page.goto(site.address);
    await page.getByRole('heading', { name: 'Loading' }).waitFor();
    expect(await page.getByText('Connect to the program').isVisible()).toBe(true);
    await keepPicture(page, 'loading');
  });

  it('Silence freezes the picture, drains its colour, counts the age and switches editing off', async () => {
    await beginFlying(4);
    await page.getByRole('radio', { name: 'Point' }).click();
    fallSilent();
    await page.getByTestId('disconnected').waitFor();
    const clock = await page.getByTestId('mission-clock').textContent();
    const youngAge = Number.parseFloat((await page.getByTestId('data-age').textContent())!);
    await expect
      .poll(async () => Number.parseFloat((await page.getByTestId('data-age').textContent())!))
      .toBeGreaterThan(youngAge + 0.5);
    expect(await page.getByTestId('mission-clock').textContent()).toBe(clock);
    expect(await page.getByTestId('badge').textContent()).toBe('STALE');
    expect(await page.getByRole('button', { name: 'LAND ALL' }).isDisabled()).toBe(false);
    expect(await page.getByRole('button', { name: 'Take off' }).isDisabled()).toBe(true);
    expect(await page.getByRole('radio', { name: 'Area' }).isDisabled()).toBe(true);
    expect(await page.getByTestId('disconnected').textContent()).toMatch(/each vehicle hovers and then lands/);
    expect(await page.locator('.map-field').evaluate((map) => getComputedStyle(map).filter)).toMatch(/grayscale/);
    await keepPicture(page, 'disconnected');
    fly();
    await page.getByTestId('disconnected').waitFor({ state: 'detached' });
    expect(await page.getByTestId('badge').textContent()).toBe('SIM');
  });

  it('A connection that breaks is tried again by itself, and the console goes on', async () => {
    await beginFlying(4);
    program.hangUp();
    await page.getByTestId('badge').getByText('STALE').waitFor();
    await page.getByTestId('badge').getByText('SIM').waitFor();
    expect(program.greetings).toBe(2);
  });

  it('Lost drones show a sign, a word and the reason', async () => {
    await beginFlying(5);
    program.drones[1]!.activity = 9;
    program.drones[2]!.activity = 11;
    program.drones[2]!.battery = 0.17;
    program.holding = [[0, 0, 3, 0.41], [3, 1, 0, 0.2]]; // prettier-ignore
    await page.getByRole('row', { name: /d2/ }).getByText('Not tracked').waitFor();
    await page.getByRole('button', { name: 'd2', exact: true }).click();
    expect(await page.getByTestId('why').textContent()).toMatch(/position is too old/);
    await page.getByRole('button', { name: 'd1', exact: true }).click();
    await expect.poll(() => page.getByTestId('held-by').textContent()).toBe('d4, 0.41 m');
    const rows = page.getByRole('region', { name: 'Fleet table' }).getByRole('button');
    await page.getByLabel('Show which drones').selectOption('not active');
    await expect.poll(() => rows.allTextContents()).toEqual(['d2', 'd3']);
    await page.getByLabel('Show which drones').selectOption('held back');
    await expect.poll(() => rows.allTextContents()).toEqual(['d1', 'd4']);
    await page.getByLabel('Show which drones').selectOption('all');
    expect(await page.getByTestId('active-count').textContent()).toMatch('3 of 5 active');
    await keepPicture(page, 'lost_drones');
  });

  it('Rows stay under the hand while what they show changes, and go when it leaves', async () => {
    await beginFlying(5);
    const rows = page.getByRole('region', { name: 'Fleet table' }).getByRole('button');
    program.drones[1]!.activity = program.drones[3]!.activity = 9;
    await page.getByLabel('Show which drones').selectOption('not active');
    await expect.poll(() => rows.allTextContents()).toEqual(['d2', 'd4']);
    await page.getByRole('row', { name: /d4/ }).hover();
    program.drones[1]!.activity = 0;
    program.drones[0]!.activity = 9;
    await expect.poll(() => rows.allTextContents()).toEqual(['d2', 'd4', 'd1']);
    await page.locator('.map-field').hover();
    await expect.poll(() => rows.allTextContents()).toEqual(['d1', 'd4']);
  });

  it('On a tablet the table says when each drone was heard, and every plot what it shows', async () => {
    await beginFlying(5);
    for (const width of [768, 1024]) {
      await page.setViewportSize({ width, height: 900 });
      await page.getByRole('columnheader', { name: 'link' }).waitFor();
      const titles = await page.locator('.plot h3 span').all();
      expect(titles).toHaveLength(4);
      for (const title of titles)
        expect(await title.evaluate((text) => text.scrollWidth <= text.clientWidth)).toBe(true);
      await keepPicture(page, `table_${width}`);
    }
  });

  it('A restarted program waits for somebody to let the drones go on', async () => {
    await beginFlying(3);
    program.drones[0]!.activity = program.drones[2]!.activity = 12;
    program.drones[1]!.activity = 7; // marked failed before the restart, and still
    program.sayStatus({ waits_for_resume: true });
    await page.getByRole('button', { name: 'Resume those that hold' }).click();
    await expect
      .poll(() => program.received.find((message) => message['type'] === 'resume'))
      .toMatchObject({ drones: ['d1', 'd3'], run: '1f', epoch: 1 });
    await keepPicture(page, 'restarted');
  });

  it('A message that the protocol does not allow is reported and breaks nothing', async () => {
    await beginFlying(3);
    program.say({ type: 'status', epoch: 'one' });
    await page.getByText(/something unexpected: status.epoch/).waitFor();
    expect(await page.getByTestId('badge').textContent()).toBe('SIM');
  });

  it('The emergency stop needs its two presses within 0.8 s, or a second of holding', async () => {
    await beginFlying(3);
    const stops = (): number => program.received.filter((message) => message['type'] === 'emergency_stop').length;
    await page.locator('.map-field').focus();
    await page.keyboard.press('.');
    await page.getByText('Press . once more').waitFor();
    await page.locator('.stop.is-armed').waitFor({ state: 'detached' }); // the window has passed
    await page.keyboard.press('.');
    expect(stops()).toBe(0);
    await page.keyboard.press('.');
    await expect.poll(stops).toBe(1);
    const button = page.getByRole('button', { name: /Emergency stop of all drones/ });
    await button.click();
    expect(stops()).toBe(1);
    await button.hover();
    await page.mouse.down();
    await expect.poll(stops).toBe(2);
    await page.mouse.up();
    await keepPicture(page, 'emergency_stop');
  });

  it('Ten thousand drones have a row each, of which only those in view are in the page', async () => {
    await beginFlying(10_000);
    const table = page.getByRole('region', { name: 'Fleet table' });
    expect(await table.getByRole('table').getAttribute('aria-rowcount')).toBe('10001');
    expect(await table.getByRole('row').count()).toBeLessThan(60);
    await table.evaluate((rows) => (rows.scrollTop = rows.scrollHeight));
    await table.getByRole('button', { name: 'd10000', exact: true }).waitFor();
    await keepPicture(page, 'ten_thousand');
  });
});

describe.each(['dark', 'light'] as const)('axe finds nothing in the %s theme', (theme) => {
  beforeEach(async () => {
    await beginFlying(5, { theme });
    program.sayTargets();
    program.sayStatus({});
    program.sayEvents();
    await page.getByTestId('area-east').waitFor();
  });

  it('on the whole page with an area and a drone selected', async () => {
    program.drones[1]!.activity = 9;
    program.drones[2]!.activity = 4;
    await page.getByTestId('area-east').click();
    await page.getByRole('button', { name: 'd1', exact: true }).click();
    await page.getByTestId('why').waitFor();
    await keepPicture(page, `whole_${theme}`);
    expect(await violationsOf(page)).toEqual([]);
  });

  it('with staged edits, layers, menus, help and event log open', async () => {
    await page.getByTestId('area-east').click();
    await page.getByRole('textbox', { name: 'Weight' }).fill('4');
    await page.getByRole('textbox', { name: 'Weight' }).press('Enter');
    await page.getByRole('region', { name: 'Staged edits' }).waitFor();
    for (const menu of ['Layers', 'Mission']) {
      await page.getByRole('button', { name: menu, exact: true }).click();
      expect(await violationsOf(page)).toEqual([]);
      await page.keyboard.press('Escape');
    }
    await page.getByRole('button', { name: 'Event log' }).click();
    await keepPicture(page, `log_${theme}`);
    expect(await violationsOf(page)).toEqual([]);
    await page.getByRole('button', { name: 'Close the event log' }).click();
    await page.getByRole('button', { name: 'Help and keys' }).click();
    await keepPicture(page, `help_${theme}`);
    expect(await violationsOf(page)).toEqual([]);
  });

  it('while disconnected', async () => {
    fallSilent();
    await page.getByTestId('disconnected').waitFor();
    expect(await violationsOf(page)).toEqual([]);
  });
});
