/** How fast the two clocks may drift apart, ms a ms: a good deal more than crystals and slewed clocks do. */
const kDrift = 0.0005;

/**
 * The program's steady clock, read by this page's own steady one; neither is turned when somebody sets the time. A question
 * that left at `sentMs` and was answered at `programMs`, whose answer was read at `readMs`, bounds the difference of the two
 * from both sides; of many questions the least way there gives one bound and the least way back the other, so that
 * what waited in a queue spoils neither. What then remains is half the difference of the least ways there and back.
 */
export class ProgramClock {
  /** Program minus page, ms: at least, at most, as of `asOfMs`. */
  private least = -Infinity;
  private most = Infinity;
  private asOfMs = 0;

  /** Another connection, perhaps another program: nothing is known. */
  forget(): void {
    [this.least, this.most] = [-Infinity, Infinity];
  }

  answered(sentMs: number, programMs: number, readMs: number): void {
    this.bound(programMs - readMs, programMs - sentMs, readMs);
  }

  /** Something of that moment was read: the moment is past. */
  saw(programMs: number, readMs: number): void {
    this.bound(programMs - readMs, Infinity, readMs);
  }

  /** What the program's clock shows when this page's shows `pageMs`; null where nothing was heard of it. */
  at(pageMs: number): number | null {
    if (this.least === -Infinity) return null;
    return pageMs + (this.most === Infinity ? this.least : (this.least + this.most) / 2);
  }

  /** By how much `at` may be wrong, ms. */
  errorMs(pageMs: number): number {
    return (this.most - this.least) / 2 + kDrift * Math.abs(pageMs - this.asOfMs);
  }

  /** Bounds that exclude each other mean that a clock stood still or leapt: the newest alone hold then. */
  private bound(least: number, most: number, nowMs: number): void {
    const drift = kDrift * Math.max(0, nowMs - this.asOfMs);
    const [lower, upper] = [Math.max(this.least - drift, least), Math.min(this.most + drift, most)];
    [this.least, this.most] = lower <= upper ? [lower, upper] : [least, most];
    this.asOfMs = nowMs;
  }
}
