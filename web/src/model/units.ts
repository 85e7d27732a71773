/** Numbers as people read them. What is not known is a dash, never a zero. */

const kUnknown = '–';

const known = (value: number | null | undefined): value is number => value != null && Number.isFinite(value);

/** Digits that a length of this size deserves: 0.413 m, 4.13 m, 41.3 m, 413 m. */
export function metres(value: number | null | undefined): string {
  if (!known(value)) return kUnknown;
  if (Math.abs(value) >= 10_000) return `${(value / 1000).toFixed(1)} km`;
  return `${value.toFixed(decimalsFor(Math.abs(value)))} m`;
}

const decimalsFor = (size: number): number => (size < 10 ? 2 : size < 100 ? 1 : 0);

export function metresPerSecond(value: number | null | undefined): string {
  return known(value) ? `${value.toFixed(2)} m/s` : kUnknown;
}

/** A coordinate of a field that is `extent` metres wide: as many decimals as a thousandth of the field needs. */
export function coordinate(value: number, extent: number): string {
  return value.toFixed(coordinateDecimals(extent));
}

export const coordinateDecimals = (extent: number): number =>
  Math.min(4, Math.max(0, Math.ceil(3 - Math.log10(Math.max(extent, 1e-9)))));

/** A duration that somebody waits for: 0.4 s, 12 s, 3:05, 2:03:05. */
export function duration(seconds: number | null | undefined): string {
  if (!known(seconds)) return kUnknown;
  const sign = seconds < 0 ? '-' : '';
  const size = Math.abs(seconds);
  if (size < 10) return `${sign}${size.toFixed(1)} s`;
  if (size < 60) return `${sign}${Math.floor(size)} s`;
  return sign + clock(size);
}

/** A clock: 0:07, 12:34, 2:03:05. */
export function clock(seconds: number): string {
  const whole = Math.max(0, Math.floor(seconds));
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  const two = (n: number): string => String(n).padStart(2, '0');
  return h > 0 ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
}

/** A share of one in percent: 0.4 %, 12 %. */
export function percent(share: number | null | undefined): string {
  if (!known(share)) return kUnknown;
  const value = 100 * share;
  return `${value < 10 ? value.toFixed(1) : value.toFixed(0)} %`;
}

/** The age of what is shown: 40 ms, 1.2 s. */
export function age(seconds: number | null | undefined): string {
  if (!known(seconds)) return kUnknown;
  return seconds < 1 ? `${Math.round(seconds * 1000)} ms` : duration(seconds);
}

/** What a person typed in a number field; null when it is no finite number. A comma counts as a point. */
export function parseNumber(text: string): number | null {
  const trimmed = text.trim().replace(',', '.');
  if (!/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(trimmed)) return null;
  const value = Number(trimmed);
  return Number.isFinite(value) ? value : null;
}

/** A reason of the program's, which is a clause, as a sentence of its own. */
export const sentence = (clause: string): string =>
  clause === '' ? '' : `${clause[0]!.toUpperCase()}${clause.slice(1)}${/[.!?…]$/.test(clause) ? '' : '.'}`;
