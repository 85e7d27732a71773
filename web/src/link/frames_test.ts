import { describe, expect, it } from 'vitest';
import { decodeFrame, FrameError, type Frame } from './frames';

const kVelocityScale = 0.01;

/** A header with the members that every frame has; n is 2 unless said otherwise. */
function header(kind: number, bytes: number, flags = 0, n = 2): DataView {
  const view = new DataView(new ArrayBuffer(bytes));
  view.setUint32(0, 0x56474c31, false);
  view.setUint8(4, kind);
  view.setUint8(5, flags);
  view.setUint16(6, bytes, true);
  view.setUint32(8, 7, true);
  view.setUint32(12, n, true);
  return view;
}

function joined(...parts: ArrayBufferView[]): ArrayBuffer {
  const padded = parts.map((part) => Math.ceil(part.byteLength / 4) * 4);
  const all = new Uint8Array(padded.reduce((a, b) => a + b, 0));
  let at = 0;
  parts.forEach((part, i) => {
    all.set(new Uint8Array(part.buffer, part.byteOffset, part.byteLength), at);
    at += padded[i]!;
  });
  return all.buffer;
}

/** Two drones; the first is held by the second. */
function snapshot(): ArrayBuffer {
  const view = header(1, 104, 4);
  view.setFloat64(16, 1151, true);
  view.setFloat64(24, 23.02, true);
  view.setFloat32(84, kVelocityScale, true);
  view.setUint32(88, 1, true);
  const velocities = Int16Array.of(30, 0, 0, -30);
  const holding = new DataView(new ArrayBuffer(16));
  holding.setUint32(8, 1, true);
  holding.setFloat32(12, 0.5, true);
  const bytes = (...values: number[]): Uint8Array => Uint8Array.from(values);
  return joined(
    view,
    Float32Array.of(0.5, 1.5, NaN, NaN),
    Float32Array.of(1, 0),
    Float32Array.of(0.25, NaN),
    ...[velocities, velocities, velocities],
    ...[Uint16Array.of(12, 65535), Uint16Array.of(20, 65534)],
    ...[bytes(190, 255), bytes(3, 0), bytes(0, 1), bytes(3, 0), bytes(8, 0)],
    holding,
  );
}

function coverage(): ArrayBuffer {
  const view = header(3, 40, 1, 4);
  view.setFloat32(24, 3, true);
  view.setFloat32(28, 2, true);
  view.setUint32(32, 2, true);
  return joined(view, Float32Array.of(1, 2, 3, 4));
}

function density(width: number, height: number): ArrayBuffer {
  const view = header(2, 48, 1, 6);
  view.setUint32(16, width, true);
  view.setUint32(20, height, true);
  view.setFloat32(24, 3, true);
  view.setFloat32(28, 2, true);
  return joined(view, Uint16Array.of(0, 1, 2, 3, 4, 65535));
}

describe('binary frames', () => {
  it('A snapshot gives every array at its place', () => {
    const frame = decodeFrame(snapshot()) as Extract<Frame, { kind: 'snapshot' }>;
    expect(frame).toMatchObject({ kind: 'snapshot', epoch: 7, n: 2, tick: 1151, hasMetric: true, isPaused: false });
    expect([...frame.position]).toEqual([0.5, 1.5, NaN, NaN]);
    expect([...frame.command]).toEqual([30, 0, 0, -30]);
    expect([...frame.linkAge]).toEqual([20, 65534]);
    expect([...frame.battery, ...frame.mode, ...frame.activity, ...frame.action, ...frame.flags]).toEqual([190, 255, 3, 0, 0, 1, 3, 0, 8, 0]); // prettier-ignore
    expect(frame.holding).toEqual([{ drone: 0, kind: 'drone', index: 1, distanceM: 0.5 }]);
  });

  it('Coefficients and cells come with their shape', () => {
    expect(decodeFrame(coverage())).toMatchObject({ kind: 'coverage', hasSamples: true, lengthX: 3, lengthY: 2 });
    expect(decodeFrame(density(3, 2))).toMatchObject({ kind: 'density', isPreview: true, width: 3, height: 2 });
  });

  it('What follows the arrays, and kinds of a later version, are passed over', () => {
    const longer = joined(new Uint8Array(coverage()), Uint8Array.of(1, 2, 3));
    expect(decodeFrame(longer)).toMatchObject({ kind: 'coverage' });
    expect(decodeFrame(header(99, 96).buffer as ArrayBuffer)).toBe(null);
  });

  it('A header that a later version made longer is skipped by its own length', () => {
    const view = header(3, 48, 1, 1);
    view.setUint32(32, 1, true);
    expect(decodeFrame(joined(view, Float32Array.of(5)))).toMatchObject({ coefficients: Float32Array.of(5) });
  });

  it('Every frame that was cut short is an error', () => {
    for (const frame of [snapshot(), coverage(), density(3, 2)])
      for (let length = 0; length < frame.byteLength - 3; length++)
        expect(() => decodeFrame(frame.slice(0, length)), `${length} bytes`).toThrow(FrameError);
  });

  it('Shapes and rows that cannot be are errors', () => {
    expect(() => decodeFrame(density(2, 2))).toThrow(/2 x 2 cells, but 6 values/);
    const otherMagic = coverage();
    new DataView(otherMagic).setUint8(0, 65);
    expect(() => decodeFrame(otherMagic)).toThrow(/VGL1/);
    const strangerHeld = snapshot();
    new DataView(strangerHeld).setUint32(strangerHeld.byteLength - 16, 2, true);
    expect(() => decodeFrame(strangerHeld)).toThrow(/holding row of drone 2/);
    const manyRows = snapshot();
    new DataView(manyRows).setUint32(88, 5, true);
    expect(() => decodeFrame(manyRows)).toThrow(/at most two each/);
  });

  it('Damaged bytes give a frame or an error of ours, nothing else', () => {
    let state = 20251122;
    const random = (most: number): number => {
      state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
      return Math.floor((state / 2 ** 32) * most);
    };
    const { stackTraceLimit } = Error;
    // Most of the time goes into stacks of errors, which nobody reads here.
    Error.stackTraceLimit = 0;
    const whole = [snapshot(), coverage(), density(3, 2)];
    const others: unknown[] = [];
    for (let round = 0; round < 5_000; round++) {
      const bytes = whole[round % 3]!.slice(0);
      for (let i = random(4); i >= 0; i--) new DataView(bytes).setUint8(random(bytes.byteLength), random(256));
      try {
        decodeFrame(bytes);
      } catch (error) {
        if (!(error instanceof FrameError)) others.push(error);
      }
    }
    Error.stackTraceLimit = stackTraceLimit;
    expect(others).toEqual([]);
  });
});
