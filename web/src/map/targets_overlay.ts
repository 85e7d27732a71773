import { centroid, spreadOf, type Ellipse, type Point } from '../model/geometry';
import { isChanged } from '../model/staging';
import { allEntries, pointsOf, type Entry, type EntryName, type Kind, type Targets } from '../model/targets';
import { at, isOnScreen, label, tracePath, type Pen } from './pen';

/** What the map shows of targets, and how it is being edited. */
export interface TargetsScene {
  readonly committed: Targets;
  readonly draft: Targets;
  readonly selected: EntryName | null;
  readonly selectedPoint: number | null;
  readonly sigmaMin: number;
  readonly showsNoFly: boolean;
  readonly showsLabels: boolean;
  /** Who else edits an entry: key "kind name". */
  readonly editedBy: ReadonlyMap<string, string>;
  readonly overdue: ReadonlySet<string>;
}

const kMostDots = 3000;

export function drawTargets(pen: Pen, scene: TargetsScene): void {
  for (const { kind, entry } of allEntries(scene.draft)) {
    if (kind === 'no_fly' && !scene.showsNoFly) continue;
    const which = { kind, name: entry.name };
    const isSelected = scene.selected?.kind === kind && scene.selected.name === entry.name;
    const isGhost = isChanged(scene.committed, scene.draft, which);
    if (kind === 'cluster') drawCluster(pen, entry, scene, isSelected, isGhost);
    else drawOutline(pen, entry, kind, isSelected, isGhost, scene.selectedPoint);
    if (scene.showsLabels || isSelected) drawName(pen, kind, entry, scene, isGhost);
  }
}

function drawCluster(pen: Pen, entry: Entry, scene: TargetsScene, isSelected: boolean, isGhost: boolean): void {
  const { context, palette } = pen;
  const points = pointsOf(entry);
  context.lineWidth = 1.25;
  for (let i = 0; i < Math.min(points.length, kMostDots); i++) {
    const [x, y] = at(pen, points[i]!);
    if (!isOnScreen(pen.size, [x, y])) continue;
    const isPoint = isSelected && scene.selectedPoint === i;
    context.beginPath();
    context.arc(x, y, isSelected ? 4.5 : 3, 0, 2 * Math.PI);
    context.fillStyle = isPoint ? palette.accent : isGhost ? palette.halo : palette.target;
    context.strokeStyle = isPoint ? palette.text : isGhost ? palette.target : palette.halo;
    context.fill();
    context.stroke();
  }
  if (isSelected) drawHandles(pen, spreadOf(points, scene.sigmaMin));
}

/** The 1-sigma ellipse with its two handles: the middle moves, the tip spreads. */
function drawHandles(pen: Pen, ellipse: Ellipse): void {
  const { context, camera, palette } = pen;
  const [x, y] = at(pen, ellipse.centre);
  const scale = camera.pixelsPerMetre;
  context.beginPath();
  context.ellipse(x, y, ellipse.half[0] * scale, ellipse.half[1] * scale, -ellipse.angle, 0, 2 * Math.PI);
  context.setLineDash([5, 4]);
  context.strokeStyle = palette.accent;
  context.lineWidth = 1.5;
  context.stroke();
  context.setLineDash([]);
  for (const [hx, hy, side] of [
    [x, y, 7],
    [...at(pen, spreadHandle(ellipse)), 6],
  ] as const) {
    context.beginPath();
    context.rect(hx - side, hy - side, 2 * side, 2 * side);
    context.fillStyle = palette.halo;
    context.fill();
    context.stroke();
  }
  context.beginPath();
  context.moveTo(x - 4, y);
  context.lineTo(x + 4, y);
  context.moveTo(x, y - 4);
  context.lineTo(x, y + 4);
  context.stroke();
}

export const spreadHandle = (ellipse: Ellipse): Point => [
  ellipse.centre[0] + ellipse.half[0] * Math.cos(ellipse.angle),
  ellipse.centre[1] + ellipse.half[0] * Math.sin(ellipse.angle),
];

function drawOutline(
  pen: Pen,
  entry: Entry,
  kind: Kind,
  isSelected: boolean,
  isGhost: boolean,
  selectedPoint: number | null,
): void {
  const { context, palette } = pen;
  const colour = kind === 'no_fly' ? palette.warning : palette.area;
  tracePath(pen, pointsOf(entry), true);
  if (kind === 'no_fly') hatch(pen, colour);
  context.strokeStyle = isSelected ? palette.accent : colour;
  context.lineWidth = isSelected ? 2.25 : 1.5;
  if (isGhost) context.setLineDash([6, 4]);
  tracePath(pen, pointsOf(entry), true);
  context.stroke();
  context.setLineDash([]);
  if (isSelected) drawVertices(pen, pointsOf(entry), selectedPoint);
}

function drawVertices(pen: Pen, points: readonly Point[], selectedPoint: number | null): void {
  const { context, palette } = pen;
  points.forEach((point, i) => {
    const [x, y] = at(pen, point);
    context.beginPath();
    context.arc(x, y, 5.5, 0, 2 * Math.PI);
    context.fillStyle = i === selectedPoint ? palette.accent : palette.halo;
    context.fill();
    context.strokeStyle = palette.accent;
    context.lineWidth = 1.75;
    context.stroke();
  });
}

/** Diagonal lines inside the current path: forbidden, without a word and without colour. */
function hatch(pen: Pen, colour: string): void {
  const { context, size } = pen;
  context.save();
  context.clip();
  context.fillStyle = pen.palette.halo;
  context.globalAlpha = 0.35;
  context.fillRect(0, 0, size.width, size.height);
  context.globalAlpha = 0.5;
  context.strokeStyle = colour;
  context.lineWidth = 1;
  context.beginPath();
  for (let x = -size.height; x < size.width; x += 9) {
    context.moveTo(x, size.height);
    context.lineTo(x + size.height, 0);
  }
  context.stroke();
  context.restore();
}

function drawName(pen: Pen, kind: Kind, entry: Entry, scene: TargetsScene, isGhost: boolean): void {
  const points = pointsOf(entry);
  const anchor = kind === 'cluster' ? highest(points) : centroid(points);
  const [x, y] = at(pen, anchor);
  if (!isOnScreen(pen.size, [x, y])) return;
  const { palette } = pen;
  const isLate = scene.overdue.has(entry.name) && kind !== 'no_fly';
  const text = `${isLate ? '⚠ ' : ''}${entry.name}${isGhost ? ' (staged)' : ''}`;
  const colour = isLate ? palette.failure : kind === 'no_fly' ? palette.warning : palette.text;
  label(pen, text, x, y - 11, colour, 'center');
  const editor = scene.editedBy.get(`${kind} ${entry.name}`);
  if (editor) label(pen, `✎ ${editor}`, x, y + 8, palette.accent, 'center');
}

const highest = (points: readonly Point[]): Point => {
  const top = points.reduce((best, p) => (p[1] > best[1] ? p : best), points[0] ?? [0, 0]);
  return [centroid(points)[0], top[1]];
};
