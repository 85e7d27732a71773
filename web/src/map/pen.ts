import type { Point } from '../model/geometry';
import { toScreen, type Camera, type Size } from './camera';
import type { Box } from './label_room';
import type { Palette } from './palette';

export type Canvas2d = CanvasRenderingContext2D;

/** Everything a 2-D layer needs to draw in world coordinates on a canvas in CSS pixels. */
export interface Pen {
  readonly context: Canvas2d;
  readonly camera: Camera;
  readonly size: Size;
  readonly palette: Palette;
}

export const kFont = '500 12px "Inter", system-ui, "Segoe UI", "Noto Sans", "DejaVu Sans", sans-serif';

export const at = (pen: Pen, p: Point): Point => toScreen(pen.camera, pen.size, p);

export function tracePath(pen: Pen, points: readonly Point[], closed: boolean): void {
  const { context } = pen;
  context.beginPath();
  points.forEach((point, i) => {
    const [x, y] = at(pen, point);
    if (i === 0) context.moveTo(x, y);
    else context.lineTo(x, y);
  });
  if (closed) context.closePath();
}

/** How high a line of text is. */
const kLinePx = 14;

/** Where a label with this baseline stands, as label() would draw it. */
export function labelBox(pen: Pen, text: string, x: number, y: number): Box {
  pen.context.font = kFont;
  const width = pen.context.measureText(text).width;
  const left = isCutOff(pen, x, width) ? x - width : x;
  return [left, y - kLinePx + 3, left + width, y + 3];
}

/** Whether a label to the right would reach below the buttons at the map's edge. */
const isCutOff = (pen: Pen, x: number, width: number): boolean => x + width > pen.size.width - 66;

/** Text with a halo, so that it reads on any layer. */
export function label(
  pen: Pen,
  text: string,
  x: number,
  y: number,
  colour: string,
  align: CanvasTextAlign = 'left',
): void {
  const { context, palette } = pen;
  context.font = kFont;
  const isCut = align === 'left' && isCutOff(pen, x, context.measureText(text).width);
  context.textAlign = isCut ? 'right' : align;
  context.lineJoin = 'round';
  context.lineWidth = 3.5;
  context.strokeStyle = palette.halo;
  context.strokeText(text, x, y);
  context.fillStyle = colour;
  context.fillText(text, x, y);
}

export const isOnScreen = (size: Size, [x, y]: Point, margin = 40): boolean =>
  x > -margin && y > -margin && x < size.width + margin && y < size.height + margin;
