import type { HoldingRow, Snapshot } from '../link/frames';
import { activityOf, holderName, isAirborne, polygonOfEdge, vectorOf } from '../model/drones';
import type { FieldFrame } from '../model/field_frame';
import { edges, nearestOnSegment, distance, type Point } from '../model/geometry';
import type { NoFly } from '../model/targets';
import { metres } from '../model/units';
import { LabelRoom } from './label_room';
import { at, isOnScreen, label, labelBox, type Pen } from './pen';

/** What is written and drawn about single drones; with many drones only about the selected ones. */
export interface DronesScene {
  readonly snapshot: Snapshot;
  /** Where each drone is drawn, world frame, x and y by turns. */
  readonly places: Float64Array;
  readonly ids: readonly string[];
  readonly selected: ReadonlySet<number>;
  /** The drone under the pointer: named also where there are too many to name. */
  readonly hovered: number | null;
  readonly field: FieldFrame;
  readonly noFly: readonly NoFly[];
  readonly showsLabels: boolean;
}

const kMostLabels = 60;
const kVectorSeconds = 1.5;

export function drawDroneNotes(pen: Pen, scene: DronesScene): void {
  const isFew = scene.snapshot.n <= kMostLabels;
  const noted = isFew ? [...scene.ids.keys()] : [...scene.selected].slice(0, kMostLabels);
  const isNoted = new Set(noted);
  for (const row of scene.snapshot.holding)
    if (isNoted.has(row.drone) && (isFew || scene.selected.has(row.drone))) drawHeldBy(pen, scene, row);
  for (const drone of scene.selected) if (isNoted.has(drone)) drawVectors(pen, scene, drone);
  const room = new LabelRoom();
  const named = new Set(scene.hovered === null ? [] : [scene.hovered]);
  if (scene.showsLabels) for (const drone of inImportance(scene, noted)) named.add(drone);
  for (const drone of named) drawId(pen, scene, drone, room);
}

/** Selected ones first, then those that something is wrong with: where labels would overlap, the first one stands. */
function inImportance(scene: DronesScene, drones: readonly number[]): number[] {
  const ranks = { alarm: 1, warning: 2, info: 3, ok: 4 };
  const rank = (drone: number): number =>
    scene.selected.has(drone) ? 0 : ranks[activityOf(scene.snapshot, drone).severity];
  return [...drones].sort((a, b) => rank(a) - rank(b) || a - b);
}

const placeOf = (scene: DronesScene, drone: number): Point => [scene.places[2 * drone]!, scene.places[2 * drone + 1]!];

function drawId(pen: Pen, scene: DronesScene, drone: number, room: LabelRoom): void {
  const [x, y] = at(pen, placeOf(scene, drone));
  if (!isOnScreen(pen.size, [x, y])) return;
  const { palette } = pen;
  const activity = activityOf(scene.snapshot, drone);
  const isActive = activity.severity === 'ok';
  const colour = activity.severity === 'alarm' ? palette.failure : isActive ? palette.text : palette.warning;
  const id = scene.ids[drone]!;
  if (!room.take(labelBox(pen, id, x + 13, y - 9))) return;
  label(pen, id, x + 13, y - 9, colour);
  if (isActive || !room.take(labelBox(pen, activity.label, x + 13, y + 6))) return;
  label(pen, activity.label, x + 13, y + 6, colour);
}

/** A dashed line to what holds the drone, with the distance. */
function drawHeldBy(pen: Pen, scene: DronesScene, row: HoldingRow): void {
  const from = placeOf(scene, row.drone);
  const to = holderPlace(scene, row, from);
  if (!to || Number.isNaN(from[0]) || !isAirborne(scene.snapshot, row.drone)) return;
  const { context, palette } = pen;
  const [ax, ay] = at(pen, from);
  const [bx, by] = at(pen, to);
  context.strokeStyle = palette.warning;
  context.lineWidth = 1.5;
  context.setLineDash([2, 3]);
  context.beginPath();
  context.moveTo(ax, ay);
  context.lineTo(bx, by);
  context.stroke();
  context.setLineDash([]);
  if (!scene.selected.has(row.drone)) return;
  const name = holderName(row, scene.ids, scene.noFly);
  label(pen, `held by ${name}, ${metres(row.distanceM)}`, (ax + bx) / 2 + 8, (ay + by) / 2 + 16, palette.warning);
}

function holderPlace(scene: DronesScene, row: HoldingRow, from: Point): Point | null {
  if (row.kind === 'drone') return row.index < scene.snapshot.n ? placeOf(scene, row.index) : null;
  if (row.kind === 'wall') return wallPlace(scene.field, row.index, from);
  const polygon = polygonOfEdge(row.index, scene.noFly);
  if (!polygon) return null;
  return edges(polygon.outline_m)
    .map(([a, b]) => nearestOnSegment(from, a, b))
    .reduce((best, p) => (distance(p, from) < distance(best, from) ? p : best));
}

/** The foot on the wall: left, right, bottom, top. */
function wallPlace(field: FieldFrame, wall: number, from: Point): Point {
  const [x, y] = field.toField(from);
  const feet: readonly Point[] = [[0, y], [field.size[0], y], [x, 0], [x, field.size[1]]]; // prettier-ignore
  return field.toWorld(feet[wall] ?? [x, y]);
}

/** Where it wants to go and where it is allowed to: the next 1.5 s. */
function drawVectors(pen: Pen, scene: DronesScene, drone: number): void {
  const from = placeOf(scene, drone);
  for (const [kind, colour, width, dash] of [
    ['nominal', pen.palette.faint, 1.5, [4, 3]],
    ['command', pen.palette.accent, 2.5, []],
  ] as const) {
    const [vx, vy] = scene.field.turned(vectorOf(scene.snapshot, drone, kind));
    arrow(pen, from, [from[0] + vx * kVectorSeconds, from[1] + vy * kVectorSeconds], colour, width, [...dash]);
  }
}

function arrow(pen: Pen, from: Point, to: Point, colour: string, width: number, dash: number[]): void {
  const { context } = pen;
  const [ax, ay] = at(pen, from);
  const [bx, by] = at(pen, to);
  const length = Math.hypot(bx - ax, by - ay);
  if (!(length > 6)) return;
  const [ux, uy] = [(bx - ax) / length, (by - ay) / length];
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.setLineDash(dash);
  context.beginPath();
  context.moveTo(ax, ay);
  context.lineTo(bx, by);
  context.stroke();
  context.setLineDash([]);
  context.beginPath();
  context.moveTo(bx, by);
  context.lineTo(bx - 8 * ux + 4 * uy, by - 8 * uy - 4 * ux);
  context.lineTo(bx - 8 * ux - 4 * uy, by - 8 * uy + 4 * ux);
  context.closePath();
  context.fillStyle = colour;
  context.fill();
}
