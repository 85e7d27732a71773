import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import type { HoldingRow, Snapshot } from '../link/frames';
import { activityOf, batteryOf, firstHolders, holderName, secondsOf, speedOf } from '../model/drones';
import { age, coordinate, metres, percent } from '../model/units';
import { useApp } from './app_context';
import { Icon, type IconName } from './icons';

const kSeverityIcons: Record<string, IconName> = { ok: 'ok', info: 'info', warning: 'warning', alarm: 'alarm' };
const kColumns = [
  ['id', '15%'],
  ['state', '23%'],
  ['x, y (m)', '20%'],
  ['batt.', '8%'],
  ['link', '10%'],
  ['m/s', '9%'],
  ['held by', '15%'],
] as const;

/** Every drone as a row; only the rows in view are in the page, however many drones there are. */
export function FleetTable() {
  const { session, editor } = useApp();
  const scroll = useSignal(0);
  const view = useRef<HTMLDivElement>(null);
  const rowHeight = useRowHeight();
  const ids = session.droneIds.value;
  void session.beat.value;
  const { snapshot } = session;
  const shown = Math.ceil((view.current?.clientHeight ?? 400) / rowHeight) + 8;
  const first = Math.max(0, Math.min(ids.length - shown, Math.floor(scroll.value / rowHeight) - 4));
  const holders = snapshot ? firstHolders(snapshot) : new Map<number, HoldingRow>();
  const rows = ids.slice(first, first + shown).map((_, i) => first + i);
  return (
    <section class="fleet panel-body" aria-label="Fleet">
      <div class="panel" style={{ borderBottom: 0 }}>
        <header>
          <h2>Fleet</h2>
          <span class="dim" data-testid="active-count">
            {snapshot ? `${snapshot.active} of ${snapshot.n} active` : '–'}
            {editor.selectedDrones.value.size > 0 && `, ${editor.selectedDrones.value.size} selected`}
          </span>
        </header>
      </div>
      <div
        class="rows"
        ref={view}
        tabIndex={0}
        role="region"
        aria-label="Fleet table"
        onScroll={(event) => (scroll.value = event.currentTarget.scrollTop)}
      >
        <table aria-rowcount={ids.length + 1}>
          <colgroup>
            {kColumns.map(([name, width]) => (
              <col key={name} style={{ width }} />
            ))}
          </colgroup>
          <thead>
            <tr>
              {kColumns.map(([name]) => (
                <th key={name} scope="col">
                  {name}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {first > 0 && <tr aria-hidden="true" style={{ height: `${first * rowHeight}px` }} />}
            {snapshot &&
              rows.map((drone) => <Row key={drone} drone={drone} snapshot={snapshot} held={holders.get(drone)} />)}
            {first + shown < ids.length && (
              <tr aria-hidden="true" style={{ height: `${(ids.length - first - shown) * rowHeight}px` }} />
            )}
          </tbody>
        </table>
      </div>
    </section>
  );
}

function useRowHeight(): number {
  const isCoarse = useSignal(false);
  useEffect(() => {
    isCoarse.value = matchMedia('(pointer: coarse)').matches;
  }, []);
  return isCoarse.value ? 46 : 38;
}

function Row({ drone, snapshot, held }: { drone: number; snapshot: Snapshot; held: HoldingRow | undefined }) {
  const { session, editor } = useApp();
  const field = session.field.value;
  const id = session.droneIds.value[drone]!;
  const activity = activityOf(snapshot, drone);
  const isSelected = editor.selectedDrones.value.has(drone);
  const place = field?.toWorld([snapshot.position[2 * drone]!, snapshot.position[2 * drone + 1]!]);
  const extent = Math.max(...(field?.size ?? [1, 1])) * 10;
  const battery = batteryOf(snapshot, drone);
  const linkAge = secondsOf(snapshot.linkAge[drone]!);
  const choose = (event: MouseEvent): void => {
    if (event.shiftKey || event.ctrlKey || event.metaKey) editor.toggleDrone(drone);
    else editor.selectDrones(isSelected && editor.selectedDrones.value.size === 1 ? [] : [drone]);
  };
  const holder = held && holderName(held, session.droneIds.value, session.committed.value.no_fly);
  return (
    <tr class={isSelected ? 'is-selected' : ''} aria-rowindex={drone + 2} onClick={choose}>
      <td>
        <button
          type="button"
          aria-pressed={isSelected}
          onClick={(event) => {
            event.stopPropagation();
            choose(event);
          }}
        >
          {id}
        </button>
      </td>
      <td title={activity.why}>
        <span class={`state ${activity.severity}`}>
          <Icon name={kSeverityIcons[activity.severity]!} small />
          {activity.label}
        </span>
      </td>
      <td>
        {place && !Number.isNaN(place[0]) ? `${coordinate(place[0], extent)}, ${coordinate(place[1], extent)}` : '–'}
      </td>
      <td class={battery < 0.25 ? 'alarm' : ''}>{percent(battery)}</td>
      <td class={linkAge > 0.5 ? 'alarm' : ''}>{age(linkAge)}</td>
      <td>{speedOf(snapshot, drone).toFixed(2)}</td>
      <td
        class={holder ? 'warning' : 'dim'}
        title={holder ? `held by ${holder}, ${metres(held.distanceM)}` : 'nothing holds it'}
      >
        {holder ?? '–'}
      </td>
    </tr>
  );
}
