import { describe, expect, it } from 'vitest';
import { decodeMessage } from './messages';
import { ShapeError } from './shape';

const targets = {
  type: 'targets',
  epoch: 1,
  revision: 7,
  by: 'Ana',
  what: 'east: weight 2',
  can_undo: true,
  can_redo: false,
  undo_what: 'east: weight 2',
  redo_what: '',
  clusters: [{ name: 'east', points_m: [[0.5, 1]], weight: 2, revisit_s: null, protect: false }],
  areas: [],
  no_fly: [],
  uniform_floor: 0,
};

const decoded = (message: unknown) => decodeMessage(JSON.stringify(message));

describe('JSON messages', () => {
  it('A message comes back with its members, and those that are not known are left out', () => {
    expect(decoded({ ...targets, later: 1 })).toEqual(targets);
  });

  it('A type of a later version is passed over', () => {
    expect(decoded({ type: 'weather' })).toBe(null);
    expect(decoded({ type: 'toString' })).toBe(null);
  });

  it('What is wrong is refused with its place', () => {
    const wrong = { ...targets, clusters: [{ ...targets.clusters[0], points_m: [[0.5, '1']] }] };
    expect(() => decoded(wrong)).toThrow('targets.clusters[0].points_m[0][1]: a number expected, not "1"');
    expect(() => decoded({ ...targets, revision: undefined })).toThrow('targets.revision');
    expect(() => decoded({ ...targets, by: 'x'.repeat(300) })).toThrow('at most 256 characters');
    for (const text of ['', '[]', 'null', '7', '{"type":3}', '{'])
      expect(() => decodeMessage(text), text).toThrow(ShapeError);
  });

  it('An answer may leave out what it has nothing to say about', () => {
    expect(decoded({ type: 'ack', id: 7, tick: 3, pending: false })).toMatchObject({ id: 7, revision: null });
    expect(decoded({ type: 'refused', id: null, code: 'malformed', reason: 'no JSON' })).toMatchObject({ id: null });
  });
});
