/**
 * Binary frames, as protocol/README.md lays them out. Every byte from the socket passes `decodeFrame` first: a frame that
 * is not as long as it says, or says what cannot be, is a FrameError with the reason, never a wrong picture.
 */

export class FrameError extends Error {}

/** More than this many drones, cells or rows is no frame of ours. */
const kMost = 16_000_000;
const kMagic = 0x56474c31; // VGL1
const kHeaderBytes = [0, 104, 48, 40, 40, 32, 32, 24] as const;

export interface Snapshot {
  readonly kind: 'snapshot';
  readonly epoch: number;
  readonly n: number;
  readonly isPaused: boolean;
  readonly isFallback: boolean;
  readonly hasMetric: boolean;
  readonly tick: number;
  readonly timeS: number;
  readonly wallMs: number;
  readonly ageS: number;
  readonly speed: number;
  readonly metric: number;
  readonly metricPercent: number;
  readonly leastPairM: number;
  readonly worstAgeS: number;
  readonly latenessP50Us: number;
  readonly latenessP99Us: number;
  readonly active: number;
  readonly revision: number;
  readonly idle: number;
  readonly velocityScale: number;
  readonly lostTicks: number;
  /** When it was true, by the program's steady clock. */
  readonly steadyMs: number;
  /** Field frame, x and y by turns. */
  readonly position: Float32Array;
  readonly height: Float32Array;
  readonly nearest: Float32Array;
  /** These three: times velocityScale, field frame. */
  readonly velocity: Int16Array;
  readonly nominal: Int16Array;
  readonly command: Int16Array;
  readonly age: Uint16Array;
  readonly linkAge: Uint16Array;
  readonly battery: Uint8Array;
  readonly mode: Uint8Array;
  readonly activity: Uint8Array;
  readonly action: Uint8Array;
  readonly flags: Uint8Array;
  readonly holding: readonly HoldingRow[];
}

/** What holds a drone back: `index` counts drones, walls (left, right, bottom, top) or no-fly edges. */
export interface HoldingRow {
  readonly drone: number;
  readonly kind: 'drone' | 'wall' | 'no_fly';
  readonly index: number;
  readonly distanceM: number;
}

export interface Density {
  readonly kind: 'density';
  readonly epoch: number;
  readonly isPreview: boolean;
  readonly isEmpty: boolean;
  readonly width: number;
  readonly height: number;
  readonly lengthX: number;
  readonly lengthY: number;
  readonly peak: number;
  readonly revision: number;
  readonly request: number;
  readonly cells: Uint16Array;
}

export interface Coverage {
  readonly kind: 'coverage';
  readonly epoch: number;
  readonly hasSamples: boolean;
  readonly timeS: number;
  readonly lengthX: number;
  readonly lengthY: number;
  /** c_k at k1 + m k2. */
  readonly coefficients: Float32Array;
}

export interface AgeMap {
  readonly kind: 'age';
  readonly epoch: number;
  readonly timeS: number;
  readonly lengthX: number;
  readonly lengthY: number;
  readonly width: number;
  readonly height: number;
  /** Tenths of a second; 65534: that or more; 65535: never. */
  readonly cells: Uint16Array;
}

export interface Trails {
  readonly kind: 'trails';
  readonly epoch: number;
  readonly n: number;
  readonly points: number;
  readonly spacingS: number;
  readonly timeS: number;
  /** Field frame; drone by drone, oldest first; NaN: not known. */
  readonly position: Float32Array;
}

/** What plots show, from the flight's beginning until now. */
export interface History {
  readonly kind: 'history';
  readonly epoch: number;
  readonly n: number;
  /** Drones that have columns of their own. */
  readonly plotted: number;
  readonly columns: number;
  readonly spacingS: number;
  readonly time: Float64Array;
  /** Column by column; NaN: there was none. */
  readonly values: Float32Array;
}

/** Some bytes of a message that comes in several, of which those of one stream follow each other. */
export interface Part {
  readonly kind: 'part';
  readonly stream: number;
  readonly offset: number;
  readonly total: number;
  readonly bytes: Uint8Array;
}

export type Frame = Snapshot | Density | Coverage | AgeMap | Trails | History;

/** Whether these bytes are a frame and no text. */
export const isFrame = (bytes: ArrayBuffer): boolean =>
  bytes.byteLength >= 4 && new DataView(bytes).getUint32(0, false) === kMagic;

