/** Frames as protocol/README.md lays them out, for tests that play the program. */

export interface DroneState {
  x: number;
  y: number;
  vx: number;
  vy: number;
  activity: number;
  mode: number;
  battery: number;
}

const kVelocityScale = 0.001;

class Writer {
  private readonly parts: Buffer[] = [];

  constructor(header: Buffer) {
    this.parts.push(header);
  }

  put(array: Float32Array | Int16Array | Uint16Array | Uint8Array | Uint32Array): this {
    const bytes = Buffer.from(array.buffer, array.byteOffset, array.byteLength);
    const gap = (4 - (bytes.length % 4)) % 4;
    this.parts.push(bytes, Buffer.alloc(gap));
    return this;
  }

  bytes = (): Buffer => Buffer.concat(this.parts);
}

function headerOf(kind: number, flags: number, length: number, n: number): Buffer {
  const header = Buffer.alloc(length);
  header.write('VGL1', 0, 'latin1');
  header.writeUInt8(kind, 4);
  header.writeUInt8(flags, 5);
  header.writeUInt16LE(length, 6);
  header.writeUInt32LE(1, 8);
  header.writeUInt32LE(n, 12);
  return header;
}

export interface SnapshotFigures {
  readonly tick: number;
  readonly timeS: number;
  readonly metricPercent: number;
  readonly worstAgeS: number;
  readonly leastPairM: number;
}

export type Holding = readonly [drone: number, kind: number, index: number, distanceM: number];

export function snapshotBytes(
  drones: readonly DroneState[],
  figures: SnapshotFigures,
  holding: readonly Holding[] = [],
): Buffer {
  const n = drones.length;
  const header = headerOf(1, 4, 104, n);
  header.writeDoubleLE(figures.tick, 16);
  header.writeDoubleLE(figures.timeS, 24);
  header.writeDoubleLE(Date.now(), 32);
  header.writeFloatLE(0.01, 40);
  header.writeFloatLE(1, 44);
  header.writeFloatLE(0.01, 48);
  header.writeFloatLE(figures.metricPercent, 52);
  header.writeFloatLE(figures.leastPairM, 56);
  header.writeFloatLE(figures.worstAgeS, 60);
  header.writeFloatLE(60, 64);
  header.writeFloatLE(200, 68);
  header.writeUInt32LE(drones.filter((drone) => drone.activity === 0).length, 72);
  header.writeUInt32LE(1, 76);
  header.writeFloatLE(kVelocityScale, 84);
  header.writeUInt32LE(holding.length, 88);
  header.writeDoubleLE(performance.now(), 96);
  const velocity = Int16Array.from(drones.flatMap((drone) => [drone.vx / kVelocityScale, drone.vy / kVelocityScale]));
  const rows = new DataView(new ArrayBuffer(16 * holding.length));
  holding.forEach(([drone, kind, index, distance], i) => {
    rows.setUint32(16 * i, drone, true);
    rows.setUint32(16 * i + 4, kind, true);
    rows.setUint32(16 * i + 8, index, true);
    rows.setFloat32(16 * i + 12, distance, true);
  });
  return new Writer(header)
    .put(Float32Array.from(drones.flatMap((drone) => [drone.x, drone.y])))
    .put(Float32Array.from(drones, () => 1))
    .put(Float32Array.from(drones, () => 0.8))
    .put(velocity)
    .put(velocity)
    .put(velocity)
    .put(Uint16Array.from(drones, () => 12))
    .put(Uint16Array.from(drones, () => 20))
    .put(Uint8Array.from(drones, (drone) => 200 * drone.battery))
    .put(Uint8Array.from(drones, (drone) => drone.mode))
    .put(Uint8Array.from(drones, (drone) => drone.activity))
    .put(Uint8Array.from(drones, () => 3))
    .put(Uint8Array.from(drones, () => 8))
    .put(new Uint8Array(rows.buffer))
    .bytes();
}

export function densityBytes(
  size: readonly [number, number],
  width: number,
  height: number,
  value: (x: number, y: number) => number,
): Buffer {
  const header = headerOf(2, 0, 48, width * height);
  header.writeUInt32LE(width, 16);
  header.writeUInt32LE(height, 20);
  header.writeFloatLE(size[0], 24);
  header.writeFloatLE(size[1], 28);
  header.writeFloatLE(0.4, 32);
  header.writeUInt32LE(1, 36);
  const cells = Uint16Array.from({ length: width * height }, (_, i) =>
    Math.round(65535 * value(((i % width) + 0.5) / width, (Math.floor(i / width) + 0.5) / height)),
  );
  return new Writer(header).put(cells).bytes();
}
