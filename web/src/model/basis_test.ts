import { describe, expect, it } from 'vitest';
import { gridShape, reconstruct } from './basis';

/** (5), literally, at one point. */
function literal(c: number[], n: number, size: [number, number], q: [number, number]): number {
  let sum = 0;
  for (let k1 = 0; k1 < n; k1++)
    for (let k2 = 0; k2 < n; k2++) {
      const h = Math.sqrt(size[0] * size[1] * (k1 ? 0.5 : 1) * (k2 ? 0.5 : 1));
      const f = (Math.cos((k1 * Math.PI * q[0]) / size[0]) * Math.cos((k2 * Math.PI * q[1]) / size[1])) / h;
      sum += c[k1 + n * k2]! * f;
    }
  return sum;
}

describe('basis', () => {
  it('The fast sum is the literal sum over all k', () => {
    const n = 5;
    const size: [number, number] = [3, 2];
    const c = Array.from({ length: n * n }, (_, i) => Math.sin(i * 12.9898) * 2);
    const grid = reconstruct(c, size, 12, 8);
    for (let y = 0; y < 8; y++)
      for (let x = 0; x < 12; x++) {
        const q: [number, number] = [((x + 0.5) / 12) * 3, ((y + 0.5) / 8) * 2];
        expect(grid.values[y * 12 + x]).toBeCloseTo(literal(c, n, size, q), 5);
      }
  });

  it('A distribution with only its constant part is even and integrates to one', () => {
    const grid = reconstruct([1 / Math.sqrt(6), 0, 0, 0], [3, 2], 30, 20);
    const integral = grid.values.reduce((sum, value) => sum + value * 0.01, 0);
    expect(integral).toBeCloseTo(1, 5);
  });

  it('Grids keep the shape of the field', () => {
    expect(gridShape([400, 300], 128)).toEqual([128, 96]);
    expect(gridShape([1000, 1], 128)).toEqual([128, 8]);
  });
});
