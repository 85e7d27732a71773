import type { HoldingRow, Snapshot } from '../link/frames';

/** What the numbers of a snapshot mean, in words. The order is the protocol's. */

export const kModes = [
  'unknown',
  'grounded',
  'taking off',
  'flying',
  'landing',
  'falling',
  'manual',
  'failed',
] as const;

export type Severity = 'ok' | 'info' | 'warning' | 'alarm';

export interface ActivityWords {
  readonly word: string;
  readonly label: string;
  readonly why: string;
  readonly severity: Severity;
}

const activity = (word: string, label: string, severity: Severity, why: string): ActivityWords => ({
  word,
  label,
  severity,
  why,
});

export const kActivities: readonly ActivityWords[] = [
  activity('active', 'Active', 'ok', 'It covers.'),
  activity(
    'never_seen',
    'Never seen',
    'warning',
    'No position has come yet. While it says that it flies, the others keep clear of where it was to start.',
  ),
  activity('grounded', 'Grounded', 'info', 'It is on the ground. Take off sends it back to coverage.'),
  activity('taking_off', 'Taking off', 'info', 'It covers as soon as it flies.'),
  activity('landing', 'Landing', 'warning', 'It comes down; the others cover for it.'),
  activity('emergency_stop', 'Motors off', 'alarm', 'Its motors were stopped. Only take-off on the ground ends that.'),
  activity('overridden', 'Pilot has it', 'warning', 'A pilot flies it; the others keep clear. Give back when done.'),
  activity('marked_failed', 'Marked failed', 'alarm', 'An operator declared it failed. Resume when it is well.'),
  activity('vehicle_failed', 'Failed', 'alarm', 'The vehicle reports a failure; the others keep clear of it.'),
  activity(
    'tracking_lost',
    'Not tracked',
    'alarm',
    'Its position is too old or cannot be true; the others keep clear of it.',
  ),
  activity('link_lost', 'Link lost', 'alarm', 'It has not been heard for too long.'),
  activity('battery_low', 'Battery low', 'alarm', 'Below its reserve: it lands.'),
  activity('held', 'Held', 'info', 'An operator holds it. Resume sends it back to coverage.'),
  activity('recovering', 'Recovering', 'warning', 'It is well again and covers in a moment.'),
  activity(
    'travelling',
    'Travelling',
    'info',
    'It flies to where an operator sent it and waits there. Resume sends it back to coverage.',
  ),
  activity(
    'about_to_take_off',
    'About to rise',
    'warning',
    'It takes off by itself once it is well and the air above it is clear. Land or Hold takes that back.',
  ),
  activity(
    'not_following',
    'Disobeys',
    'alarm',
    'It does not fly what it is told; the others give way. Land it, or let a pilot take it.',
  ),
  activity('outside', 'Outside', 'alarm', 'It left the field and is told to come back. Watch it.'),
  activity(
    'returning',
    'To a pad',
    'info',
    'It flies to a pad to have its battery charged, and covers again by itself. Hold or Land takes that back.',
  ),
  activity(
    'charging',
    'Charging',
    'info',
    'It stands on a pad and rises by itself when it is charged. Land keeps it down.',
  ),
];

const kUnknownActivity = activity('unknown', 'Unknown', 'warning', 'This console does not know that state.');

export const activityOf = (snapshot: Snapshot, drone: number): ActivityWords =>
  kActivities[snapshot.activity[drone]!] ?? kUnknownActivity;

/** A share of one; NaN where it is not reported. */
export function batteryOf(snapshot: Snapshot, drone: number): number {
  const half = snapshot.battery[drone]!;
  return half === 255 ? NaN : half / 200;
}

/** Seconds; Infinity where there never was any. */
export const secondsOf = (milliseconds: number): number => (milliseconds === 65535 ? Infinity : milliseconds / 1000);

export type VelocityKind = 'velocity' | 'nominal' | 'command';

/** m/s, field frame. */
export function vectorOf(snapshot: Snapshot, drone: number, kind: VelocityKind): readonly [number, number] {
  const scale = snapshot.velocityScale;
  return [snapshot[kind][2 * drone]! * scale, snapshot[kind][2 * drone + 1]! * scale];
}

export function speedOf(snapshot: Snapshot, drone: number, kind: VelocityKind = 'velocity'): number {
  return Math.hypot(...vectorOf(snapshot, drone, kind));
}

export const holdersOf = (snapshot: Snapshot, drone: number): readonly HoldingRow[] =>
  snapshot.holding.filter((row) => row.drone === drone);

/** The nearest holding row of every drone that has one: one pass for a whole table. */
export function firstHolders(snapshot: Snapshot): Map<number, HoldingRow> {
  const first = new Map<number, HoldingRow>();
  for (const row of snapshot.holding) if (!first.has(row.drone)) first.set(row.drone, row);
  return first;
}

const kWalls = ['left wall', 'right wall', 'bottom wall', 'top wall'];

/** "cf3", "left wall", "no-fly road". No-fly edges are counted through all polygons. */
export function holderName(
  row: HoldingRow,
  ids: readonly string[],
  polygons: readonly { readonly name: string; readonly outline_m: readonly unknown[] }[],
): string {
  if (row.kind === 'drone') return ids[row.index] ?? 'a drone not shown';
  if (row.kind === 'wall') return kWalls[row.index] ?? 'wall';
  const polygon = polygonOfEdge(row.index, polygons);
  return polygon ? `no-fly ${polygon.name}` : 'no-fly';
}

/** The polygon whose edge has this number when edges are counted through all of them. */
export function polygonOfEdge<P extends { readonly outline_m: readonly unknown[] }>(
  index: number,
  polygons: readonly P[],
): P | null {
  let from = 0;
  for (const polygon of polygons) {
    if (index < from + polygon.outline_m.length) return polygon;
    from += polygon.outline_m.length;
  }
  return null;
}

export const kFlag = { speedLimit: 1, marginsGaveWay: 2, fallback: 4, isObstacle: 8, moreRows: 16, notFinite: 32 };

/** In the air as far as its mode says: a vehicle that failed counts, until it is seen on the ground. */
export const isAirborne = (snapshot: Snapshot, drone: number): boolean => snapshot.mode[drone]! >= 2;
