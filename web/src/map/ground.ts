import type { FieldFrame } from '../model/field_frame';
import { metres } from '../model/units';
import { roundLength, toWorld } from './camera';
import { at, isOnScreen, kFont, tracePath, type Pen } from './pen';

/** What lies under everything: the field's ground, a grid of round world coordinates. */
export function drawGround(pen: Pen, field: FieldFrame | null, withGrid: boolean): void {
  const { context, size, palette } = pen;
  context.fillStyle = palette.outside;
  context.fillRect(0, 0, size.width, size.height);
  if (!field) return;
  tracePath(pen, field.corners(), true);
  context.fillStyle = palette.field;
  context.fill();
  if (withGrid) {
    context.save();
    context.clip();
    drawGrid(pen);
    context.restore();
  }
  tracePath(pen, field.corners(), true);
  context.strokeStyle = palette.border;
  context.lineWidth = 1.5;
  context.stroke();
}

function drawGrid(pen: Pen): void {
  const { context, camera, size, palette } = pen;
  const step = roundLength(camera, 90);
  context.strokeStyle = palette.grid;
  context.lineWidth = 1;
  context.beginPath();
  for (const x of roundValues(pen, step, 0)) {
    const [px] = at(pen, [x, 0]);
    context.moveTo(Math.round(px) + 0.5, 0);
    context.lineTo(Math.round(px) + 0.5, size.height);
  }
  for (const y of roundValues(pen, step, 1)) {
    const [, py] = at(pen, [camera.centre[0], y]);
    context.moveTo(0, Math.round(py) + 0.5);
    context.lineTo(size.width, Math.round(py) + 0.5);
  }
  context.stroke();
}

/** The multiples of `step` that are seen, along world x (0) or y (1). */
function roundValues(pen: Pen, step: number, axis: 0 | 1): number[] {
  const { camera, size } = pen;
  const [low, high] = [toWorld(camera, size, [0, size.height])[axis], toWorld(camera, size, [size.width, 0])[axis]];
  const values: number[] = [];
  for (let i = Math.ceil(low / step); i * step <= high && values.length < 200; i++) values.push(i * step);
  return values;
}

/** World coordinates along the lower and left edge, and the scale bar. */
export function drawRulers(pen: Pen): void {
  const { context, size, camera } = pen;
  const step = roundLength(camera, 90);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  context.font = kFont;
  for (const x of roundValues(pen, step, 0)) {
    const px = at(pen, [x, 0])[0];
    if (px > 50 && px < size.width - 190) ruled(pen, x.toFixed(decimals), px, size.height - 8, 'center');
  }
  for (const y of roundValues(pen, step, 1)) {
    const py = at(pen, [camera.centre[0], y])[1];
    if (py > 58 && py < size.height - 30) ruled(pen, y.toFixed(decimals), 8, py + 4, 'left');
  }
  drawScaleBar(pen);
}

function ruled(pen: Pen, text: string, x: number, y: number, align: CanvasTextAlign): void {
  const { context, palette } = pen;
  if (!isOnScreen(pen.size, [x, y])) return;
  context.textAlign = align;
  context.strokeStyle = palette.halo;
  context.lineWidth = 3;
  context.strokeText(text, x, y);
  context.fillStyle = palette.faint;
  context.fillText(text, x, y);
}

function drawScaleBar(pen: Pen): void {
  const { context, camera, size, palette } = pen;
  const length = roundLength(camera, 120);
  const pixels = length * camera.pixelsPerMetre;
  const [right, bottom] = [size.width - 16, size.height - 14];
  context.strokeStyle = palette.halo;
  context.lineWidth = 5;
  for (const pass of [0, 1]) {
    if (pass === 1) {
      context.strokeStyle = palette.text;
      context.lineWidth = 2;
    }
    context.beginPath();
    context.moveTo(right - pixels, bottom - 6);
    context.lineTo(right - pixels, bottom);
    context.lineTo(right, bottom);
    context.lineTo(right, bottom - 6);
    context.stroke();
  }
  context.textAlign = 'center';
  context.fillStyle = palette.text;
  context.fillText(
    length < 1 ? `${Math.round(length * 100)} cm` : metres(length).replace(/\.0+ /, ' '),
    right - pixels / 2,
    bottom - 9,
  );
}
