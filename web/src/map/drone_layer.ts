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

/**
 * How a drone is drawn; the shape says what the colour says. Active: a filled arrow head. Away (on the ground, held,
 * landing, recovering): hollow. Failed (lost, failed, stopped): a cross in a ring.
 */
export const kGlyph = { active: 0, away: 1, failed: 2 } as const;
export type Glyph = (typeof kGlyph)[keyof typeof kGlyph];

const kVertex = `
layout(location = 0) in vec2 corner;
layout(location = 1) in vec4 drone;   // x, y, heading, glyph + 8 where selected
uniform float u_size;
uniform float u_radius;               // metres; 0: none
out vec2 v_at;
flat out int v_glyph;
flat out float v_selected;
flat out float v_radius_px;
out vec2 v_px;
${kFrameVertex}
void main() {
  float code = drone.w;
  v_selected = step(7.5, code);
  v_glyph = int(code - 8.0 * v_selected + 0.5);
  v_radius_px = u_radius * u_scale;
  // Small glyphs have no outline, and no pixel is painted in vain.
  float extent = v_selected > 0.5 ? 2.1 : u_size > 5.0 ? 1.6 : 1.2;
  float reach = max(u_size * extent, v_radius_px + 2.0);
  v_px = corner * reach;
  float c = cos(drone.z), s = sin(drone.z);
  // The glyph turns with the heading; distances stay as they are.
  v_at = mat2(c, -s, s, c) * v_px / u_size;
  gl_Position = drone.x == drone.x ? clip_of(pixels_of(drone.xy) + v_px) : vec4(2.0, 2.0, 2.0, 1.0);
}`;

const kFragment = `
in vec2 v_at;
in vec2 v_px;
flat in int v_glyph;
flat in float v_selected;
flat in float v_radius_px;
out vec4 colour;
uniform vec3 u_colours[3];
uniform vec3 u_outline, u_ring;
uniform float u_size, u_ringAlpha;
${kFrameFragment}
// Signed distance to an arrow head with a notch, tip at (1, 0), back corners at (-0.8, 0.75), in units of the glyph's size.
float arrow(vec2 p) {
  p.y = abs(p.y);
  float side = dot(p - vec2(1.0, 0.0), vec2(0.3846, 0.9231));
  float notch = dot(p - vec2(-0.35, 0.0), vec2(-0.8575, -0.5145));
  return max(side, notch);
}
float stroke(float d, float half_width, float soft) { return 1.0 - smoothstep(half_width - soft, half_width + soft, abs(d)); }
float filled(float d, float soft) { return 1.0 - smoothstep(-soft, soft, d); }
void over(inout vec4 under, vec4 top) { under = top + under * (1.0 - top.a); }
void main() {
  float soft = 0.8 / u_size;
  vec4 sum = vec4(0.0);
  if (v_radius_px > 3.0) {
    float r = length(v_px);
    float line = 1.0 - smoothstep(0.4, 1.3, abs(r - v_radius_px));
    over(sum, painted(u_ring, u_ringAlpha * max(line, 0.16 * step(r, v_radius_px))));
  }
  vec3 tint = u_colours[v_glyph];
  if (v_glyph == 2) {
    float r = length(v_at);
    float cross_ = min(abs(v_at.x + v_at.y), abs(v_at.x - v_at.y)) * 0.7071;
    float mark = max(stroke(r - 0.9, 0.16, soft), stroke(cross_, 0.16, soft) * step(r, 0.85));
    over(sum, painted(u_outline, filled(r - 1.15, soft) * 0.9));
    over(sum, painted(tint, mark));
  } else {
    float d = arrow(v_at);
    if (u_size > 5.0) over(sum, painted(u_outline, filled(d - 0.24, soft)));
    over(sum, painted(tint, v_glyph == 0 ? filled(d, soft) : stroke(d + 0.06, 0.13, soft)));
  }
  if (v_selected > 0.5) over(sum, painted(u_ring, stroke(length(v_at) - 1.75, 0.1, soft)));
  colour = sum;
  if (colour.a < 0.004) discard;
}`;

const kNames = [
  ...kFrameUniforms,
  ...(['u_size', 'u_radius', 'u_colours', 'u_outline', 'u_ring', 'u_ringAlpha'] as const),
];

export interface DroneStyle {
  readonly colours: readonly [Rgb, Rgb, Rgb];
  readonly outline: Rgb;
  readonly ring: Rgb;
  readonly ringAlpha: number;
  /** CSS px from the middle to the tip. */
  readonly size: number;
  /** Metres of the safety circle; 0: none. */
  readonly radius: number;
}

/** All drones in one draw call. `instances`: x, y (relative to the map's origin), heading (rad), glyph (+ 8: selected). */
export class DroneLayer {
  private readonly program: WebGLProgram;
  private readonly at;
  private readonly quad: WebGLBuffer;
  private readonly buffer: WebGLBuffer;
  private count = 0;

  constructor(private readonly gl: Gl) {
    this.program = makeProgram(gl, 'drones', kVertex, kFragment);
    this.at = uniformsOf(gl, this.program, kNames);
    this.quad = makeQuad(gl);
    this.buffer = gl.createBuffer();
  }

  set(instances: Float32Array): void {
    const { gl } = this;
    this.count = instances.length / 4;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, instances, gl.DYNAMIC_DRAW);
  }

  draw(frame: Frame, style: DroneStyle): void {
    if (this.count === 0) return;
    const { gl, at } = this;
    gl.useProgram(this.program);
    setFrame(gl, at, frame);
    gl.uniform1f(at.u_size, style.size);
    gl.uniform1f(at.u_radius, style.radius);
    gl.uniform3fv(at.u_colours, style.colours.flat());
    gl.uniform3fv(at.u_outline, style.outline);
    gl.uniform3fv(at.u_ring, style.ring);
    gl.uniform1f(at.u_ringAlpha, style.ringAlpha);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quad);
    floats(gl, 0, 2, 0, 0, false);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.buffer);
    floats(gl, 1, 4, 0, 0, true);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, this.count);
  }
}

/** Smaller drones where there are many on the screen: they are told apart by their places, then. */
export function glyphSize(drones: number, pixelsPerMetre: number, separation: number): number {
  const most = drones <= 30 ? 11 : drones <= 300 ? 8.5 : drones <= 2000 ? 6 : 4.5;
  return Math.max(2.6, Math.min(most, Math.max(separation * pixelsPerMetre * 0.45, drones <= 30 ? 9 : 2.6)));
}
