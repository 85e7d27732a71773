import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import type { Point } from '../model/geometry';
import { isEmpty, type Edit } from '../model/targets';
import { age, sentence } from '../model/units';
import { useApp } from './app_context';
import { Icon } from './icons';
import { WhoForm } from './who_menu';

/** What lies over the map while there is no picture, or no fresh one. */
export function Covers() {
  const { session, map } = useApp();
  const { phase } = session.linkState.value;
  if (phase === 'refused') return <Refused />;
  if (!session.hasSnapshot.value) return <Loading />;
  const isLive = session.isLive.value;
  return (
    <>
      <div class="banners">
        {!isLive && <NotLive />}
        <Waiting />
        {isLive && map.value?.problem.value && (
          <div class="banner is-calm" role="status">
            <p>{map.value.problem.value}</p>
          </div>
        )}
        {isLive && <Restarted />}
      </div>
      {isLive && <Empty />}
    </>
  );
}

/** Orders of anybody that no tick has taken, for as long as they wait. */
function Waiting() {
  const { session } = useApp();
  const waiting = session.status.value?.waiting ?? [];
  if (waiting.length === 0) return null;
  const said = waiting.map(({ text, from }) => (from === '' ? text : `${text} (${from})`));
  const more = session.status.value?.waiting_more ?? 0;
  return (
    <div class="banner is-calm is-beside" role="status" data-testid="waiting">
      <span class="warning">
        <Icon name="warning" />
      </span>
      <p>
        <strong>
          Not done yet: {said.join('; ')}
          {more > 0 && `; and ${more} more`}.
        </strong>
        {session.snapshot?.isPaused ? 'It waits until the clock goes on.' : 'It waits for the next tick.'}
      </p>
    </div>
  );
}

function Loading() {
  const { session } = useApp();
  const { phase, reason } = session.linkState.value;
  const steps = [
    ['Connect to the program', session.hello.value !== null],
    ['Read the mission', session.mission.value !== null],
    ['Read the targets', session.targets.value !== null],
    ['First picture of the swarm', session.hasSnapshot.value],
  ] as const;
  const current = steps.findIndex(([, isDone]) => !isDone);
  return (
    <div class="cover" role="status">
      <h2>{phase === 'lost' ? 'No connection yet' : 'Loading'}</h2>
      {phase === 'lost' && <p>{sentence(reason)} Is the program running? The console tries again by itself.</p>}
      <ol>
        {steps.map(([name, isDone], i) => (
          <li key={name} class={isDone ? 'ok' : i === current ? '' : 'dim'}>
            <Icon name={isDone ? 'ok' : 'info'} />
            {name}
            {i === current && <span class="skeleton" style={{ flex: 1, height: '10px' }} aria-hidden="true" />}
          </li>
        ))}
      </ol>
    </div>
  );
}

function Refused() {
  const { session } = useApp();
  return (
    <div class="cover" role="alert">
      <h2>The program wants a token</h2>
      <p>{sentence(session.linkState.value.reason)} Nothing is shown before; the drones are not affected.</p>
      <WhoForm done={() => undefined} />
    </div>
  );
}

/** What is shown is frozen or late: why, what the drones do, and what can be done. */
function NotLive() {
  const { session } = useApp();
  const now = useSignal(0);
  useEffect(() => {
    const timer = window.setInterval(() => now.value++, 250);
    return () => window.clearInterval(timer);
  }, []);
  void now.value;
  const { retryAtMs, phase } = session.linkState.value;
  const wait = retryAtMs === null ? 0 : Math.max(0, (retryAtMs - session.world.nowMs()) / 1000);
  return (
    <div class="banner" data-testid="disconnected">
      <span class="alarm">
        <Icon name="alarm" />
      </span>
      <p>
        <strong class="alarm">
          <span role="alert">{session.isConnected.value ? 'Stale picture.' : 'Disconnected.'}</span> What you see is{' '}
          {age(session.dataAgeS())} old{phase === 'live' ? '.' : ' and frozen.'}
        </strong>
        {session.isConnected.value ? <StillConnected /> : <Unconnected />}
        {phase === 'lost' && <span class="dim"> Next try in {wait.toFixed(0)} s.</span>}
      </p>
      {/* While something is open it may still carry LAND ALL: it is not given up for a try. */}
      {!session.isConnected.value && (
        <button type="button" onClick={() => session.link.open()}>
          Try now
        </button>
      )}
    </div>
  );
}

const StillConnected = () => (
  <>
    No fresh one comes: the connection is slow or broken, or this page too busy. Editing is off. LAND ALL and EMERGENCY
    STOP are still sent, and it is said whether they are confirmed. {kFateWithoutConsole}
  </>
);

