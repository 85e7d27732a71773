/** Plane geometry in metres. Points are [x, y]; every function is pure. */

export type Point = readonly [number, number];

export const distance = (a: Point, b: Point): number => Math.hypot(a[0] - b[0], a[1] - b[1]);
export const add = (a: Point, b: Point): Point => [a[0] + b[0], a[1] + b[1]];
export const subtract = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1]];

/** The mean of the points; the origin for none. */
export function centroid(points: readonly Point[]): Point {
  if (points.length === 0) return [0, 0];
  let x = 0;
  let y = 0;
  for (const point of points) {
    x += point[0];
    y += point[1];
  }
  return [x / points.length, y / points.length];
}

/** Distance of `p` from the segment a-b. */
export function distanceToSegment(p: Point, a: Point, b: Point): number {
  return distance(p, nearestOnSegment(p, a, b));
}

export function nearestOnSegment(p: Point, a: Point, b: Point): Point {
  const along = subtract(b, a);
  const squared = along[0] * along[0] + along[1] * along[1];
  if (squared === 0) return a;
  const share = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / squared;
  const clamped = Math.min(1, Math.max(0, share));
  return [a[0] + clamped * along[0], a[1] + clamped * along[1]];
}

/** Whether `p` lies inside the closed outline (even-odd rule). */
export function contains(outline: readonly Point[], p: Point): boolean {
  let inside = false;
  for (const [a, b] of edges(outline)) {
    const crosses = a[1] > p[1] !== b[1] > p[1];
    if (crosses && p[0] < ((b[0] - a[0]) * (p[1] - a[1])) / (b[1] - a[1]) + a[0]) inside = !inside;
  }
  return inside;
}

/** The edges of a closed outline, the last back to the first. */
export function edges(outline: readonly Point[]): [Point, Point][] {
  return outline.map((point, i) => [point, outline[(i + 1) % outline.length]!]);
}

/** Twice the signed area is positive where the outline turns counter-clockwise; this is the unsigned area, m^2. */
export function area(outline: readonly Point[]): number {
  return Math.abs(edges(outline).reduce((sum, [a, b]) => sum + a[0] * b[1] - b[0] * a[1], 0)) / 2;
}

const turn = (a: Point, b: Point, c: Point): number =>
  Math.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));

function segmentsCross(a: Point, b: Point, c: Point, d: Point): boolean {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/** Whether two edges of the outline cross: such an outline has no inside that everybody agrees on. */
export function crossesItself(outline: readonly Point[]): boolean {
  const all = edges(outline);
  return all.some(([a, b], i) => all.slice(i + 2).some(([c, d]) => segmentsCross(a, b, c, d)));
}

/** A hand-drawn line with every point within `tolerance` of the result (Ramer, Douglas and Peucker). */
export function simplify(line: readonly Point[], tolerance: number): Point[] {
  if (line.length < 3) return [...line];
  const first = line[0]!;
  const last = line[line.length - 1]!;
  let farthest = 0;
  let split = 0;
  for (let i = 1; i < line.length - 1; i++) {
    const away = distanceToSegment(line[i]!, first, last);
    if (away > farthest) [farthest, split] = [away, i];
  }
  if (farthest <= tolerance) return [first, last];
  return [...simplify(line.slice(0, split + 1), tolerance).slice(0, -1), ...simplify(line.slice(split), tolerance)];
}

/** Points of a square grid of this spacing that lie inside the outline; at most `limit` of them. */
export function fillWithPoints(outline: readonly Point[], spacing: number, limit: number): Point[] {
  const xs = outline.map((p) => p[0]);
  const ys = outline.map((p) => p[1]);
  const found: Point[] = [];
  for (let y = Math.min(...ys) + spacing / 2; y < Math.max(...ys); y += spacing)
    for (let x = Math.min(...xs) + spacing / 2; x < Math.max(...xs); x += spacing) {
      if (found.length >= limit) return found;
      if (contains(outline, [x, y])) found.push([x, y]);
    }
  return found;
}

/** Half axes (m) and direction (rad) of the points' spread: the 1-sigma ellipse, never thinner than `least`. */
export interface Ellipse {
  centre: Point;
  half: readonly [number, number];
  angle: number;
}

export function spreadOf(points: readonly Point[], least: number): Ellipse {
  const centre = centroid(points);
  let [xx, xy, yy] = [0, 0, 0];
  for (const point of points) {
    const [dx, dy] = subtract(point, centre);
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  const n = Math.max(1, points.length - 1);
  const [a, b, c] = [xx / n + least * least, xy / n, yy / n + least * least];
  const mean = (a + c) / 2;
  const away = Math.hypot((a - c) / 2, b);
  return {
    centre,
    half: [Math.sqrt(mean + away), Math.sqrt(Math.max(mean - away, least * least))],
    angle: Math.atan2(2 * b, a - c) / 2,
  };
}

/** `points` moved away from their centre by this factor. */
export function scaled(points: readonly Point[], factor: number): Point[] {
  const centre = centroid(points);
  return points.map((p) => [centre[0] + (p[0] - centre[0]) * factor, centre[1] + (p[1] - centre[1]) * factor]);
}
