import type { Point } from './geometry';

/** Where the monitored rectangle lies in the world: its corner, turned by yaw (rad), with sides L1 and L2 (m). */
export class FieldFrame {
  private readonly cos: number;
  private readonly sin: number;
  /** The rectangle's middle, world frame: what the map's 32-bit positions are relative to. */
  readonly centre: Point;

  constructor(
    readonly origin: Point,
    readonly yaw: number,
    readonly size: readonly [number, number],
  ) {
    this.cos = Math.cos(yaw);
    this.sin = Math.sin(yaw);
    this.centre = this.toWorld([size[0] / 2, size[1] / 2]);
  }

  toWorld(p: Point): Point {
    const [x, y] = this.turned(p);
    return [this.origin[0] + x, this.origin[1] + y];
  }

  toField(p: Point): Point {
    const [x, y] = [p[0] - this.origin[0], p[1] - this.origin[1]];
    return [this.cos * x + this.sin * y, -this.sin * x + this.cos * y];
  }

  /** A velocity or another difference, from field to world. */
  turned(v: Point): Point {
    return [this.cos * v[0] - this.sin * v[1], this.sin * v[0] + this.cos * v[1]];
  }

  /** The corners, world frame, counter-clockwise from the origin. */
  corners(): Point[] {
    const [x, y] = this.size;
    return ([[0, 0], [x, 0], [x, y], [0, y]] as const).map((p) => this.toWorld(p)); // prettier-ignore
  }

  contains(world: Point): boolean {
    const [x, y] = this.toField(world);
    return x >= 0 && y >= 0 && x <= this.size[0] && y <= this.size[1];
  }

  /** The nearest point of the field. */
  clamped(world: Point): Point {
    const [x, y] = this.toField(world);
    return this.toWorld([Math.min(this.size[0], Math.max(0, x)), Math.min(this.size[1], Math.max(0, y))]);
  }
}
