import { describe, expect, it } from 'vitest';
import { Ring } from './ring';

describe('ring', () => {
  it('The oldest sample makes room for the newest', () => {
    const ring = new Ring(3, 1);
    for (let t = 0; t < 5; t++) ring.push(t, [10 * t]);
    expect(ring.columns(-Infinity)).toEqual([
      [2, 3, 4],
      [20, 30, 40],
    ]);
  });

  it('A gap is null, and what is older than asked for is left out', () => {
    const ring = new Ring(10, 2);
    ring.push(1, [1, NaN]);
    ring.push(2, [2, 5]);
    expect(ring.columns(1.5)).toEqual([[2], [2], [5]]);
    expect(ring.columns(0)[2]).toEqual([null, 5]);
    expect(ring.newest(0)).toBe(2);
  });

  it('A sample that is not newer is left out; a clock that starts anew empties the ring', () => {
    const ring = new Ring(10, 1);
    ring.push(50, [1]);
    ring.push(50, [2]);
    ring.push(49.9, [3]);
    expect(ring.columns(0)).toEqual([[50], [1]]);
    ring.push(0.02, [4]);
    expect(ring.columns(0)).toEqual([[0.02], [4]]);
  });
});
