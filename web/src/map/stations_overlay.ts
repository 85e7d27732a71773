import type { Point } from '../model/geometry';
import { at, isOnScreen, label, type Pen } from './pen';

/** A place where drones are charged: pads, one drone each. World frame. */
export interface Station {
  readonly name: string;
  readonly pads_m: readonly Point[];
}

const kHalfPx = 8;

/** Each pad as a square with a bolt; the station's name beside its first one. */
export function drawStations(pen: Pen, stations: readonly Station[], showsLabels: boolean): void {
  for (const { name, pads_m } of stations) {
    pads_m.forEach((pad, i) => {
      const [x, y] = at(pen, pad);
      if (!isOnScreen(pen.size, [x, y])) return;
      drawPad(pen, x, y);
      if (showsLabels && i === 0) label(pen, name, x, y - kHalfPx - 5, pen.palette.text, 'center');
    });
  }
}

function drawPad({ context, palette }: Pen, x: number, y: number): void {
  context.fillStyle = palette.halo;
  context.strokeStyle = palette.text;
  context.lineWidth = 1.5;
  context.beginPath();
  context.rect(x - kHalfPx, y - kHalfPx, 2 * kHalfPx, 2 * kHalfPx);
  context.fill();
  context.stroke();
  context.beginPath();
  context.moveTo(x + 2, y - 6);
  context.lineTo(x - 3, y + 1);
  context.lineTo(x + 3, y - 1);
  context.lineTo(x - 2, y + 6);
  context.stroke();
}
