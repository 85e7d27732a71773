import type { Session } from './session';

/**
 * Seeks in a recording as fast as the program follows: one at a time, then the newest place that was wished, also where
 * the one before was refused. */
export class Scrubbing {
  private isUnderWay = false;
  private next: number | null = null;

  constructor(private readonly session: Session) {}

  /** To the last tick at this mission time or before. */
  to(timeS: number): void {
    this.next = timeS;
    if (!this.isUnderWay) void this.follow();
  }

  private async follow(): Promise<void> {
    this.isUnderWay = true;
    while (this.next !== null) {
      const timeS = this.next;
      this.next = null;
      await this.session.command({ type: 'seek', time_s: timeS });
    }
    this.isUnderWay = false;
  }
}
