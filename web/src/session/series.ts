import type { Snapshot } from '../link/frames';
import { isAirborne, speedOf, vectorOf } from '../model/drones';
import { Ring } from '../model/ring';

/** What the plots show over mission time. Pairs and control inputs only for swarms small enough to read them. */
export const kMostPlotted = 6;
const kSamples = 3000;
const kSpacingS = 0.1;

export class Series {
  /** metric (percent), worst age (s), least distance of two drones in the air (m), active drones, fastest command (m/s). */
  readonly swarm = new Ring(kSamples, 5);
  /** Distances of the pairs 1-2, 1-3, ..., 2-3, ...: m; NaN unless both are in the air, where alone R_s holds. */
  pairs = new Ring(kSamples, 0);
  /** |u| of each drone, m/s. */
  inputs = new Ring(kSamples, 0);
  private drones = 0;

  reset(drones: number): void {
    this.drones = drones <= kMostPlotted ? drones : 0;
    this.swarm.clear();
    this.pairs = new Ring(kSamples, (this.drones * (this.drones - 1)) / 2);
    this.inputs = new Ring(kSamples, this.drones);
  }

  take(snapshot: Snapshot): void {
    const newest = this.swarm.newestTime;
    const time = snapshot.timeS;
    if (newest !== null && time > newest - 1 && time < newest + kSpacingS) return;
    const percent = snapshot.hasMetric ? snapshot.metricPercent : NaN;
    this.swarm.push(time, [percent, snapshot.worstAgeS, snapshot.leastPairM, snapshot.active, fastest(snapshot)]);
    if (this.drones === 0) return;
    this.inputs.push(
      time,
      Array.from({ length: this.drones }, (_, i) => speedOf(snapshot, i, 'command')),
    );
    this.pairs.push(time, this.pairDistances(snapshot));
  }

  private pairDistances(snapshot: Snapshot): number[] {
    const p = snapshot.position;
    const between = (i: number, j: number) =>
      isAirborne(snapshot, i) && isAirborne(snapshot, j)
        ? Math.hypot(p[2 * i]! - p[2 * j]!, p[2 * i + 1]! - p[2 * j + 1]!)
        : NaN;
    const drones = Array.from({ length: this.drones }, (_, i) => i);
    return drones.flatMap((i) => drones.slice(i + 1).map((j) => between(i, j)));
  }

  /** Names of the pairs, in their order. */
  static pairNames(ids: readonly string[]): string[] {
    return ids.flatMap((a, i) => ids.slice(i + 1).map((b) => `${a}–${b}`));
  }
}

function fastest(snapshot: Snapshot): number {
  let most = 0;
  for (let i = 0; i < snapshot.n; i++) most = Math.max(most, Math.hypot(...vectorOf(snapshot, i, 'command')));
  return most;
}
