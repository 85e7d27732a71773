import { signal } from '@preact/signals';
import type { World } from '../link/console_link';

export type NoticeKind = 'info' | 'warning' | 'alarm';

/** A short message for the person at this console, read out by screen readers. */
export interface Notice {
  readonly number: number;
  readonly kind: NoticeKind;
  readonly text: string;
}

/** Alarms stay until somebody dismisses them; so many are kept, and other messages besides. */
const kMostAlarms = 50;
export const kMostOthers = 4;

/** What this console is told at present. */
export class Notices {
  readonly all = signal<readonly Notice[]>([]);
  private next = 1;
  /** Those that no others push out. */
  private readonly kept = new Set<number>();
  /** Those that tell of an event. */
  private readonly ofEvents = new Set<number>();

  constructor(private readonly world: World) {}

  /**
   * Shown for a while, or for `lastsMs` where it makes no sense any more after that (null: until it is dismissed, whatever
   * else is said); an alarm until somebody dismisses it. Gives back the notice's number.
   */
  notify(kind: NoticeKind, text: string, lastsMs: number | null = kind === 'info' ? 4000 : 9000): number {
    const notice = { number: this.next++, kind, text };
    const isKept = (one: Notice): boolean => this.kept.has(one.number);
    const alarms = this.all.value.filter((one) => one.kind === 'alarm').slice(-kMostAlarms);
    // What is said once more takes the place of what was said before.
    const isOther = (one: Notice): boolean =>
      one.kind !== 'alarm' && !isKept(one) && (one.kind !== kind || one.text !== text);
    const others = this.all.value.filter(isOther).slice(-kMostOthers);
    const kept = this.all.value.filter(isKept);
    this.all.value = [...alarms, ...kept, ...others, notice].sort((a, b) => a.number - b.number);
    if (kind === 'alarm') return notice.number;
    if (lastsMs === null) this.kept.add(notice.number);
    else this.world.after(lastsMs, () => this.dismiss(notice.number));
    return notice.number;
  }

  /** Tells of an event, which is in the event log, too. */
  tell(kind: NoticeKind, text: string): void {
    this.ofEvents.add(this.notify(kind, text));
  }

  dismiss(number: number): void {
    this.kept.delete(number);
    this.all.value = this.all.value.filter((notice) => notice.number !== number);
  }

  dismissAlarms(): void {
    this.all.value = this.all.value.filter((notice) => notice.kind !== 'alarm');
  }

  /** What events were told stands no more; gives back how many alarms were among that. */
  dismissEvents(): number {
    const told = this.all.value.filter((notice) => this.ofEvents.has(notice.number));
    this.all.value = this.all.value.filter((notice) => !this.ofEvents.has(notice.number));
    this.ofEvents.clear();
    return told.filter((notice) => notice.kind === 'alarm').length;
  }
}
