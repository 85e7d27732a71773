import type { History, Snapshot } from '../link/frames';
import { isAirborne, speedOf, vectorOf } from '../model/drones';
import { Chronicle, type Kept } from '../model/chronicle';
import { Ring } from '../model/ring';

/** What the plots show over mission time. Pairs and control inputs only for swarms small enough to read them. */
export const kMostPlotted = 6;
const kSamples = 3000;
const kOfWhole = 2000;
const kSpacingS = 0.1;
const kOfSwarm: readonly Kept[] = ['last', 'most', 'least', 'least', 'most'];

/** How much of the flight plots show. */
export type Span = 'whole' | 'recent';
export const kRecentS = 120;

export type Columns = [number[], ...(number | null)[][]];

export class Series {
  /** metric (percent), worst age (s), least distance of two drones in the air (m), active drones, fastest command (m/s). */
  private swarm = new Twofold(kOfSwarm);
  /** Distances of the pairs 1-2, 1-3, ..., 2-3, ...: m; NaN unless both are in the air, where alone R_s holds. */
  private pairs = new Twofold([]);
  /** |u| of each drone, m/s. */
  private inputs = new Twofold([]);
  private drones = 0;

  reset(drones: number, spacingS = kSpacingS): void {
    this.drones = drones <= kMostPlotted ? drones : 0;
    this.swarm = new Twofold(kOfSwarm, spacingS);
    this.pairs = new Twofold(
      Array.from({ length: pairsOf(this.drones) }, () => 'least'),
      spacingS,
    );
    this.inputs = new Twofold(
      Array.from({ length: this.drones }, () => 'most'),
      spacingS,
    );
  }

  /** What was shown until now is of elsewhere, or has gaps: this is the flight from its beginning on. */
  fill(history: History, drones: number): void {
    this.reset(drones, history.spacingS);
    if (history.plotted !== this.drones) return;
    history.time.forEach((time, row) => {
      const values = Array.from({ length: history.columns }, (_, column) => history.values[column * history.n + row]!);
      this.push(time, values);
    });
  }

  take(snapshot: Snapshot): void {
    const newest = this.swarm.recent.newestTime;
    const time = snapshot.timeS;
    if (newest !== null && time > newest - 1 && time < newest + kSpacingS) return;
    if (newest !== null && time <= newest - 1) this.reset(this.drones);
    const percent = snapshot.hasMetric ? snapshot.metricPercent : NaN;
    const inputs = Array.from({ length: this.drones }, (_, i) => speedOf(snapshot, i, 'command'));
    const ofSwarm = [percent, snapshot.worstAgeS, snapshot.leastPairM, snapshot.active, fastest(snapshot)];
    this.push(time, [...ofSwarm, ...inputs, ...this.pairDistances(snapshot)]);
  }

  /** The columns of the protocol's history. */
  private push(time: number, values: readonly number[]): void {
    const firstPair = kOfSwarm.length + this.drones;
    this.swarm.push(time, values.slice(0, kOfSwarm.length));
    if (this.drones === 0) return;
    this.inputs.push(time, values.slice(kOfSwarm.length, firstPair));
    this.pairs.push(time, values.slice(firstPair));
  }

  /** One of the swarm's series, counted from 0. */
  ofSwarm(series: number, span: Span): Columns {
    const all = this.swarm.columns(span);
    return [all[0], all[series + 1]!];
  }
  ofPairs = (span: Span): Columns => this.pairs.columns(span);
  ofInputs = (span: Span): Columns => this.inputs.columns(span);
  /** Of the first and the last moment that is shown; null before there is any. */
  range(span: Span): readonly [number, number] | null {
    const [times] = this.swarm.columns(span);
    return times.length > 0 ? [times[0]!, times[times.length - 1]!] : null;
  }
  get fastest(): number {
    return this.swarm.recent.newest(4);
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

/** The newest samples as they came, and all of them, ever coarser. */
class Twofold {
  readonly recent: Ring;
  private readonly whole: Chronicle;

  constructor(kept: readonly Kept[], spacingS = kSpacingS) {
    this.recent = new Ring(kSamples, kept.length);
    this.whole = new Chronicle(kOfWhole, kept, spacingS);
  }

  push(time: number, values: readonly number[]): void {
    this.recent.push(time, values);
    this.whole.push(time, values);
  }

  columns(span: Span): Columns {
    if (span === 'whole') return this.whole.columns();
    return this.recent.columns((this.recent.newestTime ?? 0) - kRecentS);
  }
}

const pairsOf = (drones: number): number => (drones * (drones - 1)) / 2;

function fastest(snapshot: Snapshot): number {
  let most = 0;
  for (let i = 0; i < snapshot.n; i++) most = Math.max(most, Math.hypot(...vectorOf(snapshot, i, 'command')));
  return most;
}
