import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { apply, type Edit, type Targets } from '../model/targets';
import { decodeFrame } from './frames';
import { decodeMessage } from './messages';

/** The vectors that the program writes: both sides must read them alike. */
const read = <T>(name: string): T[] =>
  JSON.parse(readFileSync(new URL(`../../../protocol/vectors/${name}.json`, import.meta.url), 'utf8')) as T[];

interface FrameVector {
  readonly name: string;
  readonly kind: string;
  readonly hex: string;
  readonly fields: Readonly<Record<string, unknown>>;
}

/** The vectors' names that are not simply ours in snake_case. */
const kNames: Record<string, string> = {
  paused: 'isPaused',
  fallback: 'isFallback',
  drones: 'n',
  age_ms: 'age',
  link_age_ms: 'linkAge',
  velocity_scale_m_s: 'velocityScale',
  length_x_m: 'lengthX',
  length_y_m: 'lengthY',
  values: 'cells',
  age_ds: 'cells',
  c_k: 'coefficients',
  xy: 'position',
  rows: 'n',
  times_s: 'time',
  series: 'values',
};

const ours = (name: string): string =>
  kNames[name] ?? name.replace(/_([a-z])/g, (_, letter: string) => letter.toUpperCase());

const kHolders = ['drone', 'wall', 'no_fly'];

/** A value of a vector as the decoder gives it: NaN is written as text, holding rows have words. */
function expected(name: string, value: unknown): unknown {
  if (name === 'holding')
    return (value as { drone: number; kind: number; index: number; distance_m: number }[]).map((row) => ({
      drone: row.drone,
      kind: kHolders[row.kind],
      index: row.index,
      distanceM: row.distance_m,
    }));
  if (Array.isArray(value)) return value.map((entry) => (entry === 'NaN' ? NaN : (entry as number)));
  return value === 'NaN' ? NaN : value;
}

describe('protocol vectors', () => {
  const frames = read<FrameVector>('frames');

  it('There is one of each kind of frame', () => {
    expect(new Set(frames.map((frame) => frame.kind))).toEqual(
      new Set(['snapshot', 'density', 'coverage', 'age', 'trails', 'history', 'part']),
    );
  });

  it.each(frames)('Frame: $name', ({ kind, hex, fields }) => {
    const bytes = Uint8Array.from(hex.match(/../g)!, (pair) => Number.parseInt(pair, 16));
    const frame = decodeFrame(bytes.buffer)! as unknown as Record<string, unknown>;
    expect(frame['kind']).toBe(kind);
    for (const [name, value] of Object.entries(fields)) {
      if (name === 'indices_per_axis') {
        expect((frame['coefficients'] as Float32Array).length).toBe((value as number) ** 2);
        continue;
      }
      const found = frame[ours(name)];
      expect(ArrayBuffer.isView(found) ? Array.from(found as Float32Array) : found, name).toEqual(
        expected(name, value),
      );
    }
  });

  it.each(read<{ name: string; message: unknown }>('server_messages'))(
    'Message of the program: $name',
    ({ message }) => {
      expect(decodeMessage(JSON.stringify(message))).toMatchObject({ type: (message as { type: string }).type });
    },
  );

  it('Every edit that the program takes is one that the console can stage', () => {
    const taken = read<{ name: string; text: string; is_accepted: boolean }>('client_messages').find(
      (v) => v.name === 'every edit',
    )!;
    const { edits } = JSON.parse(taken.text) as { edits: Edit[] };
    const operations = ['add', 'replace', 'remove', 'rename', 'add_point', 'move_point', 'remove_point', 'set_weight', 'set_revisit', 'set_protect', 'set_soft_edge', 'set_uniform_floor']; // prettier-ignore
    expect(new Set(edits.map((edit) => edit.op))).toEqual(new Set(operations));
    for (const edit of edits) expect(apply(targetsFor(edit), edit), JSON.stringify(edit)).not.toBe(null);
  });
});

/** Targets in which the entry that the edit speaks of is there, with enough points. */
function targetsFor(edit: Edit): Targets {
  const name = 'name' in edit ? edit.name : 'another';
  const points = Array.from({ length: 8 }, (_, i) => [i, i * i] as const);
  return {
    clusters: [{ name, points_m: points, weight: 1, revisit_s: null, protect: false }],
    areas: [{ name, outline_m: points, weight: 1, soft_edge_m: 0, revisit_s: null, protect: false }],
    no_fly: [{ name, outline_m: points }],
    uniform_floor: 0,
  };
}
