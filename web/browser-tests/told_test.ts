import { beforeEach, describe, expect, it } from 'vitest';
import { keepPicture } from './chromium';
import { FakeProgram } from './fake_program';
import { usePlayedPage } from './played_page';

/** What the page tells the person in front of it, and when. */

const played = usePlayedPage();
let program: FakeProgram;

beforeEach(() => {
  program = new FakeProgram(3, [3, 3]);
});

const begin = (width = 1366): Promise<void> => played.begin(program, { width, height: 768 });
const sent = (type: string): number => program.received.filter((message) => message['type'] === type).length;
const notices = () => played.page.getByTestId('notices');

describe('alarms', () => {
  it('Another operator’s emergency stop names who did it and stays until it is dismissed', async () => {
    await begin();
    program.sayDeed(1, 'Ben', 'hold');
    program.sayDeed(2, 'Ben', 'emergency_stop');
    const alarm = notices().getByText('EMERGENCY STOP by Ben: motors off, all drones.');
    await alarm.waitFor();
    for (let number = 3; number < 8; number++) program.sayDeed(number, 'Ben', 'hold');
    await notices().getByText('Ben: hold all').first().waitFor();
    await keepPicture(played.page, 'told_stop');
    await notices().getByText('Ben: hold all').first().waitFor({ state: 'detached' });
    await notices().getByRole('button', { name: 'Dismiss this message' }).click();
    await alarm.waitFor({ state: 'detached' });
  });

  it('More alarms than fit are counted, and all of them can be dismissed at once', async () => {
    await begin();
    for (let number = 1; number < 7; number++) program.sayDeed(number, 'Ben', 'land_all');
    await notices().getByText('and 2 older alarms').waitFor();
    await notices().getByRole('button', { name: 'Dismiss all' }).click();
    await expect.poll(() => notices().textContent()).toBe('');
  });

  it('A short click on EMERGENCY STOP stops nothing and says so', async () => {
    await begin();
    const stop = played.page.getByRole('button', { name: 'Emergency stop of all drones' });
    // Down and up in one call: the time between them is not the machine's.
    await stop.evaluate((button) => {
      for (const type of ['pointerdown', 'pointerup'])
        button.dispatchEvent(new PointerEvent(type, { bubbles: true, button: 0 }));
    });
    await notices().getByText('No motor was stopped: hold the button for one second').waitFor();
    expect(sent('emergency_stop')).toBe(0);
  });

  it('What the first press of . asks for is gone with the second', async () => {
    await begin();
    const asked = await played.page.evaluate(async () => {
      const press = () => document.body.dispatchEvent(new KeyboardEvent('keydown', { key: '.', bubbles: true }));
      const drawn = () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
      const isAsked = () => /Press \. once more/.test(document.querySelector('.notices')!.textContent ?? '');
      press();
      await drawn();
      const first = isAsked();
      press();
      await drawn();
      return [first, isAsked()];
    });
    expect(asked).toEqual([true, false]);
    await expect.poll(() => sent('emergency_stop')).toBe(1);
  });
});

describe('what is said', () => {
  it('A program that was ended goes on covering nothing', async () => {
    await begin();
    played.freeze();
    program.isMute = true;
    program.say({ type: 'bye', code: 'ending', reason: 'the program ends' });
    program.hangUp();
    const banner = played.page.getByTestId('disconnected');
    await banner.getByText('Its simulated drones ended with it').waitFor();
    expect(await banner.textContent()).not.toMatch(/goes on covering/);
    await keepPicture(played.page, 'told_ended');
  });

  it('Keys of orders want a selection, and the panel says so while there is none', async () => {
    await begin();
    await played.page.getByTestId('keys-want-selection').waitFor();
    await played.page.locator('.map-field').focus();
    await played.page.keyboard.press('t');
    await notices().getByText('Keys order the selected drones, and none is').waitFor();
    await played.page.keyboard.press('Control+a');
    await played.page.getByTestId('keys-want-selection').waitFor({ state: 'detached' });
    await played.page.keyboard.press('t');
    await expect.poll(() => sent('take_off')).toBe(1);
  });
});

/** Cells of the fleet's table whose text is cut, but for names, which are cut in their middles. */
const cutCells = (): Promise<string[]> =>
  played.page.evaluate(() =>
    [...document.querySelectorAll<HTMLElement>('.fleet tbody td')]
      .filter((cell) => cell.offsetParent !== null && cell.scrollWidth > cell.clientWidth)
      .map((cell) => cell.textContent ?? ''),
  );

describe('the fleet’s table', () => {
  it.each([1440, 1366, 1024, 400])('cuts no cell at %i px, and of long names their middles', async (width) => {
    program.idOf = (drone) => `north-slope-scout-${drone + 1}`;
    program.holding = [[0, 0, 1, 0.3]];
    program.origin = [-1200, -3400];
    await begin(width);
    const button = played.page.getByRole('button', { name: 'north-slope-scout-2', exact: true });
    await button.waitFor();
    const tail = button.getByText('ut-2');
    const [inner, outer] = [await tail.boundingBox(), await button.boundingBox()];
    expect(inner!.x + inner!.width).toBeLessThanOrEqual(outer!.x + outer!.width);
    expect(await cutCells()).toEqual([]);
    await keepPicture(played.page, `told_fleet_${width}`);
  });
});
