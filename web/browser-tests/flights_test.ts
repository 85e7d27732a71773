import { beforeEach, describe, expect, it } from 'vitest';
import { keepPicture } from './chromium';
import { FakeProgram } from './fake_program';
import { usePlayedPage } from './played_page';

/** What the page says where the program was restarted, where orders wait, and where nothing is watched. */

const played = usePlayedPage();
let program: FakeProgram;

beforeEach(() => {
  program = new FakeProgram(3, [3, 3]);
});

const begin = (width = 1366, height = 768): Promise<void> => played.begin(program, { width, height });
const notices = () => played.page.getByTestId('notices');
const held = 12;

/** What a mouse would meet at the middle of what is shown by this selector. */
const isWithinReach = (selector: string): Promise<boolean> =>
  played.page.evaluate((wanted) => {
    const element = document.querySelector(wanted)!;
    const { left, top, width, height } = element.getBoundingClientRect();
    const met = document.elementFromPoint(left + width / 2, top + height / 2);
    return met !== null && element.contains(met);
  }, selector);

describe('a restarted program', () => {
  it('is told and stays told; what was chosen is let go, and the log parts the flights', async () => {
    await begin();
    program.sayDeed(1, 'Ben', 'hold');
    program.sayDeed(2, 'Ben', 'emergency_stop');
    await notices().getByText('EMERGENCY STOP by Ben').waitFor();
    await played.page.keyboard.press('2');
    await played.page.getByRole('button', { name: 'Stop motors of d2 (hold)' }).waitFor();
    program.run = '20';
    program.hangUp();
    await notices().getByText('The program was restarted and flies played again').waitFor();
    await notices().getByText('EMERGENCY STOP by Ben').waitFor({ state: 'detached' });
    await played.page.getByRole('button', { name: 'Stop motors of d2 (hold)' }).waitFor({ state: 'detached' });
    program.sayDeed(1, 'Ben', 'land_all');
    await notices().getByText('LAND ALL by Ben').waitFor();
    expect(await played.page.locator('.timeline .mark').count()).toBe(1);
    await played.page.getByRole('button', { name: 'Events' }).click();
    await played.page.getByText('Before this, until the program was restarted').waitFor();
    await keepPicture(played.page, 'restart_told');
  });

  it('is told of as long as drones hold since then, or until they are meant to', async () => {
    await begin();
    for (const drone of program.drones) drone.activity = held;
    program.sayStatus({ waits_for_resume: true });
    await played.page.getByText('It has its mission, targets and coverage back').waitFor();
    // Until the page has seen that they hold.
    await played.page.getByRole('button', { name: 'Resume those that hold', disabled: false }).waitFor();
    program.drones[0]!.activity = 0;
    program.sayStatus({ waits_for_resume: false });
    await played.page.getByText('2 of 3 drones hold since then: d2, d3.').waitFor();
    await keepPicture(played.page, 'restart_still_held');
    program.drones[1]!.activity = 0;
    await played.page.getByText('1 of 3 drones holds since then: d3.').waitFor();
    await played.page.getByRole('button', { name: 'Let them hold' }).click();
    await played.page.getByText('since then').waitFor({ state: 'detached' });
  });
});

describe('orders that wait', () => {
  const waiting = [
    { text: 'LAND ALL', from: 'Ana' },
    { text: 'hold d1', from: 'Ben' },
  ];

  it.each([
    [1366, 768],
    [400, 800],
  ])('are shown to everybody at %i x %i, whatever else is said, and cover no alarm', async (width, height) => {
    await begin(width, height);
    program.sayStatus({ waiting, waiting_more: 3 });
    const said = played.page.getByTestId('waiting');
    await said.getByText('Not done yet: LAND ALL (Ana); hold d1 (Ben); and 3 more.').waitFor();
    for (let number = 2; number < 12; number++) program.sayDeed(number, 'Ben', number % 2 ? 'hold' : 'land_all');
    await notices().getByText('LAND ALL by Ben').first().waitFor();
    for (const selector of ['[data-testid=waiting]', '.notice button', '.land-all', '.stop'])
      expect([selector, await isWithinReach(selector)]).toEqual([selector, true]);
    await keepPicture(played.page, `waiting_${width}`);
    program.sayStatus({ waiting: [], waiting_more: 0 });
    await said.waitFor({ state: 'detached' });
  });
});

it('The card of an empty field leaves the field’s middle in view', async () => {
  program.uniformFloor = 0;
  await begin();
  await played.page.getByRole('heading', { name: 'Drop points on the field to start' }).waitFor();
  await played.page.getByText('Nothing is watched, so the active drones hover.').waitFor();
  for (const selector of ['.map-field', '[aria-label="Look ahead"]'])
    expect([selector, await isWithinReach(selector)]).toEqual([selector, true]);
  for (const drone of program.drones) drone.activity = 2;
  await played.page.getByText('Nothing is watched, and no drone is active.').waitFor();
  await keepPicture(played.page, 'empty_field');
});
