/** The few things that every layer needs of WebGL2. Errors name the shader: they are bugs of ours, or of a driver. */

export type Gl = WebGL2RenderingContext;

export function makeProgram(gl: Gl, name: string, vertex: string, fragment: string): WebGLProgram {
  const program = gl.createProgram();
  for (const [type, source] of [
    [gl.VERTEX_SHADER, vertex],
    [gl.FRAGMENT_SHADER, fragment],
  ] as const)
    gl.attachShader(program, compile(gl, name, type, source));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost())
    throw new Error(`map layer ${name}: ${gl.getProgramInfoLog(program)}`);
  return program;
}

function compile(gl: Gl, name: string, type: number, source: string): WebGLShader {
  const shader = gl.createShader(type);
  if (!shader) throw new Error(`map layer ${name}: no shader to be had from this browser`);
  gl.shaderSource(shader, `#version 300 es\nprecision highp float;\n${source}`);
  gl.compileShader(shader);
  if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost())
    throw new Error(`map layer ${name}: ${gl.getShaderInfoLog(shader)}`);
  return shader;
}

export type Uniforms<Name extends string> = Record<Name, WebGLUniformLocation | null>;

export function uniformsOf<Name extends string>(gl: Gl, program: WebGLProgram, names: readonly Name[]): Uniforms<Name> {
  return Object.fromEntries(names.map((name) => [name, gl.getUniformLocation(program, name)])) as Uniforms<Name>;
}

/** Two triangles over [-1, 1] x [-1, 1], as attribute 0. */
export function makeQuad(gl: Gl): WebGLBuffer {
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), gl.STATIC_DRAW);
  return buffer;
}

/** An attribute of floats; `perInstance` advances once an instance. Binds nothing but the attribute. */
export function floats(gl: Gl, at: number, size: number, stride: number, offset: number, perInstance: boolean): void {
  gl.enableVertexAttribArray(at);
  gl.vertexAttribPointer(at, size, gl.FLOAT, false, stride, offset);
  gl.vertexAttribDivisor(at, perInstance ? 1 : 0);
}

/**
 * World to clip space, relative to `origin`: positions go to the GPU as 32-bit floats relative to the field's centre, so
 * that a field far from the world's origin (UTM coordinates) does not jitter.
 */
export interface Frame {
  /** CSS pixels a metre, canvas size in CSS pixels, the camera's centre relative to the origin. */
  readonly pixelsPerMetre: number;
  readonly width: number;
  readonly height: number;
  readonly centre: readonly [number, number];
  readonly devicePixelRatio: number;
  /** 0: as it is; 1: drained of colour, because the data is old. */
  readonly drained: number;
}

export const kFrameUniforms = ['u_scale', 'u_centre', 'u_canvas', 'u_drained'] as const;

export function setFrame(gl: Gl, at: Uniforms<(typeof kFrameUniforms)[number]>, frame: Frame): void {
  gl.uniform1f(at.u_scale, frame.pixelsPerMetre);
  gl.uniform2f(at.u_centre, frame.centre[0], frame.centre[1]);
  gl.uniform2f(at.u_canvas, frame.width, frame.height);
  gl.uniform1f(at.u_drained, frame.drained);
}

/** GLSL shared by vertex shaders: pixels from the canvas' middle (y up), and those to clip space. */
export const kFrameVertex = `
uniform float u_scale;
uniform vec2 u_centre;
uniform vec2 u_canvas;
vec2 pixels_of(vec2 world) { return (world - u_centre) * u_scale; }
vec4 clip_of(vec2 pixels) { return vec4(2.0 * pixels / u_canvas, 0.0, 1.0); }
`;

/** GLSL shared by fragment shaders: premultiplied colour, drained where the data is old. */
export const kFrameFragment = `
uniform float u_drained;
vec4 painted(vec3 colour, float alpha) {
  vec3 grey = vec3(dot(colour, vec3(0.299, 0.587, 0.114)));
  return vec4(mix(colour, grey, u_drained) * alpha, alpha);
}
`;

export type Rgb = readonly [number, number, number];

/** #rrggbb as three numbers from 0 to 1. */
export function rgb(hex: string): Rgb {
  const value = Number.parseInt(hex.trim().slice(1), 16);
  return [((value >> 16) & 255) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}
