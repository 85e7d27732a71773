import { describe, expect, it } from 'vitest';
import type { Why, WhyRow } from '../link/messages';
import { reasonsInWords, rowName } from './why_words';

const row = (more: Partial<WhyRow>): WhyRow => ({
  kind: 'drone',
  drone: 'cf3',
  wall: null,
  edge: null,
  distance_m: 0.42,
  normal: [-1, 0],
  offset_m_s: -0.1,
  slack_m_s: 0,
  priority: 'separation',
  holds: true,
  ...more,
});

const why = (more: Partial<Why>): Why => ({
  type: 'why',
  id: 1,
  epoch: 1,
  tick: 9,
  time_s: 0.18,
  drone: 'cf1',
  activity: 'active',
  u_max_m_s: 0.3,
  u_nom_m_s: [0.3, 0],
  u_m_s: [0.1, 0],
  changed_m_s: 0.2,
  speed_limited: false,
  margin_used: false,
  fallback: false,
  rows: [row({})],
  ...more,
});

const square = { outline_m: [[0, 0], [1, 0], [1, 1], [0, 1]] as [number, number][] }; // prettier-ignore
const polygons = [
  { name: 'mast', ...square },
  { name: 'road', ...square },
];

describe('the reasons for a velocity, in words', () => {
  it('Who slows a drone is named with its distance', () => {
    expect(reasonsInWords(why({}), [])).toEqual(['Slowed by drone cf3, 0.42 m away.']);
  });

  it('Several rows about one body are one reason, with the nearest distance', () => {
    const rows = [row({ distance_m: 0.5 }), row({}), row({ kind: 'wall', wall: 'left', distance_m: 0.17 })];
    expect(reasonsInWords(why({ rows }), [])).toEqual(['Slowed by drone cf3, 0.42 m away and left wall, 0.17 m away.']);
  });

  it('A drone is stopped, turned aside or pushed, as its speed tells', () => {
    const first = (more: Partial<Why>): string => reasonsInWords(why(more), [])[0]!.split(' by ')[0]!;
    expect(first({ u_m_s: [0, 0] })).toBe('Stopped');
    expect(first({ u_m_s: [0, 0.3] })).toBe('Turned aside');
    expect(first({ u_nom_m_s: [0, 0], u_m_s: [-0.1, 0] })).toBe('Pushed');
  });

  it('What is allowed as it was wanted is said to be, and that nothing was near', () => {
    expect(reasonsInWords(why({ u_m_s: [0.3, 0], changed_m_s: 0, rows: [] }), [])).toEqual([
      'Allowed as it was wanted.',
      'Nothing was near enough to ask for anything.',
    ]);
  });

  it('It is said which rules gave way, and that the speed limit held', () => {
    expect(reasonsInWords(why({ margin_used: true }), [])[0]).toMatch(/margins gave way/);
    expect(reasonsInWords(why({ margin_used: true, fallback: true }), [])[0]).toMatch(/nor without margins/);
    expect(reasonsInWords(why({ speed_limited: true }), [])).toContain('Held to 0.30 m/s by the speed limit.');
  });

  it('A no-fly edge has the name of its polygon, counted through all of them', () => {
    expect(rowName(row({ kind: 'no_fly', edge: 5 }), polygons)).toBe('no-fly road');
    expect(rowName(row({ kind: 'no_fly', edge: 8 }), polygons)).toBe('no-fly');
    expect(rowName(row({ kind: 'wall', wall: 'top' }), polygons)).toBe('top wall');
  });
});
