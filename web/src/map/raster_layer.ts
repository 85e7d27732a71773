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

/** A scalar field on a grid of cells that spans the monitored rectangle. */
export interface RasterData {
  readonly width: number;
  readonly height: number;
  /** Row by row, the field's lowest row first; 0 to 1 of what `ramp` shows, NaN is not allowed. */
  readonly values: Float32Array;
}

/** The rectangle's corner and its two sides, relative to the map's origin, m. */
export interface Placement {
  readonly corner: readonly [number, number];
  readonly along1: readonly [number, number];
  readonly along2: readonly [number, number];
}

/** How values become colour: alpha rises from 0 to `mostAlpha` with value^gamma. */
export interface RasterStyle {
  readonly tint: Rgb;
  readonly contour: Rgb;
  readonly mostAlpha: number;
  readonly gamma: number;
  /** Contour lines from 0 to 1; 0: none. */
  readonly contours: number;
  readonly contourAlpha: number;
  /** Diagonal stripes instead of a solid tint: what is only proposed. */
  readonly striped: boolean;
}

const kVertex = `
layout(location = 0) in vec2 corner;
uniform vec2 u_corner, u_along1, u_along2;
out vec2 v_uv;
${kFrameVertex}
void main() {
  v_uv = corner * 0.5 + 0.5;
  gl_Position = clip_of(pixels_of(u_corner + v_uv.x * u_along1 + v_uv.y * u_along2));
}`;

// Four bilinear fetches make one bicubic B-spline sample: smooth contours from few cells.
const kFragment = `
in vec2 v_uv;
out vec4 colour;
uniform sampler2D u_values;
uniform vec2 u_cells;
uniform vec3 u_tint, u_contour;
uniform float u_mostAlpha, u_gamma, u_contours, u_contourAlpha, u_striped, u_pixelRatio;
${kFrameFragment}
float sampled(vec2 uv) {
  vec2 at = uv * u_cells - 0.5;
  vec2 f = fract(at);
  vec2 cell = at - f;
  vec2 w0 = (1.0 - f) * (1.0 - f) * (1.0 - f) / 6.0;
  vec2 w1 = (4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0;
  vec2 w3 = f * f * f / 6.0;
  vec2 w2 = 1.0 - w0 - w1 - w3;
  vec2 s0 = w0 + w1, s1 = w2 + w3;
  vec2 lower = (cell - 0.5 + w1 / s0) / u_cells;
  vec2 upper = (cell + 1.5 + w3 / s1) / u_cells;
  float a = texture(u_values, vec2(lower.x, lower.y)).r, b = texture(u_values, vec2(upper.x, lower.y)).r;
  float c = texture(u_values, vec2(lower.x, upper.y)).r, d = texture(u_values, vec2(upper.x, upper.y)).r;
  return mix(mix(a, b, s1.x), mix(c, d, s1.x), s1.y);
}
void main() {
  float value = clamp(sampled(v_uv), 0.0, 1.0);
  float alpha = u_mostAlpha * pow(value, u_gamma);
  vec3 tint = u_tint;
  if (u_striped > 0.5) {
    float stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / (9.0 * u_pixelRatio));
    alpha *= mix(0.25, 1.0, smoothstep(0.38, 0.5, abs(stripe - 0.5) + 0.12));
  }
  if (u_contours > 0.5) {
    float level = value * u_contours;
    float width = fwidth(level);
    float line = 1.0 - smoothstep(0.5, 1.5, abs(fract(level - 0.5) - 0.5) / max(width, 1e-5));
    line *= step(0.5, level) * (1.0 - smoothstep(0.35, 0.9, width));
    tint = mix(tint, u_contour, line * u_contourAlpha);
    alpha = max(alpha, line * u_contourAlpha);
  }
  colour = painted(tint, alpha);
}`;

const kNames = [
  ...kFrameUniforms,
  ...(['u_corner', 'u_along1', 'u_along2', 'u_values', 'u_cells', 'u_tint', 'u_contour', 'u_mostAlpha'] as const),
  ...(['u_gamma', 'u_contours', 'u_contourAlpha', 'u_striped', 'u_pixelRatio'] as const),
];

/** One scalar field, tinted, with contours. */
export class RasterLayer {
  private readonly program: WebGLProgram;
  private readonly at;
  private readonly quad: WebGLBuffer;
  private readonly texture: WebGLTexture;
  private shape: readonly [number, number] | null = null;

  constructor(private readonly gl: Gl) {
    this.program = makeProgram(gl, 'raster', kVertex, kFragment);
    this.at = uniformsOf(gl, this.program, kNames);
    this.quad = makeQuad(gl);
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
  }

  /** null takes the picture away. */
  set(data: RasterData | null): void {
    this.shape = data && [data.width, data.height];
    if (!data) return;
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
    // Half floats are smoothed by every WebGL2 device; 32-bit ones only by some.
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R16F, data.width, data.height, 0, gl.RED, gl.FLOAT, data.values);
  }

  draw(frame: Frame, placement: Placement, style: RasterStyle): void {
    if (!this.shape) return;
    const { gl, at } = this;
    gl.useProgram(this.program);
    setFrame(gl, at, frame);
    gl.uniform2fv(at.u_corner, placement.corner);
    gl.uniform2fv(at.u_along1, placement.along1);
    gl.uniform2fv(at.u_along2, placement.along2);
    gl.uniform2fv(at.u_cells, this.shape);
    gl.uniform3fv(at.u_tint, style.tint);
    gl.uniform3fv(at.u_contour, style.contour);
    gl.uniform1f(at.u_mostAlpha, style.mostAlpha);
    gl.uniform1f(at.u_gamma, style.gamma);
    gl.uniform1f(at.u_contours, style.contours);
    gl.uniform1f(at.u_contourAlpha, style.contourAlpha);
    gl.uniform1f(at.u_striped, style.striped ? 1 : 0);
    gl.uniform1f(at.u_pixelRatio, frame.devicePixelRatio);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.uniform1i(at.u_values, 0);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.quad);
    floats(gl, 0, 2, 0, 0, false);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
  }
}
