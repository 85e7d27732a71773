/** JSON messages of the server, as protocol/README.md describes them, checked member by member as they come in. */
import {
  finite,
  flag,
  list,
  maybe,
  oneOf,
  orNull,
  point,
  record,
  ShapeError,
  text,
  type Shape,
  type Shaped,
} from './shape';

const name = text(256);
const sentence = text(4000);
const role = oneOf('viewer', 'operator', 'safety_pilot');

const clusterShape = record({
  name,
  points_m: list(point, 10_000),
  weight: finite,
  revisit_s: maybe(finite),
  protect: flag,
});
const areaShape = record({
  name,
  outline_m: list(point, 1000),
  weight: finite,
  soft_edge_m: finite,
  revisit_s: maybe(finite),
  protect: flag,
});
const noFlyShape = record({ name, outline_m: list(point, 1000) });

const helloShape = record({
  protocol: finite,
  program: sentence,
  client: finite,
  name,
  role,
  roles: list(role, 10),
  login: flag,
  run: name,
  steady_ms: finite,
});

const displayShape = record({
  field: record({ length_x_m: finite, length_y_m: finite, origin_m: point, yaw_rad: finite }),
  drones: maybe(finite),
  dt_s: finite,
  separation_m: finite,
  wall_distance_m: finite,
  barrier_radius_m: finite,
  speed_limit_m_s: finite,
  footprint_radius_m: finite,
  sigma_min_m: finite,
  can_change_speed: flag,
  can_pause: flag,
  least_speed: maybe(finite),
  most_speed: finite,
});

const missionShape = record({
  epoch: finite,
  fleet: oneOf('SIM', 'LIVE', 'REPLAY'),
  mission: record({
    name,
    drones: list(record({ id: text(64) }), 200_000),
    stations: maybe(list(record({ name, pads_m: list(point, 1000) }), 200)),
  }),
  display: displayShape,
  recording: maybe(record({ begin_s: finite, end_s: finite, ticks: finite, spacing_s: finite, incomplete: sentence })),
});

const targetsShape = record({
  epoch: finite,
  revision: finite,
  by: name,
  what: sentence,
  can_undo: flag,
  can_redo: flag,
  undo_what: sentence,
  redo_what: sentence,
  clusters: list(clusterShape, 1000),
  areas: list(areaShape, 200),
  no_fly: list(noFlyShape, 200),
  uniform_floor: finite,
});

const eventShape = record({
  number: finite,
  tick: finite,
  time_s: finite,
  wall_ms: finite,
  severity: oneOf('info', 'warning', 'alarm'),
  source: name,
  what: name,
  drone: name,
  was: name,
  by: name,
  text: sentence,
  effect: sentence,
  next: sentence,
  epoch: maybe(finite),
});

const statusShape = record({
  epoch: finite,
  areas: list(
    record({
      kind: oneOf('cluster', 'area'),
      name,
      age_s: orNull(finite),
      worst_s: orNull(finite),
      deadline_s: maybe(finite),
      is_overdue: flag,
      asked: orNull(finite),
      achieved: orNull(finite),
      foreseen_s: maybe(finite),
    }),
    2000,
  ),
  plan: maybe(list(record({ drone: finite, pad: maybe(finite), leaves_in_s: finite, back_in_s: maybe(finite) }), 200)),
  recording: maybe(record({ folder: sentence, ticks: finite, lost_ticks: finite })),
  lost_events: finite,
  clients: finite,
  lateness_us: maybe(record({ p50: finite, p99: finite, max: finite })),
  waits_for_resume: flag,
  waiting: maybe(list(record({ text: sentence, from: name }), 100)),
  waiting_more: maybe(finite),
  replay: maybe(
    record({
      number: finite,
      is_recomputed: flag,
      is_seeking: flag,
      progress: finite,
      is_at_end: flag,
      difference: sentence,
    }),
  ),
});

const editedShape = record({ kind: oneOf('cluster', 'area', 'no_fly'), name });

const presenceShape = record({
  operators: list(record({ client: finite, name, role, editing: list(editedShape, 20) }), 2000),
});

const ackShape = record({
  id: finite,
  tick: maybe(finite),
  pending: maybe(flag),
  revision: maybe(finite),
  refused_drones: maybe(list(record({ drone: text(64), reason: sentence }), 200_000)),
  refused_count: maybe(finite),
});

