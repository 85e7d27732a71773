/**
 * A small vocabulary for "what this JSON must look like": a Shape takes any value and gives the typed one back, or throws
 * ShapeError with the place. Members that are not asked for are passed over.
 */

export class ShapeError extends Error {}

export type Shape<T> = (value: unknown, place: string) => T;
export type Shaped<S> = S extends Shape<infer T> ? T : never;

const wrong = (place: string, wanted: string, value: unknown): never => {
  throw new ShapeError(`${place}: ${wanted} expected, not ${String(JSON.stringify(value)).slice(0, 60)}`);
};

export const finite: Shape<number> = (value, place) =>
  typeof value === 'number' && Number.isFinite(value) ? value : wrong(place, 'a number', value);

export const flag: Shape<boolean> = (value, place) =>
  typeof value === 'boolean' ? value : wrong(place, 'true or false', value);

export const text =
  (most: number): Shape<string> =>
  (value, place) =>
    typeof value === 'string' && value.length <= most
      ? value
      : wrong(place, `text of at most ${most} characters`, value);

export const oneOf =
  <const W extends readonly string[]>(...words: W): Shape<W[number]> =>
  (value, place) =>
    words.includes(value as string) ? (value as W[number]) : wrong(place, words.join(' or '), value);

export const orNull =
  <T>(shape: Shape<T>): Shape<T | null> =>
  (value, place) =>
    value === null ? null : shape(value, place);

/** Left out is like null. */
export const maybe =
  <T>(shape: Shape<T>): Shape<T | null> =>
  (value, place) =>
    value === undefined || value === null ? null : shape(value, place);

export const list =
  <T>(shape: Shape<T>, most: number): Shape<T[]> =>
  (value, place) => {
    if (!Array.isArray(value) || value.length > most) return wrong(place, `a list of at most ${most} entries`, value);
    return value.map((entry: unknown, i) => shape(entry, `${place}[${i}]`));
  };

export const record =
  <M extends Record<string, Shape<unknown>>>(members: M): Shape<{ [K in keyof M]: Shaped<M[K]> }> =>
  (value, place) => {
    if (typeof value !== 'object' || value === null || Array.isArray(value)) return wrong(place, 'an object', value);
    const found = value as Record<string, unknown>;
    return Object.fromEntries(
      Object.entries(members).map(([key, shape]) => [key, shape(found[key], `${place}.${key}`)]),
    ) as { [K in keyof M]: Shaped<M[K]> };
  };

export const point: Shape<readonly [number, number]> = (value, place) => {
  if (!Array.isArray(value) || value.length !== 2) return wrong(place, 'a point [x, y]', value);
  return [finite(value[0], `${place}[0]`), finite(value[1], `${place}[1]`)];
};
