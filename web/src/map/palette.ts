import { rgb, type Rgb } from './gl';

/** The map's colours in either theme; panels take theirs from look/colours.css, which says the same. */
export interface Palette {
  readonly outside: string;
  readonly field: string;
  readonly grid: string;
  readonly border: string;
  readonly text: string;
  readonly faint: string;
  readonly halo: string;
  readonly density: Rgb;
  readonly densityContour: Rgb;
  readonly densityCss: string;
  readonly coverage: Rgb;
  readonly age: Rgb;
  readonly trails: readonly [Rgb, Rgb, Rgb];
  readonly casing: Rgb;
  readonly casingAlpha: number;
  readonly active: Rgb;
  readonly away: Rgb;
  readonly failed: Rgb;
  readonly outline: Rgb;
  readonly accent: string;
  readonly warning: string;
  readonly failure: string;
  readonly target: string;
  readonly area: string;
  /** What would be. */
  readonly ghost: string;
}

const dark: Palette = {
  outside: '#0b0f13',
  field: '#111820',
  grid: 'rgba(160, 190, 215, 0.075)',
  border: '#3d5061',
  text: '#dfe8ef',
  faint: '#8fa3b3',
  halo: 'rgba(9, 13, 17, 0.85)',
  density: rgb('#d7263d'),
  densityContour: rgb('#ff8a94'),
  densityCss: '#ff8a94',
  coverage: rgb('#3fb8e0'),
  age: rgb('#9a8cff'),
  trails: [rgb('#d9f7c4'), rgb('#86e0a0'), rgb('#2fbf71')],
  casing: rgb('#06090c'),
  casingAlpha: 0.55,
  active: rgb('#f4fff0'),
  away: rgb('#f0b429'),
  failed: rgb('#ff6fb5'),
  outline: rgb('#06090c'),
  accent: '#56b4e9',
  warning: '#f0b429',
  failure: '#ff6fb5',
  target: '#ffd9dd',
  area: '#ffb3ba',
  ghost: '#c9a7ff',
};

const light: Palette = {
  outside: '#e3e8ec',
  field: '#fbfcfd',
  grid: 'rgba(30, 60, 85, 0.09)',
  border: '#7b8d9b',
  text: '#13212b',
  faint: '#50626f',
  halo: 'rgba(255, 255, 255, 0.88)',
  density: rgb('#d7263d'),
  densityContour: rgb('#9c1227'),
  densityCss: '#9c1227',
  coverage: rgb('#0072b2'),
  age: rgb('#5b45d6'),
  trails: [rgb('#0d4f2a'), rgb('#1d8a4b'), rgb('#3fae6f')],
  casing: rgb('#ffffff'),
  casingAlpha: 0.75,
  active: rgb('#0a2a17'),
  away: rgb('#8a5a00'),
  failed: rgb('#b3135f'),
  outline: rgb('#ffffff'),
  accent: '#0b66a3',
  warning: '#8a5a00',
  failure: '#b3135f',
  target: '#7a0f20',
  area: '#9c1227',
  ghost: '#6b35b8',
};

export const kPalettes = { dark, light } as const;
