import { describe, expect, it } from 'vitest';
import { age, clock, coordinateDecimals, duration, metres, parseNumber, percent, sentence } from './units';

describe('units', () => {
  it('Lengths have three digits or so', () => {
    expect([0.413, 41.26, 413.4, 12_345].map(metres)).toEqual(['0.41 m', '41.3 m', '413 m', '12.3 km']);
  });

  it('What is not known is a dash', () => {
    expect([metres(NaN), duration(null), percent(undefined), age(Infinity)]).toEqual(['–', '–', '–', '–']);
  });

  it('Durations read like a clock from a minute on', () => {
    expect([0.44, 12.9, 65, 3725, -3].map(duration)).toEqual(['0.4 s', '12 s', '1:05', '1:02:05', '-3.0 s']);
    expect(clock(59.99)).toBe('0:59');
  });

  it('Ages below a second are in milliseconds', () => {
    expect([0.04, 1.25].map(age)).toEqual(['40 ms', '1.3 s']);
  });

  it('Small fields need more decimals than large ones', () => {
    expect([3, 400, 20_000].map(coordinateDecimals)).toEqual([3, 1, 0]);
  });

  it('Typed numbers may have a comma; anything else is refused', () => {
    expect(['1,5', ' -.5 ', '1e3'].map(parseNumber)).toEqual([1.5, -0.5, 1000]);
    expect(['', '1 m', '0x10', 'Infinity', '1e999', '--1'].map(parseNumber)).toEqual([
      null,
      null,
      null,
      null,
      null,
      null,
    ]);
  });

  it('A clause becomes a sentence, and a sentence stays one', () => {
    expect(['no token', 'It ended.', 'why?', ''].map(sentence)).toEqual(['No token.', 'It ended.', 'Why?', '']);
  });
});
