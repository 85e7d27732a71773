import { signal } from '@preact/signals';
import type { Snapshot } from '../link/frames';
import { activityOf } from '../model/drones';

/**
 * Which drones have held since the program was restarted. The program waits until anybody was resumed; those that still
 * hold then are easily forgotten, so they are told of until each of them does something else, or is meant to hold.
 */
export class RestartWatch {
  /** Indices of drones. */
  readonly holding = signal<readonly number[]>([]);
  /** Nobody was resumed yet. */
  readonly isWaiting = signal(false);

  take(isWaiting: boolean, snapshot: Snapshot | null): void {
    this.isWaiting.value = isWaiting;
    if (!snapshot) return;
    const before = this.holding.value;
    const asked = isWaiting ? Array.from({ length: snapshot.n }, (_, drone) => drone) : before;
    const holding = asked.filter((drone) => activityOf(snapshot, drone).word === 'held');
    if (holding.join() !== before.join()) this.holding.value = holding;
  }

  /** They are meant to hold, or are of another flight. */
  forget(): void {
    this.holding.value = [];
  }
}
