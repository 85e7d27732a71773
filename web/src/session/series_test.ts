import { describe, expect, it } from 'vitest';
import type { Snapshot } from '../link/frames';
import { Series } from './series';

/** Three drones in a row, a metre apart; `modes`: 1 on the ground, 3 flying. */
const inARow = (timeS: number, modes: number[]): Snapshot =>
  ({
    n: 3,
    timeS,
    position: new Float32Array([0, 0, 1, 0, 2, 0]),
    command: new Float32Array(6),
    mode: new Uint8Array(modes),
  }) as unknown as Snapshot;

describe('series', () => {
  it('The distance of a pair is shown while both are in the air', () => {
    const series = new Series();
    series.reset(3);
    series.take(inARow(1, [3, 3, 3]));
    series.take(inARow(2, [3, 1, 3]));
    expect(series.pairs.columns(0)).toEqual([
      [1, 2],
      [1, null],
      [2, 2],
      [1, null],
    ]);
  });
});
