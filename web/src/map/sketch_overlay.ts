import { area, distance, type Point } from '../model/geometry';
import { coordinate, metres } from '../model/units';
import type { Tool } from '../session/editor';
import { at, label, tracePath, type Pen } from './pen';

/** What is being drawn right now, the measuring line and the keyboard's cursor. */
export interface SketchScene {
  readonly tool: Tool;
  readonly sketch: readonly Point[];
  readonly measured: readonly Point[];
  /** Where the pointer is, world frame. */
  readonly pointer: Point | null;
  readonly cursor: Point | null;
  readonly extent: number;
}

export function drawSketch(pen: Pen, scene: SketchScene): void {
  const isPolygon = scene.tool === 'area' || scene.tool === 'no-fly';
  if (scene.sketch.length > 0) drawLine(pen, scene, isPolygon);
  if (scene.measured.length > 0) drawMeasure(pen, scene);
  if (scene.cursor) drawCursor(pen, scene.cursor, scene.extent);
}

function drawLine(pen: Pen, scene: SketchScene, isPolygon: boolean): void {
  const { context, palette } = pen;
  const tip = isPolygon ? (scene.pointer ?? scene.cursor) : null;
  const line = tip ? [...scene.sketch, tip] : scene.sketch;
  context.strokeStyle = scene.tool === 'no-fly' ? palette.warning : palette.accent;
  context.lineWidth = scene.tool === 'brush' ? 6 : 2;
  tracePath(pen, line, scene.tool === 'lasso');
  if (scene.tool !== 'brush') {
    context.fillStyle = palette.accent;
    context.globalAlpha = 0.12;
    context.fill();
  }
  context.globalAlpha = scene.tool === 'brush' ? 0.5 : 1;
  context.stroke();
  context.globalAlpha = 1;
  if (isPolygon && scene.sketch.length <= 40) drawCorners(pen, scene.sketch);
  if (isPolygon && scene.sketch.length >= 3) nameArea(pen, scene.sketch);
}

function drawCorners(pen: Pen, points: readonly Point[]): void {
  const { context, palette } = pen;
  points.forEach((point, i) => {
    const [x, y] = at(pen, point);
    context.beginPath();
    // The first corner is larger: a click on it closes the outline.
    context.arc(x, y, i === 0 ? 7 : 4, 0, 2 * Math.PI);
    context.fillStyle = palette.halo;
    context.fill();
    context.lineWidth = 2;
    context.strokeStyle = palette.accent;
    context.stroke();
  });
}

function nameArea(pen: Pen, points: readonly Point[]): void {
  const size = area(points);
  const text = size >= 10_000 ? `${(size / 10_000).toFixed(2)} ha` : `${size.toPrecision(3)} m²`;
  const [x, y] = at(pen, points[points.length - 1]!);
  label(pen, `${text} · Enter closes`, x + 12, y - 10, pen.palette.accent);
}

function drawMeasure(pen: Pen, scene: SketchScene): void {
  const { context, palette } = pen;
  const from = scene.measured[0]!;
  const to = scene.measured[1] ?? scene.pointer ?? scene.cursor;
  if (!to) return;
  context.strokeStyle = palette.text;
  context.lineWidth = 1.5;
  context.setLineDash([7, 4]);
  tracePath(pen, [from, to], false);
  context.stroke();
  context.setLineDash([]);
  for (const end of [from, to]) {
    context.beginPath();
    context.arc(...at(pen, end), 3.5, 0, 2 * Math.PI);
    context.stroke();
  }
  const [ax, ay] = at(pen, from);
  const [bx, by] = at(pen, to);
  const bearing = (90 - (Math.atan2(to[1] - from[1], to[0] - from[0]) * 180) / Math.PI + 360) % 360;
  label(
    pen,
    `${metres(distance(from, to))} · ${bearing.toFixed(0)}° from north`,
    (ax + bx) / 2 + 10,
    (ay + by) / 2 - 8,
    palette.text,
  );
}

function drawCursor(pen: Pen, cursor: Point, extent: number): void {
  const { context, palette } = pen;
  const [x, y] = at(pen, cursor);
  for (const [width, colour] of [
    [5, palette.halo],
    [2, palette.accent],
  ] as const) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.beginPath();
    for (const [dx, dy] of [
      [1, 0],
      [-1, 0],
      [0, 1],
      [0, -1],
    ] as const) {
      // prettier-ignore
      context.moveTo(x + 5 * dx, y + 5 * dy);
      context.lineTo(x + 16 * dx, y + 16 * dy);
    }
    context.stroke();
  }
  label(pen, `${coordinate(cursor[0], extent)}, ${coordinate(cursor[1], extent)}`, x + 18, y - 8, palette.accent);
}
