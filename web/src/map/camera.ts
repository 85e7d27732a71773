import type { Point } from '../model/geometry';

/**
 * Where the map looks: the world point in the middle of the canvas, and how many CSS pixels a metre takes.
 * World x points right and y up; canvas x points right and y down. The camera never turns.
 */
export interface Camera {
  readonly centre: Point;
  readonly pixelsPerMetre: number;
}

export interface Size {
  readonly width: number;
  readonly height: number;
}

/** The least rectangle with sides along the world's axes. */
export interface Bounds {
  readonly low: Point;
  readonly high: Point;
}

const kLeastScale = 1e-4;
const kMostScale = 1e5;

const clampScale = (scale: number): number => Math.min(kMostScale, Math.max(kLeastScale, scale));

export function boundsOf(points: readonly Point[]): Bounds {
  const xs = points.map((p) => p[0]);
  const ys = points.map((p) => p[1]);
  return { low: [Math.min(...xs), Math.min(...ys)], high: [Math.max(...xs), Math.max(...ys)] };
}

/** Shows all of `bounds`, with `margin` CSS pixels around. */
export function fit(bounds: Bounds, size: Size, margin: number, rightMargin = margin): Camera {
  const wide = Math.max(bounds.high[0] - bounds.low[0], 1e-6);
  const tall = Math.max(bounds.high[1] - bounds.low[1], 1e-6);
  const scale = Math.min((size.width - margin - rightMargin) / wide, (size.height - 2 * margin) / tall);
  const pixelsPerMetre = clampScale(scale);
  const aside = (rightMargin - margin) / 2 / pixelsPerMetre;
  return {
    centre: [(bounds.low[0] + bounds.high[0]) / 2 + aside, (bounds.low[1] + bounds.high[1]) / 2],
    pixelsPerMetre,
  };
}

export function toScreen(camera: Camera, size: Size, p: Point): Point {
  return [
    size.width / 2 + (p[0] - camera.centre[0]) * camera.pixelsPerMetre,
    size.height / 2 - (p[1] - camera.centre[1]) * camera.pixelsPerMetre,
  ];
}

export function toWorld(camera: Camera, size: Size, s: Point): Point {
  return [
    camera.centre[0] + (s[0] - size.width / 2) / camera.pixelsPerMetre,
    camera.centre[1] - (s[1] - size.height / 2) / camera.pixelsPerMetre,
  ];
}

/** Moves what is seen by so many CSS pixels. */
export function panned(camera: Camera, dx: number, dy: number): Camera {
  const { centre, pixelsPerMetre } = camera;
  return { centre: [centre[0] - dx / pixelsPerMetre, centre[1] + dy / pixelsPerMetre], pixelsPerMetre };
}

/** Zooms by `factor`; what is under `at` (CSS pixels) stays there. */
export function zoomed(camera: Camera, size: Size, at: Point, factor: number): Camera {
  const fixed = toWorld(camera, size, at);
  const pixelsPerMetre = clampScale(camera.pixelsPerMetre * factor);
  const ratio = camera.pixelsPerMetre / pixelsPerMetre;
  return {
    centre: [fixed[0] + (camera.centre[0] - fixed[0]) * ratio, fixed[1] + (camera.centre[1] - fixed[1]) * ratio],
    pixelsPerMetre,
  };
}

/** A length of 1, 2 or 5 times a power of ten that takes at most `pixels` CSS pixels: for scale bar and grid. */
export function roundLength(camera: Camera, pixels: number): number {
  const most = pixels / camera.pixelsPerMetre;
  const power = 10 ** Math.floor(Math.log10(most));
  const step = [5, 2, 1].find((factor) => factor * power <= most) ?? 1;
  return step * power;
}
