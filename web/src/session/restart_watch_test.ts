import { expect, it } from 'vitest';
import type { Snapshot } from '../link/frames';
import { kActivities } from '../model/drones';
import { RestartWatch } from './restart_watch';

const snapshotOf = (...words: string[]): Snapshot =>
  ({
    n: words.length,
    activity: Uint8Array.from(words, (word) => kActivities.findIndex((one) => one.word === word)),
  }) as unknown as Snapshot;

it('Drones that hold since a restart are told of until each does something else, not only until one was resumed', () => {
  const watch = new RestartWatch();
  watch.take(true, snapshotOf('held', 'held', 'marked_failed', 'held'));
  expect(watch.holding.value).toEqual([0, 1, 3]);
  watch.take(false, snapshotOf('active', 'held', 'marked_failed', 'held'));
  expect([watch.isWaiting.value, watch.holding.value]).toEqual([false, [1, 3]]);
  watch.take(false, snapshotOf('held', 'landing', 'held', 'held'));
  expect(watch.holding.value).toEqual([3]); // the others hold because somebody ordered it since
  watch.forget();
  watch.take(false, snapshotOf('held', 'held', 'held', 'held'));
  expect(watch.holding.value).toEqual([]);
});