const refusedShape = record({ id: orNull(finite), code: name, reason: sentence });

const outlookShape = record({
  in_s: list(finite, 1000),
  metric_percent: list(finite, 1000),
  worst_age_s: list(finite, 1000),
  areas: list(
    record({
      kind: oneOf('cluster', 'area'),
      name,
      asked: finite,
      achieved: finite,
      covered_in_s: orNull(finite),
      seen_in_s: orNull(finite),
      worst_age_s: finite,
      deadline_s: orNull(finite),
    }),
    2000,
  ),
  least_pair_m: orNull(finite),
  active: finite,
});

const previewShape = record({
  id: finite,
  epoch: finite,
  revision: finite,
  tick: finite,
  time_s: finite,
  seconds: finite,
  as_is: outlookShape,
  what_if: orNull(outlookShape),
  ghosts: record({ spacing_s: finite, xy_m: list(list(orNull(finite), 40_000), 200_000) }),
});

/** A velocity; what is not a number came as null. */
const velocity: Shape<readonly [number, number]> = (value, place) => {
  const parts = list(orNull(finite), 2)(value, place);
  return [parts[0] ?? NaN, parts[1] ?? NaN];
};

const whyShape = record({
  id: finite,
  epoch: finite,
  tick: finite,
  time_s: finite,
  drone: name,
  activity: name,
  u_max_m_s: finite,
  u_nom_m_s: velocity,
  u_m_s: velocity,
  changed_m_s: orNull(finite),
  speed_limited: flag,
  margin_used: flag,
  fallback: flag,
  rows: list(
    record({
      kind: oneOf('drone', 'wall', 'no_fly'),
      drone: maybe(name),
      wall: maybe(name),
      edge: maybe(finite),
      distance_m: finite,
      normal: point,
      offset_m_s: finite,
      slack_m_s: finite,
      priority: name,
      holds: flag,
    }),
    10_000,
  ),
});

const kShapes = {
  hello: helloShape,
  mission: missionShape,
  targets: targetsShape,
  events: record({ afresh: maybe(flag), events: list(eventShape, 100_000) }),
  status: statusShape,
  presence: presenceShape,
  ack: ackShape,
  refused: refusedShape,
  preview: previewShape,
  why: whyShape,
  pong: record({ id: finite, steady_ms: finite }),
  bye: record({ code: name, reason: sentence }),
} as const satisfies Record<string, Shape<unknown>>;

type Known = typeof kShapes;
export type ServerMessage = { [K in keyof Known]: { type: K } & Shaped<Known[K]> }[keyof Known];
export type MessageOf<K extends ServerMessage['type']> = Extract<ServerMessage, { type: K }>;

export type Hello = MessageOf<'hello'>;
export type Mission = MessageOf<'mission'>;
export type Display = Shaped<typeof displayShape>;
export type TargetsMessage = MessageOf<'targets'>;
export type Recording = NonNullable<Mission['recording']>;
export type Status = MessageOf<'status'>;
export type AreaStatus = Status['areas'][number];
export type Turn = NonNullable<Shaped<typeof statusShape>['plan']>[number];
export type SwarmEvent = Shaped<typeof eventShape>;
export type Operator = Shaped<typeof presenceShape>['operators'][number];
export type Edited = Shaped<typeof editedShape>;
export type Ack = MessageOf<'ack'>;
export type Refused = MessageOf<'refused'>;
export type Preview = MessageOf<'preview'>;
export type Why = MessageOf<'why'>;
export type WhyRow = Why['rows'][number];
export type Outlook = Preview['as_is'];
export type Role = Shaped<typeof role>;

/** The message, or null for a type that a later version added. Throws ShapeError. */
export function decodeMessage(json: string): ServerMessage | null {
  const value: unknown = parse(json);
  if (typeof value !== 'object' || value === null) throw new ShapeError('a message that is not an object');
  const type = (value as { type?: unknown }).type;
  if (typeof type !== 'string') throw new ShapeError('a message without a type');
  if (!Object.hasOwn(kShapes, type)) return null;
  return { type, ...kShapes[type as keyof Known](value, type) } as ServerMessage;
}

function parse(json: string): unknown {
  try {
    return JSON.parse(json);
  } catch {
    throw new ShapeError('a message that is not JSON');
  }
}
