import {
  floats,
  kFrameFragment,
  kFrameUniforms,
  kFrameVertex,
  makeProgram,
  makeQuad,
  setFrame,
  uniformsOf,
} from './gl';
import type { Frame, Gl, Rgb } from './gl';
import { curveAt } from '../model/curve';

const kVertex = `
layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 from;   // x, y, metres along the line, seconds
layout(location = 2) in vec4 to;
uniform float u_width, u_now, u_memory;
uniform int u_columns;
out vec2 v_at;                        // pixels along, -1..1 across
flat out int v_class;
out float v_fresh;
${kFrameVertex}
void main() {
  vec2 a = pixels_of(from.xy), b = pixels_of(to.xy);
  vec2 along = b - a;
  float length_px = length(along);
  vec2 unit = length_px > 0.0 ? along / length_px : vec2(1.0, 0.0);
  vec2 across = vec2(-unit.y, unit.x);
  float reach = 0.5 * u_width;
  vec2 p = mix(a, b, corner.x * 0.5 + 0.5) + unit * corner.x * reach * 0.6 + across * corner.y * reach;
  v_at = vec2(mix(from.z, to.z, corner.x * 0.5 + 0.5) * u_scale, corner.y);
  v_class = (gl_InstanceID % u_columns) % 3;
  v_fresh = clamp(1.0 - (u_now - to.w) / u_memory, 0.0, 1.0);
  // What is not known is NaN, and what would join the newest row to the oldest goes back in time: neither is drawn.
  bool is_drawn = from.x == from.x && to.x == to.x && to.w > from.w && v_fresh > 0.0;
  gl_Position = is_drawn ? clip_of(p) : vec4(2.0, 2.0, 2.0, 1.0);
}`;

const kFragment = `
in vec2 v_at;
flat in int v_class;
in float v_fresh;
out vec4 colour;
uniform vec3 u_colours[3];
uniform float u_alpha;
uniform int u_isCasing;
${kFrameFragment}
void main() {
  float edge = 1.0 - smoothstep(0.55, 1.0, abs(v_at.y));
  float pattern = 1.0;
  if (u_isCasing == 0) {
    if (v_class == 1) pattern = step(fract(v_at.x / 14.0), 0.68);
    if (v_class == 2) pattern = step(fract(v_at.x / 6.0), 0.52);
  }
  colour = painted(u_colours[v_class], u_alpha * edge * pattern * mix(0.12, 1.0, v_fresh));
  if (colour.a < 0.004) discard;
}`;

const kNames = [
  ...kFrameUniforms,
  ...(['u_width', 'u_now', 'u_memory', 'u_columns', 'u_colours', 'u_alpha', 'u_isCasing'] as const),
];

/** How many segments a picture may have: with many drones each gets a shorter trail of longer pieces. */
const kMostSegments = 60_000;
const kMostRows = 400;
const kFloats = 4;
/** Rows between two moments, where the clock runs so fast that there is more than one. */
const kMostBetween = 32;

/** Where all drones are at a moment, relative to the map's origin, and how fast: x and y by turns. */
export interface Moment {
  readonly positions: Float32Array;
  readonly velocities: Float32Array;
}

export interface TrailStyle {
  readonly colours: readonly [Rgb, Rgb, Rgb];
  readonly casing: Rgb;
  readonly casingAlpha: number;
  /** CSS px. */
  readonly width: number;
  readonly alpha: number;
}

/**
 * The recent paths of all drones: a ring of rows on the GPU, one row per moment with one point per drone. A new moment
 * costs the upload of one row; the draw call pairs each row with the next one by reading the same buffer twice.
 */
export class TrailLayer {
  private readonly program: WebGLProgram;
  private readonly at;
  private readonly quad: WebGLBuffer;
  private readonly points: WebGLBuffer;
  private columns = 0;
  private rows = 0;
  private head = 0;
  private filled = 0;
  private latest = new Float32Array(0);
  private between = new Float32Array(0);
  private newest = -Infinity;
  private last: Moment | null = null;
  private spacing = 0.1;

  constructor(private readonly gl: Gl) {
    this.program = makeProgram(gl, 'trails', kVertex, kFragment);
    this.at = uniformsOf(gl, this.program, kNames);
    this.quad = makeQuad(gl);
    this.points = gl.createBuffer();
  }

