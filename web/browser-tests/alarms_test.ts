import { beforeEach, describe, expect, it } from 'vitest';
import { FakeProgram } from './fake_program';
import { usePlayedPage } from './played_page';

/** LAND ALL and the emergency stop, wherever the focus is. */

const played = usePlayedPage();
let program: FakeProgram;

beforeEach(async () => {
  program = new FakeProgram(3, [3, 3]);
  await played.begin(program);
  program.sayTargets();
  await played.page.getByTestId('area-east').click();
});

const sent = (type: string): number => program.received.filter((message) => message['type'] === type).length;
const field = (name: string) => played.page.getByRole('textbox', { name, exact: true });
/** The keys of an alarm in quick succession, as a hand presses them: one call, whatever else the machine does. */
const pressDotTwice = (name: string) =>
  field(name).evaluate((input: HTMLInputElement) => {
    for (let i = 0; i < 2; i++) {
      const press = new KeyboardEvent('keydown', { key: '.', bubbles: true, cancelable: true });
      if (!input.dispatchEvent(press)) continue;
      input.value += '.';
      input.dispatchEvent(new Event('input', { bubbles: true }));
    }
  });

describe('keys while a field has the focus', () => {
  it('Enter takes a number and leaves its field; the next Enter commits', async () => {
    await played.page.keyboard.press('e');
    await played.page.keyboard.press('Tab');
    await played.page.keyboard.type('4');
    await played.page.keyboard.press('Enter');
    await played.page.getByRole('region', { name: 'Staged edits' }).waitFor();
    await played.page.keyboard.press('Enter');
    await expect.poll(() => sent('edit')).toBe(1);
  });

  it('Escape leaves a number and a name as they were; the next Escape is the page’s', async () => {
    for (const [name, was] of [
      ['Weight', '2'],
      ['Name', 'east'],
    ] as const) {
      // prettier-ignore
      await field(name).fill('7');
      await field(name).press('Escape');
      expect(await field(name).inputValue()).toBe(was);
      expect(await field(name).evaluate((input) => document.activeElement === input)).toBe(false);
    }
    expect(await played.page.getByRole('region', { name: 'Staged edits' }).count()).toBe(0);
    await played.page.keyboard.press('Escape');
    await field('Weight').waitFor({ state: 'detached' });
  });

  it('Shift+L in a number lands all', async () => {
    await field('Weight').focus();
    await played.page.keyboard.press('Shift+L');
    await expect.poll(() => sent('land_all')).toBe(1);
    expect(await field('Weight').inputValue()).toBe('2');
  });

  it('Two dots in a number stop the motors and leave the number alone', async () => {
    await field('Weight').focus();
    await pressDotTwice('Weight');
    await expect.poll(() => sent('emergency_stop')).toBe(1);
    expect(await field('Weight').inputValue()).toBe('2');
  });

  it('Decimals typed fast stop nothing', async () => {
    await field('Weight').focus();
    await played.page.keyboard.type('0.5.');
    await played.page.keyboard.press('Tab');
    await played.page.keyboard.type('1.5');
    await played.page.keyboard.press('Escape');
    await played.page.keyboard.press('Escape');
    expect(sent('emergency_stop')).toBe(0);
  });

  it('In a name both are text, and two dots are answered with what to do', async () => {
    await field('Name').focus();
    await played.page.keyboard.press('Shift+L');
    await pressDotTwice('Name');
    await played.page.getByText(/No emergency stop: the keys went into the field/).waitFor();
    expect(await field('Name').inputValue()).toMatch(/L\.\.$/);
    expect(sent('land_all') + sent('emergency_stop')).toBe(0);
  });
});

it('Motors of one drone are stopped in the flight that is shown only; those of all in any', async () => {
  await played.page.keyboard.press('Escape');
  await played.page.keyboard.press('1');
  const hold = async (name: string): Promise<Record<string, unknown> | undefined> => {
    const before = sent('emergency_stop');
    await played.page.getByRole('button', { name }).focus();
    await played.page.keyboard.down(' ');
    await expect.poll(() => sent('emergency_stop')).toBe(before + 1);
    await played.page.keyboard.up(' ');
    return program.received.filter((message) => message['type'] === 'emergency_stop').at(-1);
  };
  expect(await hold('Stop motors of d1 (hold)')).toMatchObject({ drones: ['d1'], run: '1f', epoch: 1 });
  expect(await hold('Emergency stop of all drones')).not.toHaveProperty('run');
});

it('A button that is held for one drone does not stop it once another is chosen', async () => {
  await played.page.keyboard.press('Escape');
  await played.page.keyboard.press('1');
  await played.page.getByRole('button', { name: 'Stop motors of d1 (hold)' }).hover();
  await played.page.mouse.down();
  await played.page.keyboard.press('3');
  await played.page.getByRole('button', { name: 'Stop motors of d3 (hold)' }).waitFor();
  await new Promise((done) => setTimeout(done, 1200)); // longer than the button wants to be held
  await played.page.mouse.up();
  expect(sent('emergency_stop')).toBe(0);
});
