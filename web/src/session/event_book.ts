import { signal } from '@preact/signals';
import type { SwarmEvent } from '../link/messages';

/** An event, and the flight in which it happened: events of several flights, and of several runs, stand in one log. */
export interface LoggedEvent extends SwarmEvent {
  readonly run: string;
  readonly epoch: number;
}

const kMostEvents = 1000;

/** What happened since this page was opened, and the newest of what happened before. */
export class EventBook {
  readonly events = signal<readonly LoggedEvent[]>([]);
  private run = '';
  private last = 0;
  private isWatching = false;

  /**
   * Writes down what came from this run of the program, whose flight is `epoch` where an event does not say it, and gives
   * back what is news: nothing of the first that came to this page; of another run, which counts from 1 anew, all.
   */
  take(events: readonly SwarmEvent[], run: string, epoch: number): readonly LoggedEvent[] {
    if (run !== this.run) this.last = 0;
    this.run = run;
    // After a reconnect the newest 200 come again.
    const fresh = events.filter((event) => event.number > this.last).map((event) => logged(event, run, epoch));
    this.events.value = [...this.events.value, ...fresh].slice(-kMostEvents);
    this.last = fresh[fresh.length - 1]?.number ?? this.last;
    const news = this.isWatching ? fresh : [];
    this.isWatching = true;
    return news;
  }

  /** Another moment of a recording: what stood there before is of elsewhere, and nothing of it is news. */
  replace(events: readonly SwarmEvent[], run: string, epoch: number): void {
    this.run = run;
    this.last = events[events.length - 1]?.number ?? 0;
    this.events.value = events.map((event) => logged(event, run, epoch));
    this.isWatching = true;
  }
}

const logged = (event: SwarmEvent, run: string, epoch: number): LoggedEvent => ({
  ...event,
  run,
  // 0 is what happened before the run's first flight, whose epoch is 1.
  epoch: event.epoch === null ? epoch : Math.max(1, event.epoch),
});