  /** Forgets everything; `memoryS` is how long a trail stays where there are few drones. */
  reset(drones: number, memoryS: number): void {
    this.columns = drones;
    this.rows = Math.max(8, Math.min(kMostRows, Math.floor(kMostSegments / Math.max(1, drones))));
    this.spacing = memoryS / this.rows;
    this.head = 0;
    this.filled = 0;
    this.newest = -Infinity;
    this.last = null;
    this.latest = new Float32Array(kFloats * drones).fill(NaN);
    this.between = new Float32Array(2 * drones);
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.points);
    // One row more than the ring has: a copy of its first, so that the last row has a next one.
    gl.bufferData(gl.ARRAY_BUFFER, 4 * kFloats * (this.rows + 1) * drones, gl.DYNAMIC_DRAW);
  }

  get spacingS(): number {
    return this.spacing;
  }

  /**
   * Takes a moment, if it is time for another row. Where the clock runs so fast that it was time for several since the
   * last one, those between follow the curve that has the places and velocities of both.
   */
  extend(timeS: number, momentOf: () => Moment): void {
    if (this.columns === 0 || timeS < this.newest + this.spacing) {
      if (timeS < this.newest - 1) this.reset(this.columns, this.spacing * this.rows);
      return;
    }
    const moment = momentOf();
    const passedS = timeS - this.newest;
    const steps = this.last ? Math.min(kMostBetween, Math.floor(passedS / this.spacing)) : 1;
    for (let step = 1; step < steps; step++) {
      this.interpolate(this.last!, moment, passedS, step / steps);
      this.addRow(this.newest + (passedS * step) / steps, this.between);
    }
    this.addRow(timeS, moment.positions);
    this.newest = timeS;
    this.last = moment;
  }

  private interpolate(from: Moment, to: Moment, passedS: number, share: number): void {
    const at = curveAt(share);
    for (let i = 0; i < this.between.length; i++)
      this.between[i] =
        at.place0 * from.positions[i]! +
        at.place1 * to.positions[i]! +
        passedS * (at.velocity0 * from.velocities[i]! + at.velocity1 * to.velocities[i]!);
  }

  private addRow(timeS: number, positions: Float32Array): void {
    for (let i = 0; i < this.columns; i++) this.extendOne(i, timeS, positions);
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.points);
    gl.bufferSubData(gl.ARRAY_BUFFER, this.offset(this.head), this.latest);
    if (this.head === 0) gl.bufferSubData(gl.ARRAY_BUFFER, this.offset(this.rows), this.latest);
    this.head = (this.head + 1) % this.rows;
    this.filled = Math.min(this.filled + 1, this.rows);
  }

  private extendOne(i: number, timeS: number, positions: Float32Array): void {
    const { latest } = this;
    const [x, y] = [positions[2 * i]!, positions[2 * i + 1]!];
    const travelled = Math.hypot(x - latest[4 * i]!, y - latest[4 * i + 1]!);
    latest[4 * i + 2] = Number.isNaN(travelled) ? 0 : latest[4 * i + 2]! + travelled;
    latest[4 * i] = x;
    latest[4 * i + 1] = y;
    latest[4 * i + 3] = timeS;
  }

  private offset = (row: number): number => 4 * kFloats * this.columns * row;

  draw(frame: Frame, nowS: number, style: TrailStyle): void {
    if (this.columns === 0 || this.filled < 2) return;
    const { gl, at } = this;
    gl.useProgram(this.program);
    setFrame(gl, at, frame);
    gl.uniform1f(at.u_now, nowS);
    gl.uniform1f(at.u_memory, this.spacing * this.rows);
    gl.uniform1i(at.u_columns, this.columns);
    gl.uniform1f(at.u_width, style.width + 2.4);
    gl.uniform1f(at.u_alpha, style.casingAlpha);
    gl.uniform1i(at.u_isCasing, 1);
    gl.uniform3fv(at.u_colours, [...style.casing, ...style.casing, ...style.casing]);
    if (style.casingAlpha > 0) this.drawRows();
    gl.uniform1f(at.u_width, style.width);
    gl.uniform1f(at.u_alpha, style.alpha);
    gl.uniform1i(at.u_isCasing, 0);
    gl.uniform3fv(at.u_colours, style.colours.flat());
    this.drawRows();
  }

  private drawRows(): void {
    if (this.filled < this.rows) this.drawSpan(0, this.filled - 1);
    else {
      this.drawSpan(this.head, this.rows - this.head);
      this.drawSpan(0, Math.max(0, this.head - 1));
    }
  }

  /** `count` rows from `first`, each with the one after it. */
  private drawSpan(first: number, count: number): void {
    if (count <= 0) return;
    const { gl } = this;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quad);
    floats(gl, 0, 2, 0, 0, false);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.points);
    floats(gl, 1, 4, 0, this.offset(first), true);
    floats(gl, 2, 4, 0, this.offset(first + 1), true);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, count * this.columns);
  }
}
