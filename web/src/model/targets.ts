import type { Point } from './geometry';

/** Where the swarm looks, as the program says it; world frame, m. Names are unique among clusters and areas. */

export interface Cluster {
  readonly name: string;
  readonly points_m: readonly Point[];
  readonly weight: number;
  readonly revisit_s: number | null;
  /** It keeps its drones where there are fewer. */
  readonly protect: boolean;
}

export interface Area {
  readonly name: string;
  readonly outline_m: readonly Point[];
  readonly weight: number;
  readonly soft_edge_m: number;
  readonly revisit_s: number | null;
  /** It keeps its drones where there are fewer. */
  readonly protect: boolean;
}

export interface NoFly {
  readonly name: string;
  readonly outline_m: readonly Point[];
}

export interface Targets {
  readonly clusters: readonly Cluster[];
  readonly areas: readonly Area[];
  readonly no_fly: readonly NoFly[];
  readonly uniform_floor: number;
}

export const kNoTargets: Targets = { clusters: [], areas: [], no_fly: [], uniform_floor: 0 };

export type Kind = 'cluster' | 'area' | 'no_fly';
export type Entry = Cluster | Area | NoFly;

export interface EntryName {
  readonly kind: Kind;
  readonly name: string;
}

/** One operation on the targets, as the protocol names it. */
export type Edit =
  | { readonly op: 'add'; readonly kind: Kind; readonly entry: Entry }
  | { readonly op: 'replace'; readonly kind: Kind; readonly name: string; readonly entry: Entry }
  | { readonly op: 'remove'; readonly kind: Kind; readonly name: string }
  | { readonly op: 'rename'; readonly kind: Kind; readonly name: string; readonly to: string }
  | {
      readonly op: 'add_point';
      readonly kind: Kind;
      readonly name: string;
      readonly index?: number;
      readonly point_m: Point;
    }
  | {
      readonly op: 'move_point';
      readonly kind: Kind;
      readonly name: string;
      readonly index: number;
      readonly point_m: Point;
    }
  | { readonly op: 'remove_point'; readonly kind: Kind; readonly name: string; readonly index: number }
  | { readonly op: 'set_weight'; readonly kind: Kind; readonly name: string; readonly weight: number }
  | { readonly op: 'set_revisit'; readonly kind: Kind; readonly name: string; readonly revisit_s: number | null }
  | { readonly op: 'set_protect'; readonly kind: Kind; readonly name: string; readonly protect: boolean }
  | { readonly op: 'set_soft_edge'; readonly kind: Kind; readonly name: string; readonly soft_edge_m: number }
  | { readonly op: 'set_uniform_floor'; readonly uniform_floor: number };

export const pointsOf = (entry: Entry): readonly Point[] => ('points_m' in entry ? entry.points_m : entry.outline_m);

const kLists = { cluster: 'clusters', area: 'areas', no_fly: 'no_fly' } as const;

export function entriesOf(targets: Targets, kind: Kind): readonly Entry[] {
  return targets[kLists[kind]];
}

export function find(targets: Targets, which: EntryName): Entry | null {
  return entriesOf(targets, which.kind).find((entry) => entry.name === which.name) ?? null;
}

/** Everything that is there, in the order of the lists. */
export function allEntries(targets: Targets): { kind: Kind; entry: Entry }[] {
  return (['cluster', 'area', 'no_fly'] as const).flatMap((kind) =>
    entriesOf(targets, kind).map((entry) => ({ kind, entry })),
  );
}

export const isEmpty = (targets: Targets): boolean =>
  targets.clusters.length === 0 && targets.areas.length === 0 && targets.uniform_floor === 0;

/** `base`, `base-2`, `base-3`: the first that nobody has. Clusters and areas share their names. */
export function freeName(targets: Targets, kind: Kind, base: string): string {
  const taken = new Set(
    (kind === 'no_fly' ? targets.no_fly : [...targets.clusters, ...targets.areas]).map((entry) => entry.name),
  );
  for (let i = 1; ; i++) {
    const name = i === 1 ? base : `${base}-${i}`;
    if (!taken.has(name)) return name;
  }
}

/** The targets after the edit, or null where it speaks of an entry or a point that is not there. */
export function apply(targets: Targets, edit: Edit): Targets | null {
  if (edit.op === 'set_uniform_floor') return { ...targets, uniform_floor: edit.uniform_floor };
  if (edit.op === 'add') return put(targets, edit.kind, [...entriesOf(targets, edit.kind), edit.entry]);
  if (edit.op === 'add_point' && edit.kind === 'cluster' && !find(targets, edit)) return withNewCluster(targets, edit);
  const entry = find(targets, edit);
  if (!entry) return null;
  const changed = changedEntry(entry, edit);
  if (changed === 'gone') return put(targets, edit.kind, without(targets, edit));
  if (!changed) return null;
  return put(
    targets,
    edit.kind,
    entriesOf(targets, edit.kind).map((other) => (other === entry ? changed : other)),
  );
}

type EntryEdit = Exclude<Edit, { op: 'add' } | { op: 'set_uniform_floor' }>;

const without = (targets: Targets, which: EntryName): readonly Entry[] =>
  entriesOf(targets, which.kind).filter((entry) => entry.name !== which.name);

const put = (targets: Targets, kind: Kind, entries: readonly Entry[]): Targets => ({
  ...targets,
  [kLists[kind]]: entries,
});

const withNewCluster = (targets: Targets, edit: { name: string; point_m: Point }): Targets =>
  put(targets, 'cluster', [
    ...targets.clusters,
    { name: edit.name, points_m: [edit.point_m], weight: 1, revisit_s: null, protect: false },
  ]);

function changedEntry(entry: Entry, edit: EntryEdit): Entry | 'gone' | null {
  switch (edit.op) {
    case 'replace':
      return edit.entry;
    case 'remove':
      return 'gone';
    case 'rename':
      return { ...entry, name: edit.to };
    case 'set_weight':
      return 'weight' in entry ? { ...entry, weight: edit.weight } : null;
    case 'set_revisit':
      return 'weight' in entry ? { ...entry, revisit_s: edit.revisit_s } : null;
    case 'set_protect':
      return 'weight' in entry ? { ...entry, protect: edit.protect } : null;
    case 'set_soft_edge':
      return 'soft_edge_m' in entry ? { ...entry, soft_edge_m: edit.soft_edge_m } : null;
    case 'add_point':
    case 'move_point':
    case 'remove_point':
      return withPointsEdited(entry, edit);
  }
}

type PointEdit = Extract<Edit, { op: 'add_point' | 'move_point' | 'remove_point' }>;

function withPointsEdited(entry: Entry, edit: PointEdit): Entry | 'gone' | null {
  const points = [...pointsOf(entry)];
  const index = edit.index ?? points.length;
  if (index < 0 || index > points.length - (edit.op === 'add_point' ? 0 : 1)) return null;
  if (edit.op === 'add_point') points.splice(index, 0, edit.point_m);
  else if (edit.op === 'move_point') points[index] = edit.point_m;
  else points.splice(index, 1);
  return points.length === 0 ? 'gone' : withPoints(entry, points);
}

export function withPoints(entry: Entry, points: readonly Point[]): Entry {
  return 'points_m' in entry ? { ...entry, points_m: points } : { ...entry, outline_m: points };
}
