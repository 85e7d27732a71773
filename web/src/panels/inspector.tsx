import {
  activityOf,
  batteryOf,
  holderName,
  holdersOf,
  kFlag,
  kModes,
  secondsOf,
  speedOf,
  type VelocityKind,
} from '../model/drones';
import { age, coordinate, metres, metresPerSecond, percent } from '../model/units';
import { kOrderNames, kOrders, wantsSelection, type Order } from '../session/fleet_orders';
import { useApp } from './app_context';
import { HoldButton } from './hold_button';
import { Icon, type IconName } from './icons';
import { WhyPanel } from './why_panel';

const kOrderIcons: Record<Order, IconName> = {
  take_off: 'takeOff',
  land: 'land',
  hold: 'pause',
  return: 'home',
  resume: 'resume',
  mark_failed: 'alarm',
  give_back: 'giveBack',
};

/** Orders for the selected drones; for all where none is selected. */
export function Orders() {
  const { session, editor, orders } = useApp();
  const selected = [...editor.selectedDrones.value].flatMap((drone) => session.droneIds.value[drone] ?? []);
  const who =
    selected.length === 0 ? 'all drones' : selected.length > 3 ? `${selected.length} drones` : selected.join(', ');
  return (
    <section aria-label={`Orders for ${who}`}>
      <p class="pad" style={{ margin: '8px 0 0', paddingBottom: 0 }}>
        <span class="dim">Orders for</span> <strong>{who}</strong>
        {selected.length === 0 && (
          <span class="dim" data-testid="keys-want-selection">
            ; keys: only selected ones; Land, Mark failed: select drones first
          </span>
        )}
      </p>
      <div class="orders" style={{ borderTop: 0 }}>
        {kOrders.map((order) => (
          <button
            key={order}
            type="button"
            disabled={!orders.may(order) || (selected.length === 0 && wantsSelection(order))}
            title={
              selected.length === 0 && wantsSelection(order) ? 'Select drones first; LAND ALL lands all' : undefined
            }
            onClick={() => orders.to(order, selected.length === 0 ? 'all' : selected)}
          >
            <Icon name={kOrderIcons[order]} />
            {kOrderNames[order]}
          </button>
        ))}
      </div>
    </section>
  );
}

/** One drone in detail: why it does what it does. */
export function Inspector() {
  const { session, editor } = useApp();
  void session.beat.value;
  const { snapshot } = session;
  const selected = [...editor.selectedDrones.value];
  const drone = selected[0];
  const field = session.field.value;
  if (!snapshot || !field || drone === undefined || selected.length !== 1 || drone >= snapshot.n) return null;
  const id = session.droneIds.value[drone]!;
  const activity = activityOf(snapshot, drone);
  const [x, y] = field.toWorld([snapshot.position[2 * drone]!, snapshot.position[2 * drone + 1]!]);
  const extent = Math.max(...field.size);
  const nearest = snapshot.nearest[drone]!;
  return (
    <section class="inspector panel-body" aria-label={`Drone ${id}`} tabIndex={0}>
      <div class="panel" style={{ borderBottom: 0 }}>
        <header>
          <h3>{id}</h3>
          <span class={`state ${activity.severity}`} style={{ paddingRight: '8px' }}>
            {activity.label}
          </span>
        </header>
      </div>
      <div class="pad">
        <p class="dim" style={{ margin: '0 0 8px' }} data-testid="why">
          {activity.why}
        </p>
        <dl class="facts">
          <dt>place</dt>
          <dd class="whole">
            {Number.isNaN(x)
              ? '–'
              : `${coordinate(x, extent)}, ${coordinate(y, extent)} m, ${metres(snapshot.height[drone])} up`}
          </dd>
          <dt>mode</dt>
          <dd>{kModes[snapshot.mode[drone]!] ?? 'unknown'}</dd>
          <dt>battery</dt>
          <dd>{percent(batteryOf(snapshot, drone))}</dd>
          <dt>position age</dt>
          <dd>{age(secondsOf(snapshot.age[drone]!))}</dd>
          <dt>link age</dt>
          <dd>{age(secondsOf(snapshot.linkAge[drone]!))}</dd>
          <dt>nearest</dt>
          <dd class="whole">{Number.isNaN(nearest) ? 'nothing within range' : metres(nearest)}</dd>
          <dt>held by</dt>
          <dd class="whole" data-testid="held-by">
            <HeldBy drone={drone} />
          </dd>
        </dl>
        <div class="speeds">
          <Gauge drone={drone} kind="nominal" name="wanted" />
          <Gauge drone={drone} kind="command" name="allowed" />
          <Gauge drone={drone} kind="velocity" name="flown" />
        </div>
        <WhyPanel />
        <StopOne key={id} id={id} />
      </div>
    </section>
  );
}

function HeldBy({ drone }: { drone: number }) {
  const { session } = useApp();
  void session.beat.value;
  const snapshot = session.snapshot!;
  const rows = holdersOf(snapshot, drone);
  const flags = snapshot.flags[drone]!;
  const reasons = [
    ...rows.map(
      (row) => `${holderName(row, session.droneIds.value, session.committed.value.no_fly)}, ${metres(row.distanceM)}`,
    ),
    ...(flags & kFlag.speedLimit ? ['the speed limit'] : []),
    ...(flags & kFlag.marginsGaveWay ? ['margins gave way'] : []),
    ...(flags & kFlag.fallback ? ['no velocity satisfies every rule'] : []),
  ];
  const isCovering = activityOf(snapshot, drone).severity === 'ok';
  if (reasons.length === 0)
    return <span class="dim">{isCovering ? 'nothing: it does what coverage wants' : 'nothing'}</span>;
  return <span class="warning">{reasons.join('; ')}</span>;
}

function Gauge({ drone, kind, name }: { drone: number; kind: VelocityKind; name: string }) {
  const { session } = useApp();
  void session.beat.value;
  const speed = speedOf(session.snapshot!, drone, kind);
  const most = session.mission.value?.display.speed_limit_m_s ?? 1;
  return (
    <>
      <span class="dim">{name}</span>
      <span class={`gauge ${kind}`} aria-hidden="true">
        <i style={{ width: `${Math.min(100, (100 * speed) / most)}%` }} />
      </span>
      <span>{metresPerSecond(speed)}</span>
    </>
  );
}

function StopOne({ id }: { id: string }) {
  const { session, orders } = useApp();
  return (
    <HoldButton
      title={`Motors off, only ${id}: hold for one second`}
      disabled={!session.mayStopMotors.value}
      onConfirmed={() => orders.emergencyStop([id])}
      onLetGo={() => orders.stopLetGo('until it is filled')}
    >
      <span>Stop motors of {id} (hold)</span>
    </HoldButton>
  );
}
