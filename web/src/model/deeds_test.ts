import { describe, expect, it } from 'vitest';
import type { SwarmEvent } from '../link/messages';
import { deedOf } from './deeds';

const done = (what: string, drone: string, text: string): SwarmEvent => ({
  number: 1,
  tick: 0,
  time_s: 0,
  wall_ms: 0,
  severity: 'info',
  source: 'operator',
  what,
  drone,
  was: '',
  by: 'Ben',
  text,
  effect: '',
  next: '',
  epoch: 1,
});

describe('deedOf', () => {
  it('Whoever stops motors or lands all is named in an alarm', () => {
    expect(deedOf(done('emergency_stop', 'all', 'Ben: emergency_stop all'))).toEqual({
      kind: 'alarm',
      text: 'EMERGENCY STOP by Ben: motors off, all drones.',
    });
    expect(deedOf(done('emergency_stop', 'd1, d2', '')).text).toBe('EMERGENCY STOP by Ben: motors off, d1, d2.');
    expect(deedOf(done('land_all', '', '')).text).toBe('LAND ALL by Ben: every drone comes down.');
  });

  it('Other deeds are said with the name, once', () => {
    expect(deedOf(done('hold', 'd1', 'Ben: hold d1'))).toEqual({ kind: 'info', text: 'Ben: hold d1' });
    expect(deedOf(done('edit', '', 'east: weight 2'))).toEqual({ kind: 'info', text: 'Ben: east: weight 2' });
  });
});
