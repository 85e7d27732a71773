import { describe, expect, it } from 'vitest';
import { steadyRows } from './steady_rows';

describe('rows under a hand', () => {
  it('Rows that would go or move stay in their places', () => {
    expect(steadyRows([4, 7, 9], [7, 9])).toEqual([4, 7, 9]);
    expect(steadyRows([4, 7, 9], [9, 4])).toEqual([4, 7, 9]);
  });

  it('Rows that came are at the end, each once', () => {
    const rows = steadyRows([4, 7], [1, 4, 7, 8]);
    expect(rows).toEqual([4, 7, 1, 8]);
    expect(steadyRows(rows, [1, 8])).toBe(rows);
  });
});
