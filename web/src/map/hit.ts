import { contains, distance, distanceToSegment, edges, spreadOf, type Point } from '../model/geometry';
import { allEntries, pointsOf, type EntryName, type Targets } from '../model/targets';
import { toScreen, toWorld, type Camera, type Size } from './camera';
import { spreadHandle } from './targets_overlay';

/** What lies under the pointer. */
export type Hit =
  | { readonly part: 'drone'; readonly drone: number }
  | { readonly part: 'point'; readonly which: EntryName; readonly index: number }
  | { readonly part: 'centre' | 'spread' | 'body'; readonly which: EntryName };

export interface HitScene {
  readonly camera: Camera;
  readonly size: Size;
  readonly targets: Targets;
  readonly selected: EntryName | null;
  readonly sigmaMin: number;
  /** World frame, x and y by turns; NaN: not known. */
  readonly drones: Float64Array;
}

/** A finger is less exact than a mouse: the caller says how many CSS pixels off is still a hit. */
export function hitAt(scene: HitScene, s: Point, reach: number): Hit | null {
  return handleAt(scene, s, reach) ?? droneAt(scene, s, reach) ?? entryAt(scene, s, reach);
}

function handleAt(scene: HitScene, s: Point, reach: number): Hit | null {
  const which = scene.selected;
  const found =
    which && allEntries(scene.targets).find(({ kind, entry }) => kind === which.kind && entry.name === which.name);
  if (!which || !found) return null;
  const points = pointsOf(found.entry);
  const near = (p: Point): boolean => distance(toScreen(scene.camera, scene.size, p), s) <= reach;
  const index = points.findIndex(near);
  const spread = spreadOf(points, scene.sigmaMin);
  if (which.kind === 'cluster' && near(spreadHandle(spread))) return { part: 'spread', which };
  if (index >= 0) return { part: 'point', which, index };
  return which.kind === 'cluster' && near(spread.centre) ? { part: 'centre', which } : null;
}

function droneAt(scene: HitScene, s: Point, reach: number): Hit | null {
  let best = -1;
  let least = reach;
  for (let i = 0; 2 * i < scene.drones.length; i++) {
    const p: Point = [scene.drones[2 * i]!, scene.drones[2 * i + 1]!];
    const away = distance(toScreen(scene.camera, scene.size, p), s);
    if (away <= least) [best, least] = [i, away];
  }
  return best < 0 ? null : { part: 'drone', drone: best };
}

function entryAt(scene: HitScene, s: Point, reach: number): Hit | null {
  const p = toWorld(scene.camera, scene.size, s);
  const metres = reach / scene.camera.pixelsPerMetre;
  for (const { kind, entry } of allEntries(scene.targets)) {
    const points = pointsOf(entry);
    const isHit =
      kind === 'cluster'
        ? points.some((point) => distance(point, p) <= metres)
        : contains(points, p) || edges(points).some(([a, b]) => distanceToSegment(p, a, b) <= metres / 2);
    if (isHit) return { part: 'body', which: { kind, name: entry.name } };
  }
  return null;
}
