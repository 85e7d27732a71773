import { describe, expect, it } from 'vitest';
import { curveAt } from './curve';

describe('curveAt', () => {
  const along = (share: number, ends: { p0: number; p1: number; v0: number; v1: number }, t: number): number => {
    const at = curveAt(share);
    return at.place0 * ends.p0 + at.place1 * ends.p1 + t * (at.velocity0 * ends.v0 + at.velocity1 * ends.v1);
  };

  it('begins and ends at the places, with the velocities', () => {
    const ends = { p0: 1, p1: 4, v0: -2, v1: 0.5 };
    const h = 1e-6;
    expect(along(0, ends, 3)).toBe(1);
    expect(along(1, ends, 3)).toBeCloseTo(4, 12);
    expect((along(h, ends, 3) - along(0, ends, 3)) / (3 * h)).toBeCloseTo(-2, 4);
    expect((along(1, ends, 3) - along(1 - h, ends, 3)) / (3 * h)).toBeCloseTo(0.5, 4);
  });

  it('is exact for whatever accelerates evenly', () => {
    const place = (t: number): number => 2 + 3 * t - 0.7 * t ** 2;
    const ends = { p0: place(0), p1: place(2), v0: 3, v1: 3 - 1.4 * 2 };
    for (const share of [0.1, 0.5, 0.9]) expect(along(share, ends, 2)).toBeCloseTo(place(2 * share), 12);
  });
});
