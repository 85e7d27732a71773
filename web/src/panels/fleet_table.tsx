import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import type { HoldingRow, Snapshot } from '../link/frames';
import type { FieldFrame } from '../model/field_frame';
import type { Point } from '../model/geometry';
import { activityOf, batteryOf, firstHolders, holderName, secondsOf, speedOf } from '../model/drones';
import { steadyRows } from '../model/steady_rows';
import { age, coordinate, metres, percent } from '../model/units';
import { useApp } from './app_context';
import { Icon, type IconName } from './icons';

const kSeverityIcons: Record<string, IconName> = { ok: 'ok', info: 'info', warning: 'warning', alarm: 'alarm' };
const kColumns = ['id', 'state', 'x, y (m)', 'batt.', 'link', 'm/s', 'held by'] as const;

const kFilters = { all: 'all', away: 'not active', held: 'held back', selected: 'selected' } as const;
type Filter = keyof typeof kFilters;

/** The drones that a filter lets through, in their order. */
function chosen(
  filter: Filter,
  snapshot: Snapshot,
  held: Map<number, HoldingRow>,
  selected: ReadonlySet<number>,
): number[] {
  const lets: Record<Filter, (drone: number) => boolean> = {
    all: () => true,
    away: (drone) => snapshot.activity[drone] !== 0,
    held: (drone) => held.has(drone),
    selected: (drone) => selected.has(drone),
  };
  return Array.from({ length: snapshot.n }, (_, drone) => drone).filter(lets[filter]);
}

/** A tenth of what the inspector shows: rows are read at a glance. */
const inTable = (place: Point, field: FieldFrame): string[] =>
  place.map((value) => coordinate(value, 10 * Math.max(...field.size)));

/** How many letters the widest coordinate and the longest id have: columns are as wide as that, within limits. */
function widths(field: FieldFrame | null, ids: readonly string[]): Record<string, string> {
  const [x, y] = field?.size ?? [1, 1];
  const corners: Point[] = [[0, 0], [x, 0], [0, y], [x, y]]; // prettier-ignore
  const letters = corners
    .flatMap((corner) => (field ? inTable(field.toWorld(corner), field) : []))
    .map((t) => t.length);
  const one = Math.min(11, Math.max(4, ...letters));
  const id = ids.reduce((most, name) => Math.max(most, name.length), 0);
  // Where a line has no room for both coordinates they stand one over the other.
  return {
    '--one-place': `${one <= 3 ? 2 * one + 2 : one + 1}ch`,
    '--place': `${one <= 5 ? 2 * one + 2 : one + 1}ch`,
    '--id': `${Math.min(id, 40)}ch`,
  };
}

/** A name that is cut in its middle where there is no room: names of a fleet differ at their ends. */
function CutName({ name }: { name: string }) {
  const kKept = 4;
  if (name.length <= kKept + 2) return <>{name}</>;
  return (
    <span class="cut-name">
      <span>{name.slice(0, -kKept)}</span>
      <span>{name.slice(-kKept)}</span>
    </span>
  );
}

/** Every drone as a row; only the rows in view are in the page, however many drones there are. */
export function FleetTable() {
  const { session, editor } = useApp();
  const scroll = useSignal(0);
  const view = useRef<HTMLDivElement>(null);
  const rowHeight = useRowHeight();
  const filter = useSignal<Filter>('all');
  void session.beat.value;
  const { snapshot } = session;
  const selected = editor.selectedDrones.value;
  const holders = snapshot ? firstHolders(snapshot) : new Map<number, HoldingRow>();
  const wanted = snapshot ? chosen(filter.value, snapshot, holders, selected) : [];
  const hand = useHand();
  const drones = useSteadyRows(wanted, hand.isThere, `${filter.value} ${session.mission.value?.epoch} ${snapshot?.n}`);
  const shown = Math.ceil((view.current?.clientHeight ?? 400) / rowHeight) + 8;
  const first = Math.max(0, Math.min(drones.length - shown, Math.floor(scroll.value / rowHeight) - 4));
  const rows = drones.slice(first, first + shown);
  useEffect(() => {
    const [drone] = selected;
    if (selected.size === 1) showRow(view.current, drones.indexOf(drone!), rowHeight);
  }, [selected]);
  return (
    <section class="fleet panel-body" aria-label="Fleet">
      <div class="panel" style={{ borderBottom: 0 }}>
        <header>
          <h2>Fleet</h2>
          <span class="dim" data-testid="active-count">
            {snapshot ? `${snapshot.active} of ${session.fleetSize.value} active` : '–'}
            {selected.size > 0 && `, ${selected.size} selected`}
          </span>
          <select
            aria-label="Show which drones"
            value={filter.value}
            onChange={(event) => (filter.value = event.currentTarget.value as Filter)}
          >
            {Object.entries(kFilters).map(([value, words]) => (
              <option key={value} value={value}>
                {words}
              </option>
            ))}
          </select>
        </header>
      </div>
      <div
        class="rows"
        ref={view}
        tabIndex={0}
        role="region"
        aria-label="Fleet table"
        {...hand.events}
        onScroll={(event) => (scroll.value = event.currentTarget.scrollTop)}
      >
        <table aria-rowcount={drones.length + 1} style={widths(session.field.value, session.droneIds.value)}>
          <colgroup>
            {kColumns.map((name) => (
              <col key={name} class={`col-${name.slice(0, 1)}`} />
            ))}
          </colgroup>
          <thead>
            <tr>
              {kColumns.map((name) => (
                <th key={name} scope="col">
                  {name}
                </th>
              ))}
            </tr>
          </thead>
          <tbody>
            {first > 0 && <tr aria-hidden="true" style={{ height: `${first * rowHeight}px` }} />}
            {snapshot &&
              rows.map((drone, i) => (
                <Row key={drone} drone={drone} index={first + i} snapshot={snapshot} held={holders.get(drone)} />
              ))}
            {first + shown < drones.length && (
              <tr aria-hidden="true" style={{ height: `${(drones.length - first - shown) * rowHeight}px` }} />
            )}
          </tbody>
        </table>
      </div>
    </section>
  );
}

