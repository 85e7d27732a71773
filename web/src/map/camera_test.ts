import { describe, expect, it } from 'vitest';
import { boundsOf, fit, panned, roundLength, toScreen, toWorld, zoomed } from './camera';

const size = { width: 800, height: 600 };
const camera = fit(boundsOf([[-1.5, -1.5], [1.5, 1.5]]), size, 30); // prettier-ignore

describe('camera', () => {
  it('Fitting shows the whole field in the middle', () => {
    expect(camera.pixelsPerMetre).toBeCloseTo(180);
    expect(toScreen(camera, size, [0, 0])).toEqual([400, 300]);
    expect(toScreen(camera, size, [0, 1.5])[1]).toBeCloseTo(30);
  });

  it('Screen and world are inverse to each other', () => {
    const [x, y] = toWorld(camera, size, toScreen(camera, size, [0.3, -1.1]));
    expect(x).toBeCloseTo(0.3);
    expect(y).toBeCloseTo(-1.1);
  });

  it('What is under the pointer stays there while zooming', () => {
    const under = toWorld(camera, size, [123, 456]);
    const after = toScreen(zoomed(camera, size, [123, 456], 1.7), size, under);
    expect(after[0]).toBeCloseTo(123);
    expect(after[1]).toBeCloseTo(456);
  });

  it('Panning moves what is seen with the hand', () => {
    const before = toScreen(camera, size, [1, 1]);
    const after = toScreen(panned(camera, 10, -5), size, [1, 1]);
    expect(after[0] - before[0]).toBeCloseTo(10);
    expect(after[1] - before[1]).toBeCloseTo(-5);
  });

  it('With another margin on its right the field is as far from either side as its margins say', () => {
    const wide = fit(boundsOf([[0, 0], [8, 1]]), size, 30, 70); // prettier-ignore
    expect(toScreen(wide, size, [0, 0])[0]).toBeCloseTo(30);
    expect(toScreen(wide, size, [8, 0])[0]).toBeCloseTo(730);
    expect(toScreen(wide, size, [0, 0.5])[1]).toBeCloseTo(300);
  });

  it('Lengths of the scale bar are 1, 2 or 5 times a power of ten and fit', () => {
    for (const pixelsPerMetre of [0.003, 0.7, 12, 180, 4000]) {
      const length = roundLength({ centre: [0, 0], pixelsPerMetre }, 100);
      expect(length * pixelsPerMetre).toBeLessThanOrEqual(100 + 1e-9);
      expect(length * pixelsPerMetre).toBeGreaterThan(39);
      const digit = length / 10 ** Math.floor(Math.log10(length) + 1e-9);
      expect([1, 2, 5].some((factor) => Math.abs(digit - factor) < 1e-9)).toBe(true);
    }
  });
});
