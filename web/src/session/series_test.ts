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
    expect(series.ofPairs('recent')).toEqual([
      [1, 2],
      [1, null],
      [2, 2],
      [1, null],
    ]);
  });

  it('A history from the program is what was shown from the beginning on, and what comes next goes on from it', () => {
    const series = new Series();
    series.take(inARow(400, [3, 3, 3]));
    const time = new Float64Array([0.5, 1, 1.5]);
    // Column by column: five of the swarm, a speed of each drone, a distance of each pair.
    const values = Float32Array.from({ length: 11 * 3 }, (_, i) => i);
    values[8 * 3 + 1] = NaN;
    series.fill({ kind: 'history', epoch: 1, n: 3, plotted: 3, columns: 11, spacingS: 0.5, time, values }, 3);
    expect(series.ofSwarm(0, 'whole')).toEqual([[0.5, 1, 1.5], [0, 1, 2]]); // prettier-ignore
    expect(series.ofInputs('whole')[1]).toEqual([15, 16, 17]);
    expect(series.ofPairs('recent')[1]).toEqual([24, null, 26]);
    series.take(inARow(2, [3, 3, 3]));
    expect(series.ofPairs('whole').map((column) => column[3])).toEqual([2, 1, 2, 1]);
    series.take(inARow(0.2, [3, 3, 3])); // the flight was begun anew
    expect(series.ofSwarm(0, 'whole')[0]).toEqual([0.2]);
  });

  it('Of a history of another number of drones nothing is shown', () => {
    const series = new Series();
    const none = { time: new Float64Array([1]), values: new Float32Array(5) };
    series.fill({ kind: 'history', epoch: 1, n: 1, plotted: 0, columns: 5, spacingS: 1, ...none }, 3);
    expect(series.ofSwarm(0, 'whole')[0]).toEqual([]);
  });
});
