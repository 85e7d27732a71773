import { describe, expect, it } from 'vitest';
import { FieldFrame } from './field_frame';

const field = new FieldFrame([10, 20], Math.PI / 2, [4, 2]);

describe('field frame', () => {
  it('A quarter turn to the left takes the field’s x axis to the world’s y axis', () => {
    const [x, y] = field.toWorld([1, 0]);
    expect(x).toBeCloseTo(10);
    expect(y).toBeCloseTo(21);
  });

  it('World and field are inverse to each other', () => {
    const [x, y] = field.toField(field.toWorld([1.25, 0.5]));
    expect(x).toBeCloseTo(1.25);
    expect(y).toBeCloseTo(0.5);
  });

  it('What lies outside is clamped to the border', () => {
    expect(field.contains([9, 22])).toBe(true);
    expect(field.contains([11, 22])).toBe(false);
    expect(field.clamped([11, 22])[0]).toBeCloseTo(10);
  });
});
