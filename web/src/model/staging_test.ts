import { describe, expect, it } from 'vitest';
import {
  draftOf,
  editsOf,
  isChanged,
  nothingStaged,
  rebase,
  redoStep,
  restage,
  stage,
  touched,
  undoStep,
} from './staging';
import { apply, freeName, kNoTargets, type Edit, type Targets } from './targets';

const east: Targets = {
  ...kNoTargets,
  clusters: [{ name: 'east', points_m: [[1, 1], [2, 1]], weight: 1, revisit_s: null, protect: false }], // prettier-ignore
};
const weight = (value: number): Edit => ({ op: 'set_weight', kind: 'cluster', name: 'east', weight: value });
const step = (...edits: Edit[]) => ({ what: 'a step', edits });

describe('staged edits', () => {
  it('The draft is the base with the staged edits, and the base stays as it is', () => {
    const staged = stage(nothingStaged(3), step(weight(4)), 3);
    expect(draftOf(east, staged)?.clusters[0]?.weight).toBe(4);
    expect(east.clusters[0]?.weight).toBe(1);
    expect(isChanged(east, draftOf(east, staged)!, { kind: 'cluster', name: 'east' })).toBe(true);
  });

  it('Undo takes back one gesture, redo brings it back, a new gesture forgets what was undone', () => {
    let staged = stage(stage(nothingStaged(0), step(weight(2)), 0), step(weight(3)), 0);
    staged = undoStep(staged);
    expect(editsOf(staged)).toEqual([weight(2)]);
    expect(editsOf(redoStep(staged))).toEqual([weight(2), weight(3)]);
    expect(redoStep(stage(staged, step(weight(9)), 0)).steps).toHaveLength(2);
  });

  it('A drag is one step however many moves it has', () => {
    const moved = (x: number): Edit => ({ op: 'move_point', kind: 'cluster', name: 'east', index: 0, point_m: [x, 0] });
    let staged = stage(nothingStaged(0), step(moved(1)), 0);
    for (const x of [2, 3, 4]) staged = restage(staged, step(moved(x)), 0);
    expect(staged.steps).toHaveLength(1);
    expect(draftOf(east, staged)?.clusters[0]?.points_m[0]).toEqual([4, 0]);
  });

  it('What it is based on is the revision that was seen when the first edit was made', () => {
    const staged = stage(stage(nothingStaged(1), step(weight(2)), 5), step(weight(3)), 6);
    expect(staged.basedOn).toBe(5);
  });

  it('Steps whose entry somebody else removed are lost, the others stay', () => {
    const add: Edit = { op: 'add_point', kind: 'cluster', name: 'west', point_m: [0, 0] };
    const staged = stage(stage(nothingStaged(0), step(weight(2)), 0), step(add), 0);
    const after = rebase(kNoTargets, staged);
    expect(after.lost).toHaveLength(1);
    expect(editsOf(after.staging)).toEqual([add]);
  });

  it('What is touched names each entry once', () => {
    const staged = stage(stage(nothingStaged(0), step(weight(2)), 0), step(weight(3)), 0);
    expect(touched(staged)).toEqual([{ kind: 'cluster', name: 'east' }]);
  });
});

describe('edits', () => {
  const points = (targets: Targets | null) => targets?.clusters[0]?.points_m;

  it('Points are added at the end or before an index, moved and removed', () => {
    const edit = (op: 'add_point' | 'move_point', index: number) =>
      apply(east, { op, kind: 'cluster', name: 'east', index, point_m: [9, 9] });
    expect(points(edit('add_point', 0))).toEqual([[9, 9], [1, 1], [2, 1]]); // prettier-ignore
    expect(points(edit('add_point', 2))).toEqual([[1, 1], [2, 1], [9, 9]]); // prettier-ignore
    expect(points(edit('move_point', 1))).toEqual([[1, 1], [9, 9]]); // prettier-ignore
    expect(points(apply(east, { op: 'remove_point', kind: 'cluster', name: 'east', index: 0 }))).toEqual([[2, 1]]);
  });

  it('An index or an entry that is not there gives nothing', () => {
    expect(apply(east, { op: 'move_point', kind: 'cluster', name: 'east', index: 2, point_m: [0, 0] })).toBe(null);
    expect(apply(east, { op: 'remove', kind: 'area', name: 'east' })).toBe(null);
    expect(apply(east, { op: 'set_soft_edge', kind: 'cluster', name: 'east', soft_edge_m: 1 })).toBe(null);
  });

  it('A point for a cluster that is not there makes the cluster; its last point takes it away', () => {
    const made = apply(kNoTargets, { op: 'add_point', kind: 'cluster', name: 'new', point_m: [1, 2] });
    expect(made?.clusters).toEqual([{ name: 'new', points_m: [[1, 2]], weight: 1, revisit_s: null, protect: false }]);
    expect(apply(made!, { op: 'remove_point', kind: 'cluster', name: 'new', index: 0 })).toEqual(kNoTargets);
  });

  it('A free name is one that neither clusters nor areas have', () => {
    expect(freeName(east, 'area', 'east')).toBe('east-2');
    expect(freeName(east, 'no_fly', 'east')).toBe('east');
  });
});
