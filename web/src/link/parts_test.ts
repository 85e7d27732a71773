import { describe, expect, it } from 'vitest';
import { FrameError, type Part } from './frames';
import { Parts } from './parts';

const part = (stream: number, offset: number, total: number, ...bytes: number[]): Part => ({
  kind: 'part',
  stream,
  offset,
  total,
  bytes: Uint8Array.from(bytes),
});
const listOf = (bytes: ArrayBuffer | null): number[] | null => bytes && [...new Uint8Array(bytes)];

describe('parts', () => {
  it('Streams may come by turns; each message is whole with its last part', () => {
    const parts = new Parts();
    expect(parts.take(part(1, 0, 3, 7, 8))).toBe(null);
    expect(parts.take(part(2, 0, 2, 1))).toBe(null);
    expect(listOf(parts.take(part(1, 2, 3, 9)))).toEqual([7, 8, 9]);
    expect(listOf(parts.take(part(2, 1, 2, 2)))).toEqual([1, 2]);
  });

  it('A message that begins anew forgets what came of the one before', () => {
    const parts = new Parts();
    parts.take(part(1, 0, 3, 7, 8));
    parts.take(part(1, 0, 2, 1));
    expect(listOf(parts.take(part(1, 1, 2, 2)))).toEqual([1, 2]);
  });

  it.each([
    ['of something that never began', part(2, 1, 3, 8)],
    ['with a gap before it', part(1, 2, 3, 9)],
    ['of another length', part(1, 1, 4, 8)],
    ['that goes beyond the end', part(1, 1, 3, 8, 9, 10)],
    ['of more than all memory', part(3, 0, 4_000_000_000, 1)],
  ])('A part %s is refused', (_, wrong) => {
    const parts = new Parts();
    parts.take(part(1, 0, 3, 7));
    expect(() => parts.take(wrong)).toThrow(FrameError);
  });
});
