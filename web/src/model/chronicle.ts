/**
 * A few series over a common time from their beginning on, in a memory that does not grow: where samples become too many,
 * two neighbours become one, which keeps what matters of both. Time only goes forward: a sample that is not newer than the
 * last is left out.
 */

/** What is kept of two values of a series: the later, the greater or the lesser one. A gap gives way to a number. */
export type Kept = 'last' | 'most' | 'least';

interface Sample {
  readonly begin: number;
  time: number;
  readonly values: number[];
}

export class Chronicle {
  private samples: Sample[] = [];

  constructor(
    private readonly capacity: number,
    private readonly kept: readonly Kept[],
    /** What a sample stands for, at least. */
    private spacing: number,
  ) {}

  /** `values` has one number per series; NaN leaves a gap. */
  push(time: number, values: ArrayLike<number>): void {
    const last = this.samples[this.samples.length - 1];
    if (last && time <= last.time) return;
    const sample = { begin: time, time, values: Array.from(values) };
    if (last && time < last.begin + this.spacing * (1 - 1e-9)) return this.merge(last, sample);
    if (this.samples.length >= this.capacity) this.halve();
    this.samples.push(sample);
  }

  /** Times and then every series, oldest first; gaps are null, as uPlot wants them. */
  columns(): [number[], ...(number | null)[][]] {
    const series = this.kept.map((_, i) =>
      this.samples.map(({ values }) => (Number.isNaN(values[i]!) ? null : values[i]!)),
    );
    return [this.samples.map((sample) => sample.time), ...series];
  }

  private merge(into: Sample, later: Sample): void {
    into.time = later.time;
    this.kept.forEach((kept, i) => (into.values[i] = merged(kept, into.values[i]!, later.values[i]!)));
  }

  private halve(): void {
    this.spacing *= 2;
    const pairs: Sample[] = [];
    for (let i = 0; i + 1 < this.samples.length; i += 2) {
      this.merge(this.samples[i]!, this.samples[i + 1]!);
      pairs.push(this.samples[i]!);
    }
    this.samples = pairs;
  }
}

function merged(kept: Kept, before: number, later: number): number {
  if (kept === 'last' || Number.isNaN(before)) return later;
  if (Number.isNaN(later)) return before;
  return kept === 'most' ? Math.max(before, later) : Math.min(before, later);
}
