import { describe, expect, it } from 'vitest';
import { violationsOf } from './axe';
import { keepPicture } from './chromium';
import { FakeProgram } from './fake_program';
import { usePlayedPage } from './played_page';

/** What becomes of the areas, and who is away, when drones are lost or charged. */

const played = usePlayedPage();

const kLateRidge = {
  kind: 'area',
  name: 'ridge',
  age_s: 3,
  worst_s: 14,
  deadline_s: 30,
  is_overdue: false,
  asked: 0.4,
  achieved: 0.3,
  foreseen_s: 95,
};

async function beginWithTargets(): Promise<FakeProgram> {
  const program = new FakeProgram(3, [3, 3]);
  program.stations = [{ name: 'west', pads_m: [[0.3, 0.3], [0.3, 1]] }]; // prettier-ignore
  await played.begin(program);
  program.sayTargets();
  program.sayStatus({ areas: [kLateRidge], plan: [] });
  return program;
}

describe('fewer drones', () => {
  it('An area says by how much it will be late, and not what is within the error of an outlook', async () => {
    const program = await beginWithTargets();
    const row = played.page.getByTestId('area-ridge');
    await row.getByText('will be late by 1:05').waitFor();
    program.sayStatus({ areas: [{ ...kLateRidge, foreseen_s: 35 }], plan: [] });
    await row.getByText('will be late').waitFor({ state: 'detached' });
  });

  it('An area is protected by a tick mark, which is staged like every edit', async () => {
    const program = await beginWithTargets();
    const row = played.page.getByTestId('area-ridge');
    await row.click();
    await played.page.getByLabel('Keeps its drones where there are fewer').check();
    await row.getByText('protected').waitFor({ state: 'attached' });
    await row.getByText('staged').waitFor();
    await played.page.getByRole('region', { name: 'Staged edits' }).getByRole('button', { name: 'Commit' }).click();
    await expect.poll(() => program.received.find((one) => one['type'] === 'edit')).toBeTruthy();
    const edit = program.received.find((one) => one['type'] === 'edit')!;
    expect(edit['edits']).toEqual([{ op: 'set_protect', kind: 'area', name: 'ridge', protect: true }]);
  });

  it('The next hour shows who is away, who goes when, and when each is back', async () => {
    const program = await beginWithTargets();
    const hour = played.page.getByRole('region', { name: 'Charging in the next hour' });
    await hour.getByText('Nobody needs to be charged yet.').waitFor();
    program.sayStatus({
      plan: [
        { drone: 0, pad: 1, leaves_in_s: 0, back_in_s: 300 },
        { drone: 2, pad: null, leaves_in_s: 900, back_in_s: 1500 },
      ],
    });
    await hour.getByRole('img', { name: 'away, west 2, covers again in 5:00' }).waitFor();
    await hour.getByRole('img', { name: 'leaves in 15:00, covers again in 25:00' }).waitFor();
    await keepPicture(played.page, 'charging');
    expect(await violationsOf(played.page)).toEqual([]);
  });

  it('Without stations there is no such panel', async () => {
    const program = new FakeProgram(3, [3, 3]);
    await played.begin(program);
    program.sayStatus({ plan: [] });
    await played.page.getByTestId('area-ridge').waitFor({ state: 'detached' });
    expect(await played.page.getByRole('region', { name: 'Charging in the next hour' }).count()).toBe(0);
  });
});
