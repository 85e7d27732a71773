import { describe, expect, it } from 'vitest';
import type { Preview } from '../link/messages';
import { areaLines, last, trailAhead } from './outlook';

const area = (name: string, seen_in_s: number | null) => ({
  kind: 'area' as const,
  name,
  asked: 0.5,
  achieved: 0.4,
  covered_in_s: null,
  seen_in_s,
  worst_age_s: 3,
  deadline_s: null,
});
const outlook = (...areas: ReturnType<typeof area>[]): Preview['as_is'] => ({
  in_s: [0, 1],
  metric_percent: [9, 8],
  worst_age_s: [1, 2],
  areas,
  least_pair_m: null,
  active: 2,
});

describe('areaLines', () => {
  it('Areas that are new and areas that would be gone have one side only', () => {
    const preview = { as_is: outlook(area('a', 1), area('gone', 2)), what_if: outlook(area('a', 3), area('new', 4)) };
    const lines = areaLines(preview as unknown as Preview);
    expect(lines.map((line) => [line.name, line.asIs?.seen_in_s, line.whatIf?.seen_in_s])).toEqual([
      ['a', 1, 3],
      ['gone', 2, undefined],
      ['new', undefined, 4],
    ]);
  });

  it('Without anything tried there is one side', () => {
    const lines = areaLines({ as_is: outlook(area('a', 1)), what_if: null } as unknown as Preview);
    expect(lines.map((line) => line.whatIf)).toEqual([null]);
  });
});

describe('trailAhead', () => {
  const xy = [0, 0, 2, 0, 4, 0];

  it('What has been flown since is no longer ahead', () => {
    expect(trailAhead(xy, 2, 0, 60)).toEqual([[0, 0], [2, 0], [4, 0]]); // prettier-ignore
    expect(trailAhead(xy, 2, 1, 60)).toEqual([[1, 0], [2, 0], [4, 0]]); // prettier-ignore
    expect(trailAhead(xy, 2, 2, 60)).toEqual([[2, 0], [4, 0]]); // prettier-ignore
  });

  it('Only so many seconds of it are ahead, from where the drone would be by now', () => {
    expect(trailAhead(xy, 2, 0, 2)).toEqual([[0, 0], [2, 0]]); // prettier-ignore
    expect(trailAhead(xy, 2, 1, 2)).toEqual([[1, 0], [2, 0]]); // prettier-ignore
    expect(trailAhead(xy, 2, 2, 2)).toEqual([[2, 0], [4, 0]]); // prettier-ignore
  });

  it('After its end only its end is left', () => {
    expect(trailAhead(xy, 2, 99, 60)).toEqual([[4, 0]]);
  });

  it('A drone that was never seen has no trail', () => {
    expect(trailAhead([null, null, null, null], 2, 0, 60)).toEqual([]);
  });
});

describe('last', () => {
  it('It is the last value, if there is one', () => {
    expect(last([1, 2])).toBe(2);
    expect(last([])).toBe(null);
  });
});