function Unconnected() {
  const { session } = useApp();
  const { reason, hasEnded } = session.linkState.value;
  return (
    <>
      {hasEnded ? 'The program was ended.' : sentence(reason)} Editing is off.{' '}
      {hasEnded ? fateAfterTheEnd(session.mission.value?.fleet) : `${kFateWithoutConsole} ${kLandWithoutConsole}`}
    </>
  );
}

const kFateWithoutConsole =
  'The drones need no console: the program goes on covering with the last committed targets; should the program itself be ' +
  'gone, each vehicle hovers and then lands by its own failsafe.';

const kLandWithoutConsole =
  'Nothing can be ordered from here: to land now use another browser, the program’s own machine (POST /api/commands, see ' +
  'docs/console.md), or the vehicles’ remote controls.';

const fateAfterTheEnd = (fleet: string | undefined): string =>
  fleet === 'SIM'
    ? 'Its simulated drones ended with it. Start it again to go on.'
    : 'Nothing flies the drones any more: each hovers and then lands by its own failsafe. Start the program again to go on.';

const fateAfterRestart = (fleet: string | undefined): string =>
  fleet === 'LIVE'
    ? 'Drones in the air count as overridden and are not steered until they were seen on the ground; an emergency stop reaches them.'
    : 'Drones in the air hold until you let them go on; who was landing lands, who was marked failed or stopped stays so.';

/** Until somebody resumed drones, and then while others hold still. */
function Restarted() {
  const { session, orders } = useApp();
  const { isWaiting, holding } = session.restart;
  if (!isWaiting.value && holding.value.length === 0) return null;
  // Not all: to resume one that is marked failed, or was sent down, is a decision of its own.
  const ids = session.droneIds.value;
  const held = holding.value.flatMap((drone) => ids[drone] ?? []);
  return (
    <div class="banner is-calm" role="alert">
      <span class="warning">
        <Icon name="warning" />
      </span>
      <p>
        <strong>The program was restarted.</strong>
        {isWaiting.value
          ? `It has its mission, targets and coverage back. ${fateAfterRestart(session.mission.value?.fleet)}`
          : `${held.length} of ${ids.length} drones ${held.length === 1 ? 'holds' : 'hold'} since then: ${shortList(held)}.`}
      </p>
      <button
        type="button"
        class="primary"
        disabled={!session.mayOperate.value || held.length === 0}
        title={held.length === 0 ? 'No drone holds' : undefined}
        onClick={() => orders.to('resume', held)}
      >
        Resume those that hold
      </button>
      {!isWaiting.value && (
        <button type="button" onClick={() => session.restart.forget()}>
          Let them hold
        </button>
      )}
    </div>
  );
}

const kMostNamed = 5;

const shortList = (ids: readonly string[]): string =>
  `${ids.slice(0, kMostNamed).join(', ')}${ids.length > kMostNamed ? ` and ${ids.length - kMostNamed} more` : ''}`;

function Empty() {
  const { session, editor } = useApp();
  const isHidden =
    !isEmpty(session.draft.value) ||
    session.isStaged.value ||
    session.staging.value.undone.length > 0 ||
    session.targets.value === null ||
    editor.sketch.value.length > 0 ||
    editor.tool.value !== 'select';
  if (isHidden) return null;
  const mayEdit = session.mayOperate.value;
  void session.beat.value;
  const active = session.snapshot?.active ?? 0;
  return (
    <div class="cover is-low">
      <div>
        <h2>Drop points on the field to start</h2>
        <p>
          {active > 0
            ? 'Nothing is watched, so the active drones hover.'
            : 'Nothing is watched, and no drone is active.'}{' '}
          Click a few places that matter; Enter commits them, and{' '}
          {active > 0 ? 'sends the swarm' : 'whatever takes off goes there'}.
        </p>
      </div>
      <div class="row">
        <button type="button" class="primary" disabled={!mayEdit} onClick={() => editor.take('point')}>
          <Icon name="point" />
          Take the point tool
        </button>
        <button
          type="button"
          disabled={!mayEdit}
          onClick={() => editor.stage('an example of three clusters', ...example())}
        >
          Load an example
        </button>
      </div>
    </div>
  );

  /** Three clusters of five points, scaled to the field. */
  function example(): Edit[] {
    const field = session.field.value!;
    const places = [['north', 0.28, 0.74], ['east', 0.76, 0.6], ['south', 0.48, 0.22]] as const; // prettier-ignore
    const around = [[0, 0], [0.05, 0.03], [-0.05, 0.04], [0.03, -0.05], [-0.04, -0.04]] as const; // prettier-ignore
    return places.map(([name, cx, cy]): Edit => {
      const points_m = around.map(([dx, dy]): Point =>
        field.toWorld([(cx + dx) * field.size[0], (cy + dy) * field.size[1]]),
      );
      return { op: 'add', kind: 'cluster', entry: { name, points_m, weight: 1, revisit_s: null, protect: false } };
    });
  }
}