/** The frame, or null for a kind that a later version added. Throws FrameError. */
export function decodeFrame(bytes: ArrayBuffer): Frame | Part | null {
  if (bytes.byteLength < 16) throw new FrameError(`a frame of ${bytes.byteLength} bytes has no header`);
  const view = new DataView(bytes);
  if (view.getUint32(0, false) !== kMagic) throw new FrameError('a frame that does not begin with VGL1');
  const kind = view.getUint8(4);
  const least = kHeaderBytes[kind];
  if (!least) return null;
  const reader = new ArrayReader(bytes, view, least);
  return kDecoders[kind]!(reader);
}

/** The header by offset, then the arrays one after the other, each at a multiple of 4 bytes. */
class ArrayReader {
  private at: number;
  readonly epoch: number;
  readonly n: number;
  readonly flags: number;

  constructor(
    private readonly bytes: ArrayBuffer,
    readonly view: DataView,
    least: number,
  ) {
    this.at = view.getUint16(6, true);
    if (this.at < least || this.at > bytes.byteLength || this.at % 4 !== 0)
      throw new FrameError(`a header of ${this.at} bytes in a frame of ${bytes.byteLength}; at least ${least}`);
    this.flags = view.getUint8(5);
    this.epoch = view.getUint32(8, true);
    this.n = view.getUint32(12, true);
    if (this.n > kMost) throw new FrameError(`${this.n} entries; at most ${kMost}`);
  }

  f32 = (offset: number): number => this.view.getFloat32(offset, true);
  f64 = (offset: number): number => this.view.getFloat64(offset, true);
  u32 = (offset: number): number => this.view.getUint32(offset, true);
  u8 = (offset: number): number => this.view.getUint8(offset);

  /** The same of 64 bits. */
  finite64(offset: number, name: string): number {
    const value = this.f64(offset);
    if (!Number.isFinite(value)) throw new FrameError(`${name} is ${value}`);
    return value;
  }

  /** A number that must be finite: what everything else is placed by. */
  finite(offset: number, name: string): number {
    const value = this.f32(offset);
    if (!Number.isFinite(value)) throw new FrameError(`${name} is ${value}`);
    return value;
  }

  take<T>(
    type: { new (buffer: ArrayBuffer, offset: number, length: number): T; BYTES_PER_ELEMENT: number },
    count: number,
  ): T {
    const start = this.at;
    const end = start + count * type.BYTES_PER_ELEMENT;
    if (end > this.bytes.byteLength) throw new FrameError(`the frame ends at ${this.bytes.byteLength} of ${end} bytes`);
    this.at = Math.ceil(end / 4) * 4;
    return new type(this.bytes, start, count);
  }

  expectCells(width: number, height: number): void {
    if (width * height !== this.n) throw new FrameError(`${width} x ${height} cells, but ${this.n} values`);
  }
}

const kDecoders: Record<number, (reader: ArrayReader) => Frame | Part> = {
  1: decodeSnapshot,
  2: decodeDensity,
  3: decodeCoverage,
  4: decodeAge,
  5: decodeTrails,
  6: decodeHistory,
  7: decodePart,
};

function decodeSnapshot(r: ArrayReader): Snapshot {
  const { n } = r;
  const rows = r.u32(88);
  if (rows > 2 * n) throw new FrameError(`${rows} holding rows of ${n} drones; at most two each`);
  return {
    kind: 'snapshot',
    epoch: r.epoch,
    n,
    isPaused: (r.flags & 1) !== 0,
    isFallback: (r.flags & 2) !== 0,
    hasMetric: (r.flags & 4) !== 0,
    tick: r.f64(16),
    timeS: r.f64(24),
    wallMs: r.f64(32),
    ageS: r.f32(40),
    speed: r.f32(44),
    metric: r.f32(48),
    metricPercent: r.f32(52),
    leastPairM: r.f32(56),
    worstAgeS: r.f32(60),
    latenessP50Us: r.f32(64),
    latenessP99Us: r.f32(68),
    active: r.u32(72),
    revision: r.u32(76),
    idle: r.u8(80),
    velocityScale: r.finite(84, 'velocity_scale_m_s'),
    lostTicks: r.u32(92),
    steadyMs: r.finite64(96, 'steady_ms'),
    position: r.take(Float32Array, 2 * n),
    height: r.take(Float32Array, n),
    nearest: r.take(Float32Array, n),
    velocity: r.take(Int16Array, 2 * n),
    nominal: r.take(Int16Array, 2 * n),
    command: r.take(Int16Array, 2 * n),
    age: r.take(Uint16Array, n),
    linkAge: r.take(Uint16Array, n),
    battery: r.take(Uint8Array, n),
    mode: r.take(Uint8Array, n),
    activity: r.take(Uint8Array, n),
    action: r.take(Uint8Array, n),
    flags: r.take(Uint8Array, n),
    holding: holdingRows(r, rows),
  };
}

