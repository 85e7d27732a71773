import { describe, expect, it } from 'vitest';
import {
  area,
  centroid,
  contains,
  crossesItself,
  distanceToSegment,
  fillWithPoints,
  scaled,
  simplify,
  spreadOf,
  type Point,
} from './geometry';

const square: Point[] = [
  [0, 0],
  [2, 0],
  [2, 2],
  [0, 2],
];

describe('geometry', () => {
  it('A square has the area of its side squared, in either direction', () => {
    expect(area(square)).toBe(4);
    expect(area([...square].reverse())).toBe(4);
  });

  it('A point is inside or outside of an outline', () => {
    expect(contains(square, [1, 1])).toBe(true);
    expect(contains(square, [3, 1])).toBe(false);
    expect(contains(square, [1, -0.01])).toBe(false);
  });

  it('A bow tie crosses itself, a square and a triangle do not', () => {
    expect(crossesItself([square[0]!, square[2]!, square[1]!, square[3]!])).toBe(true);
    expect(crossesItself(square)).toBe(false);
    expect(crossesItself(square.slice(0, 3))).toBe(false);
  });

  it('A simplified line stays within the tolerance of every point that was drawn', () => {
    const drawn = Array.from({ length: 200 }, (_, i): Point => [i / 50, Math.sin(i / 20)]);
    const kept = simplify(drawn, 0.05);
    expect(kept.length).toBeLessThan(30);
    for (const p of drawn) {
      const nearest = Math.min(...kept.slice(1).map((b, i) => distanceToSegment(p, kept[i]!, b)));
      expect(nearest).toBeLessThanOrEqual(0.05);
    }
  });

  it('Filling an outline gives points inside, and never more than the limit', () => {
    const points = fillWithPoints(square, 0.1, 150);
    expect(points).toHaveLength(150);
    expect(points.every((p) => contains(square, p))).toBe(true);
  });

  it('The spread of one point is the least spread; of points on a line it follows the line', () => {
    expect(spreadOf([[1, 2]], 0.3)).toEqual({ centre: [1, 2], half: [0.3, 0.3], angle: 0 });
    const diagonal: Point[] = [
      [0, 0],
      [1, 1],
      [2, 2],
    ];
    const spread = spreadOf(diagonal, 0.1);
    expect(spread.angle).toBeCloseTo(Math.PI / 4);
    expect(spread.half[0]).toBeCloseTo(Math.sqrt(2 + 0.01));
    expect(spread.half[1]).toBeCloseTo(0.1);
  });

  it('Scaling keeps the centre and doubles the distances', () => {
    const doubled = scaled(square, 2);
    expect(centroid(doubled)).toEqual([1, 1]);
    expect(doubled[0]).toEqual([-1, -1]);
  });
});
