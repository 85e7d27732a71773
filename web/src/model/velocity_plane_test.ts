import { describe, expect, it } from 'vitest';
import type { Why, WhyRow } from '../link/messages';
import { chordOf, forbiddenPath, placeOf, planeOf } from './velocity_plane';

const plane = { extent: 1, radius: 0.5 };
const row = (normal: readonly [number, number], offset: number): WhyRow =>
  ({ normal, offset_m_s: offset }) as unknown as WhyRow;
const wanted = (u: readonly [number, number]): Why => ({ u_max_m_s: 0.5, u_nom_m_s: u }) as unknown as Why;

/** Where a picture's place lies in the plane of velocities. */
const back = ([x, y]: readonly [number, number]): [number, number] => [
  (x * plane.extent) / 100,
  (-y * plane.extent) / 100,
];

describe('the plane of velocities', () => {
  it('A place is up where its velocity is', () => {
    expect(placeOf([0.25, 0.5], plane)).toEqual([25, -50]);
  });

  it('An edge ends on the disk and keeps its row exactly', () => {
    for (const [normal, offset] of [
      [[1, 0], 0.2],
      [[0, -1], -0.3],
      [[0.6, 0.8], 0],
    ] as const)
      // prettier-ignore
      for (const end of chordOf(row(normal, offset), plane)!) {
        const u = back(end);
        expect(Math.hypot(...u)).toBeCloseTo(0.5, 12);
        expect(normal[0] * u[0] + normal[1] * u[1]).toBeCloseTo(offset, 12);
      }
  });

  it('The arc runs clockwise from the first end over what is forbidden, the long way where that is most of the disk', () => {
    // Forbidden is the left half: from the bottom end clockwise over the left to the top.
    expect(forbiddenPath(row([1, 0], 0), plane)).toBe('M0.00 50.00A50.00 50.00 0 0 1 0.00 -50.00Z');
    expect(forbiddenPath(row([1, 0], 0.3), plane)).toBe('M30.00 40.00A50.00 50.00 0 1 1 30.00 -40.00Z');
    expect(forbiddenPath(row([1, 0], -0.3), plane)).toBe('M-30.00 40.00A50.00 50.00 0 0 1 -30.00 -40.00Z');
  });

  it('A row that no velocity of the disk breaks forbids nothing, one that none keeps all of it', () => {
    expect(forbiddenPath(row([0, 1], -0.5), plane)).toBe('');
    expect(chordOf(row([0, 1], -0.6), plane)).toBeNull();
    expect(forbiddenPath(row([0, 1], 0.6), plane)).toMatch(/^M-50 0A.*Z$/);
  });

  it('There is room for what was wanted, up to twice the disk', () => {
    expect(planeOf(wanted([0.1, 0])).extent).toBeCloseTo(0.59);
    expect(planeOf(wanted([0, 0.75])).extent).toBeCloseTo(0.885);
    expect(planeOf(wanted([9, 0])).extent).toBeCloseTo(1.18);
    expect(planeOf(wanted([NaN, 0])).extent).toBeCloseTo(0.59);
  });
});
