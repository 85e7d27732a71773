import type { Snapshot } from '../link/frames';
import { activityOf, vectorOf } from '../model/drones';
import type { FieldFrame } from '../model/field_frame';
import { kGlyph, type Glyph } from './drone_layer';

/** A snapshot is at most shown this far ahead of itself: what is older stands still. */
const kMostAheadS = 0.1;
/** Slower than this, m/s, a drone keeps the heading that it had. */
const kLeastSpeed = 0.005;

/** Where and how each drone is drawn now. Buffers are kept and filled anew. */
export class DronePlaces {
  /** World frame, x and y by turns. */
  places = new Float64Array(0);
  /** For the GPU: x, y relative to the field's centre, heading, glyph (+ 8: selected). */
  instances = new Float32Array(0);
  private headings = new Float32Array(0);

  update(snapshot: Snapshot, field: FieldFrame, aheadS: number, selected: ReadonlySet<number>): void {
    const { n } = snapshot;
    if (this.headings.length !== n) {
      this.headings = new Float32Array(n).fill(Math.PI / 2);
      this.places = new Float64Array(2 * n);
      this.instances = new Float32Array(4 * n);
    }
    const ahead = Math.min(kMostAheadS, Math.max(0, aheadS)) * (snapshot.isPaused ? 0 : snapshot.speed);
    for (let i = 0; i < n; i++) this.updateOne(snapshot, field, i, ahead, selected.has(i));
  }

  private updateOne(snapshot: Snapshot, field: FieldFrame, i: number, ahead: number, isSelected: boolean): void {
    const [vx, vy] = vectorOf(snapshot, i, 'velocity');
    const [x, y] = field.toWorld([snapshot.position[2 * i]! + vx * ahead, snapshot.position[2 * i + 1]! + vy * ahead]);
    if (Math.hypot(vx, vy) > kLeastSpeed) this.headings[i] = Math.atan2(vy, vx) + field.yaw;
    this.places[2 * i] = x;
    this.places[2 * i + 1] = y;
    this.instances[4 * i] = x - field.centre[0];
    this.instances[4 * i + 1] = y - field.centre[1];
    this.instances[4 * i + 2] = this.headings[i]!;
    this.instances[4 * i + 3] = glyphOf(snapshot, i) + (isSelected ? 8 : 0);
  }
}

export function glyphOf(snapshot: Snapshot, drone: number): Glyph {
  const { severity } = activityOf(snapshot, drone);
  return severity === 'ok' ? kGlyph.active : severity === 'alarm' ? kGlyph.failed : kGlyph.away;
}