/** Whether somebody is at the table: with the pointer over it, or with the focus in a row. */
function useHand() {
  const isPointing = useSignal(false);
  const hasFocus = useSignal(false);
  const events = {
    onPointerEnter: () => (isPointing.value = true),
    onPointerLeave: () => (isPointing.value = false),
    onFocusIn: (event: FocusEvent) => (hasFocus.value = (event.target as Element).closest('tr') !== null),
    onFocusOut: () => (hasFocus.value = false),
  };
  return { isThere: isPointing.value || hasFocus.value, events };
}

/** The rows as they are wanted; while somebody is at the table none moves, so that a click hits what was aimed at. */
function useSteadyRows(wanted: readonly number[], isHandThere: boolean, of: string): readonly number[] {
  const shown = useRef<{ of: string; rows: readonly number[] }>({ of, rows: wanted });
  const rows = isHandThere && shown.current.of === of ? steadyRows(shown.current.rows, wanted) : wanted;
  shown.current = { of, rows };
  return rows;
}

/** Scrolls as little as it takes to see the row; what is chosen on the map is then seen in the table as well. */
function showRow(view: HTMLDivElement | null, index: number, rowHeight: number): void {
  if (!view || index < 0) return;
  const top = index * rowHeight;
  if (top < view.scrollTop) view.scrollTop = top;
  else if (top + 2 * rowHeight > view.scrollTop + view.clientHeight)
    view.scrollTop = top + 2 * rowHeight - view.clientHeight;
}

function useRowHeight(): number {
  const isCoarse = useSignal(false);
  useEffect(() => {
    isCoarse.value = matchMedia('(pointer: coarse)').matches;
  }, []);
  return isCoarse.value ? 46 : 38;
}

interface RowProps {
  readonly drone: number;
  /** Its place among the rows that are shown. */
  readonly index: number;
  readonly snapshot: Snapshot;
  readonly held: HoldingRow | undefined;
}

function Row({ drone, index, snapshot, held }: RowProps) {
  const { session, editor } = useApp();
  const field = session.field.value;
  const id = session.droneIds.value[drone]!;
  const activity = activityOf(snapshot, drone);
  const isSelected = editor.selectedDrones.value.has(drone);
  const place = field?.toWorld([snapshot.position[2 * drone]!, snapshot.position[2 * drone + 1]!]);
  const where = place && field && !Number.isNaN(place[0]) ? inTable(place, field) : ['–'];
  const battery = batteryOf(snapshot, drone);
  const linkAge = secondsOf(snapshot.linkAge[drone]!);
  const choose = (event: MouseEvent): void => {
    if (event.shiftKey || event.ctrlKey || event.metaKey) editor.toggleDrone(drone);
    else editor.selectDrones(isSelected && editor.selectedDrones.value.size === 1 ? [] : [drone]);
  };
  const holder = held && holderName(held, session.droneIds.value, session.committed.value.no_fly);
  return (
    <tr class={isSelected ? 'is-selected' : ''} aria-rowindex={index + 2} onClick={choose}>
      <td>
        <button
          type="button"
          aria-label={id}
          title={id}
          aria-pressed={isSelected}
          onClick={(event) => {
            event.stopPropagation();
            choose(event);
          }}
        >
          <CutName name={id} />
        </button>
      </td>
      <td title={activity.why}>
        <span class={`state ${activity.severity}`}>
          <Icon name={kSeverityIcons[activity.severity]!} small />
          {activity.label}
        </span>
      </td>
      <td class="place">
        <span>{where.slice(0, -1).map((x) => `${x}, `)}</span>
        <span>{where.slice(-1)}</span>
      </td>
      <td class={battery < 0.25 ? 'alarm' : ''}>{percent(battery)}</td>
      <td class={linkAge > 0.5 ? 'alarm' : ''}>{age(linkAge)}</td>
      <td>{speedOf(snapshot, drone).toFixed(2)}</td>
      <td
        class={holder ? 'warning' : 'dim'}
        title={holder ? `held by ${holder}, ${metres(held.distanceM)}` : 'nothing holds it'}
      >
        {holder ? <CutName name={holder} /> : '–'}
      </td>
    </tr>
  );
}
