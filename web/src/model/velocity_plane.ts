import type { Why, WhyRow } from '../link/messages';
import type { Point } from './geometry';

/**
 * The plane of velocities as a picture: the disk of what the drone can fly, and of every row the part of the disk that it
 * forbids. The picture's y points down, the world's up.
 */

/** The picture reaches so far beyond the disk, in units of u_max. */
const kMargin = 1.18;

export interface Plane {
  /** Half the picture's width, m/s. */
  readonly extent: number;
  readonly radius: number;
}

/** Room for the disk, and for what was wanted where that is faster, up to twice the disk. */
export function planeOf(why: Why): Plane {
  const radius = Math.max(why.u_max_m_s, 1e-6);
  const wanted = Math.hypot(...why.u_nom_m_s);
  const reach = Number.isFinite(wanted) ? Math.min(Math.max(wanted, radius), 2 * radius) : radius;
  return { extent: kMargin * reach, radius };
}

/** Where a velocity lies in a picture from -100 to 100. */
export const placeOf = (v: Point, { extent }: Plane): Point => [(100 * v[0]) / extent, (-100 * v[1]) / extent];

/** The part of the disk where normal . u < offset, as an SVG path; empty where the row forbids nothing of the disk. */
export function forbiddenPath(row: WhyRow, plane: Plane): string {
  const { radius } = plane;
  const r = (100 * radius) / plane.extent;
  if (row.offset_m_s <= -radius) return '';
  if (row.offset_m_s >= radius) return `M${-r} 0A${r} ${r} 0 1 1 ${r} 0A${r} ${r} 0 1 1 ${-r} 0Z`;
  const [from, to] = chordOf(row, plane)!;
  const isLarge = row.offset_m_s > 0 ? 1 : 0;
  return `M${text(from)}A${r.toFixed(2)} ${r.toFixed(2)} 0 ${isLarge} 1 ${text(to)}Z`;
}

/** Where the row's edge crosses the disk; null where it does not. */
export function chordOf(row: WhyRow, plane: Plane): [Point, Point] | null {
  const { normal, offset_m_s: offset } = row;
  const half = Math.sqrt(Math.max(0, plane.radius ** 2 - offset ** 2));
  if (Math.abs(offset) >= plane.radius) return null;
  const end = (side: number): Point =>
    placeOf([offset * normal[0] - side * half * normal[1], offset * normal[1] + side * half * normal[0]], plane);
  return [end(-1), end(1)];
}

const text = (p: Point): string => `${p[0].toFixed(2)} ${p[1].toFixed(2)}`;
