import { describe, expect, it } from 'vitest';
import { ProgramClock } from './program_clock';

/** Two clocks: the program's is ahead by `aheadMs` at the page's 0, and goes faster by `drift`. */
class Clocks {
  readonly clock = new ProgramClock();
  nowMs = 1000;

  constructor(
    public aheadMs: number,
    readonly drift = 0,
  ) {}

  programMs = (pageMs: number): number => pageMs * (1 + this.drift) + this.aheadMs;

  /** Asks, and reads the answer after the way there and the way back. */
  ask(thereMs: number, backMs: number): void {
    const sentMs = this.nowMs;
    this.nowMs += thereMs + backMs;
    this.clock.answered(sentMs, this.programMs(sentMs + thereMs), this.nowMs);
  }

  get mistakeMs(): number {
    return Math.abs(this.clock.at(this.nowMs)! - this.programMs(this.nowMs));
  }
}

describe('program clock', () => {
  it('Before anything was heard nothing is known', () => {
    expect(new ProgramClock().at(5)).toBe(null);
  });

  it('Ways there and back that are alike give the clock itself, however long they are', () => {
    const clocks = new Clocks(123_456_789);
    clocks.ask(300, 300);
    expect(clocks.mistakeMs).toBeLessThan(1e-6);
  });

  it('Answers that waited in a queue do not spoil what one that did not wait has told', () => {
    const clocks = new Clocks(-5000);
    clocks.ask(10, 10);
    for (const waitedMs of [900, 4000, 250]) clocks.ask(10, 10 + waitedMs);
    expect(clocks.mistakeMs).toBeLessThan(5);
  });

  it('The least way there and the least way back may be of different questions', () => {
    const clocks = new Clocks(42);
    for (let n = 0; n < 4; n++) {
      clocks.ask(10, 700);
      clocks.ask(700, 10);
    }
    expect(clocks.mistakeMs).toBeLessThan(5);
    expect(clocks.clock.errorMs(clocks.nowMs)).toBeLessThan(15);
  });

  it('Where ways there and back differ always, it is wrong by half the difference and knows it', () => {
    const clocks = new Clocks(0);
    for (let n = 0; n < 10; n++) clocks.ask(5, 85);
    expect(clocks.mistakeMs).toBeGreaterThan(35);
    expect(clocks.mistakeMs).toBeLessThan(45);
    expect(clocks.clock.errorMs(clocks.nowMs)).toBeGreaterThanOrEqual(clocks.mistakeMs);
  });

  it.each([1e-4, -1e-4])('Clocks that drift apart by %d are followed for hours', (drift) => {
    const clocks = new Clocks(77, drift);
    for (let n = 0; n < 3600; n++) {
      clocks.ask(4, 4 + (n % 5) * 60);
      clocks.nowMs += 2000;
      expect(clocks.mistakeMs).toBeLessThan(10);
    }
  });

  it.each([3_600_000, -3_600_000])('After a clock leapt by %d ms the next answer alone counts', (leapMs) => {
    const clocks = new Clocks(0);
    for (let n = 0; n < 5; n++) clocks.ask(5, 5);
    clocks.aheadMs += leapMs;
    clocks.ask(5, 5);
    expect(clocks.mistakeMs).toBeLessThan(1);
  });

  it('A picture of the future means that the clock leapt, and it is taken for new until the next answer', () => {
    const clocks = new Clocks(0);
    clocks.ask(5, 5);
    clocks.aheadMs += 60_000;
    clocks.clock.saw(clocks.programMs(clocks.nowMs) - 40, clocks.nowMs);
    expect(clocks.mistakeMs).toBeLessThanOrEqual(40);
    clocks.ask(5, 5);
    expect(clocks.mistakeMs).toBeLessThan(1);
  });
});
