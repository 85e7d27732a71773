import { describe, expect, it } from 'vitest';
import { keepPicture } from './chromium';
import { FakeProgram } from './fake_program';
import { usePlayedPage } from './played_page';

/** What must stay whole in small windows and with long names. */

const played = usePlayedPage();

let program: FakeProgram;

function begin(width: number, height: number, missionName: string): Promise<void> {
  program = new FakeProgram(4, [3, 3]);
  program.missionName = missionName;
  return played.begin(program, { width, height });
}

const kLongName = 'north slope and valley, second watch of the night, burning to 7b';

/** What of the top bar is cut, too small, or outside of the window. */
const faultsOfTopBar = (): Promise<string[]> =>
  played.page.evaluate(() => {
    const faults: string[] = [];
    if (document.documentElement.scrollWidth > innerWidth)
      faults.push(`the page is ${document.documentElement.scrollWidth} px wide`);
    const top = document.querySelector<HTMLElement>('.top')!;
    if (top.scrollWidth > top.clientWidth) faults.push(`the bar is ${top.scrollWidth} px wide`);
    for (const [name, least] of [
      ['.land-all', 44],
      ['.stop', 44],
      ['.top select', 60],
    ] as const) {
      // prettier-ignore
      const element = document.querySelector<HTMLElement>(name)!;
      const box = element.getBoundingClientRect();
      const isWhole = box.left >= 0 && box.top >= 0 && box.right <= innerWidth && box.bottom <= innerHeight;
      if (!isWhole) faults.push(`${name} ends at ${box.right} px`);
      if (box.width < least || box.height < 44) faults.push(`${name} is ${box.width} x ${box.height} px`);
      if (name !== '.top select' && element.scrollWidth > element.clientWidth) faults.push(`${name} cuts its words`);
      const over = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
      if (!over || !element.contains(over)) faults.push(`${name} is covered`);
    }
    const mission = document.querySelector('.top .brand')!.getBoundingClientRect();
    if (mission.width < 44) faults.push(`the mission's name has ${mission.width} px`);
    return faults;
  });

describe.each(['paper', kLongName])('with the mission “%s”', (name) => {
  it.each([
    [1440, 900],
    [1366, 768],
    [1024, 768],
    [768, 1024],
    [400, 800],
    [360, 740],
  ])('the alarms are whole at %i x %i', async (width, height) => {
    await begin(width, height, name);
    await keepPicture(played.page, `top_${width}${name === kLongName ? '_long' : ''}`);
    expect(await faultsOfTopBar()).toEqual([]);
  });
});

it.each([
  [1366, 768],
  [1024, 768],
  [768, 1024],
  [400, 800],
  [360, 640],
])('Nothing lies over the alarms at %i x %i, whatever is told', async (width, height) => {
  await begin(width, height, 'paper');
  for (let number = 2; number < 9; number++) program.sayDeed(number, 'Ben', 'emergency_stop');
  await played.page.getByTestId('notices').getByText('Ben').first().waitFor();
  await keepPicture(played.page, `told_${width}`);
  expect(await faultsOfTopBar()).toEqual([]);
  // A narrow page scrolls: its alarms stay within reach.
  await played.page.evaluate(() => window.scrollTo(0, document.body.scrollHeight));
  expect(await faultsOfTopBar()).toEqual([]);
});

it('The top bar never overflows from 360 px up', async () => {
  await begin(1440, 800, kLongName);
  for (let width = 360; width <= 1440; width += 40) {
    await played.page.setViewportSize({ width, height: 800 });
    expect([width, ...(await faultsOfTopBar())]).toEqual([width]);
  }
});

it('What a narrow top bar folds away is in its menu', async () => {
  await begin(1024, 768, 'paper');
  await played.page.getByRole('button', { name: 'More' }).click();
  await played.page.getByRole('button', { name: 'Help and keys' }).click();
  await played.page.getByRole('dialog').waitFor();
});
