import { describe, expect, it } from 'vitest';
import { LabelRoom } from './label_room';

describe('room for labels', () => {
  it('A label that would cover one that stands there is left out, one beside it is not', () => {
    const room = new LabelRoom();
    expect(room.take([0, 0, 40, 12])).toBe(true);
    expect(room.take([39, 11, 80, 24])).toBe(false);
    expect(room.take([40, 0, 80, 12])).toBe(true);
    expect(room.take([0, 12, 40, 24])).toBe(true);
  });

  it('One that was left out takes no room', () => {
    const room = new LabelRoom();
    room.take([0, 0, 10, 10]);
    room.take([5, 5, 20, 20]);
    expect(room.take([11, 11, 20, 20])).toBe(true);
  });
});