const kHolders = ['drone', 'wall', 'no_fly'] as const;

function holdingRows(r: ArrayReader, count: number): HoldingRow[] {
  const words = r.take(Uint32Array, 4 * count);
  const numbers = new Float32Array(words.buffer, words.byteOffset, words.length);
  const rows: HoldingRow[] = [];
  for (let i = 0; i < count; i++) {
    const kind = kHolders[words[4 * i + 1]!];
    const drone = words[4 * i]!;
    if (drone >= r.n) throw new FrameError(`a holding row of drone ${drone}; there are ${r.n}`);
    if (kind) rows.push({ drone, kind, index: words[4 * i + 2]!, distanceM: numbers[4 * i + 3]! });
  }
  return rows;
}

function decodeDensity(r: ArrayReader): Density {
  const isEmpty = (r.flags & 2) !== 0;
  const [width, height] = [r.u32(16), r.u32(20)];
  if (!isEmpty || r.n > 0) r.expectCells(width, height);
  return {
    kind: 'density',
    epoch: r.epoch,
    isPreview: (r.flags & 1) !== 0,
    isEmpty,
    width,
    height,
    lengthX: r.finite(24, 'length_x_m'),
    lengthY: r.finite(28, 'length_y_m'),
    peak: r.f32(32),
    revision: r.u32(36),
    request: r.f64(40),
    cells: r.take(Uint16Array, r.n),
  };
}

function decodeCoverage(r: ArrayReader): Coverage {
  const m = r.u32(32);
  r.expectCells(m, m);
  return {
    kind: 'coverage',
    epoch: r.epoch,
    hasSamples: (r.flags & 1) !== 0,
    timeS: r.f64(16),
    lengthX: r.finite(24, 'length_x_m'),
    lengthY: r.finite(28, 'length_y_m'),
    coefficients: r.take(Float32Array, r.n),
  };
}

function decodeAge(r: ArrayReader): AgeMap {
  const [width, height] = [r.u32(32), r.u32(36)];
  r.expectCells(width, height);
  return {
    kind: 'age',
    epoch: r.epoch,
    timeS: r.f64(16),
    lengthX: r.finite(24, 'length_x_m'),
    lengthY: r.finite(28, 'length_y_m'),
    width,
    height,
    cells: r.take(Uint16Array, r.n),
  };
}

function decodeTrails(r: ArrayReader): Trails {
  const points = r.u32(16);
  if (points * r.n > kMost) throw new FrameError(`${points} trail points of ${r.n} drones; at most ${kMost} in all`);
  return {
    kind: 'trails',
    epoch: r.epoch,
    n: r.n,
    points,
    spacingS: r.finite(20, 'spacing_s'),
    timeS: r.f64(24),
    position: r.take(Float32Array, 2 * r.n * points),
  };
}

function decodeHistory(r: ArrayReader): History {
  const [plotted, columns] = [r.u32(16), r.u32(20)];
  const wanted = 5 + plotted + (plotted * Math.max(0, plotted - 1)) / 2;
  if (columns !== wanted) throw new FrameError(`${columns} columns of ${plotted} drones; ${wanted} expected`);
  if (columns * r.n > kMost) throw new FrameError(`${columns} columns of ${r.n} rows; at most ${kMost} values`);
  const spacingS = r.f64(24);
  if (!(spacingS > 0 && spacingS < Infinity)) throw new FrameError(`spacing_s is ${spacingS}`);
  const time = r.take(Float64Array, r.n);
  if (!time.every(Number.isFinite)) throw new FrameError('a row without a time');
  return {
    kind: 'history',
    epoch: r.epoch,
    n: r.n,
    plotted,
    columns,
    spacingS,
    time,
    values: r.take(Float32Array, r.n * columns),
  };
}

function decodePart(r: ArrayReader): Part {
  return {
    kind: 'part',
    stream: r.flags,
    offset: r.u32(16),
    total: r.u32(20),
    bytes: r.take(Uint8Array, r.n),
  };
}
