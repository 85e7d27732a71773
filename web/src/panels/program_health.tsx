import { useApp } from './app_context';
import { Icon } from './icons';

/** How the program itself is: whether its ticks are on time, and whether the flight is recorded. */
export function ProgramHealth() {
  const { session } = useApp();
  void session.beat.value;
  const status = session.status.value;
  const lateMs = (session.snapshot?.latenessP99Us ?? NaN) / 1000;
  const recording = status?.recording;
  const hasLost = (recording?.lost_ticks ?? 0) > 0;
  return (
    <p class="health">
      <span title="How late control ticks begin: 99 of 100 are not later than this">
        ticks late {Number.isNaN(lateMs) ? '–' : `${lateMs.toFixed(lateMs < 10 ? 2 : 0)} ms`}
      </span>
      {recording ? (
        <span class={hasLost ? 'alarm' : ''} title={`into ${recording.folder}`}>
          {hasLost ? `recording lost ${recording.lost_ticks} ticks` : `recorded ${recording.ticks} ticks`}
        </span>
      ) : (
        <span>not recorded</span>
      )}
    </p>
  );
}

/** Why nothing is covered; which drones stand, hover or fall, their own labels say. */
function idleness(idle: number, active: number): string {
  if (idle === 0) return '';
  if (idle === 2) return 'No drone is active: nothing is covered.';
  return active > 0 ? 'No targets: the active drones hover.' : 'No targets, and no drone is active.';
}

/** What keeps the swarm from covering, or from keeping every rule; nothing while all is well. */
export function SwarmHealth() {
  const { session } = useApp();
  void session.beat.value;
  const { snapshot } = session;
  if (!snapshot) return null;
  const said = [
    idleness(snapshot.idle, snapshot.active),
    snapshot.isFallback ? 'For some drone no velocity satisfies every rule.' : '',
  ].filter((text) => text !== '');
  if (said.length === 0) return null;
  return (
    <div class="legend warning" role="status">
      <Icon name="warning" small />
      {said.join(' ')}
    </div>
  );
}
