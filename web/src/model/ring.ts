/**
 * The newest `capacity` samples of a few series over a common time, for plots. Time only goes forward: a sample that is
 * not newer than the last is left out, one that is older by more than a second (the mission was started anew) empties
 * the ring first.
 */
export class Ring {
  private readonly times: Float64Array;
  private readonly rows: Float64Array[];
  private next = 0;
  private filled = 0;

  constructor(
    readonly capacity: number,
    readonly seriesCount: number,
  ) {
    this.times = new Float64Array(capacity);
    this.rows = Array.from({ length: seriesCount }, () => new Float64Array(capacity));
  }

  get length(): number {
    return this.filled;
  }

  get newestTime(): number | null {
    return this.filled === 0 ? null : this.times[(this.next + this.capacity - 1) % this.capacity]!;
  }

  /** The newest value of a series; NaN where there is none. */
  newest(series: number): number {
    return this.filled === 0 ? NaN : this.rows[series]![(this.next + this.capacity - 1) % this.capacity]!;
  }

  /** `values` has one number per series; NaN leaves a gap. Precondition: values.length === seriesCount. */
  push(time: number, values: ArrayLike<number>): void {
    const newest = this.newestTime;
    if (newest !== null && time < newest - 1) this.clear();
    else if (newest !== null && time <= newest) return;
    this.times[this.next] = time;
    for (let i = 0; i < this.seriesCount; i++) this.rows[i]![this.next] = values[i]!;
    this.next = (this.next + 1) % this.capacity;
    this.filled = Math.min(this.filled + 1, this.capacity);
  }

  clear(): void {
    this.next = 0;
    this.filled = 0;
  }

  /** Times and then every series, oldest first, of samples at or after `since`; gaps are null, as uPlot wants them. */
  columns(since: number): [number[], ...(number | null)[][]] {
    const order: number[] = [];
    for (let i = 0; i < this.filled; i++) {
      const at = (this.next - this.filled + i + this.capacity) % this.capacity;
      if (this.times[at]! >= since) order.push(at);
    }
    const series = this.rows.map((row) => order.map((at) => (Number.isNaN(row[at]!) ? null : row[at]!)));
    return [order.map((at) => this.times[at]!), ...series];
  }
}
