import type { Outlook, Preview } from '../link/messages';
import type { Point } from './geometry';

/** One line of the table of a look ahead: an area as it will fare if all stays as it is, and with what is tried. */
export interface AreaLine {
  readonly name: string;
  readonly asIs: Outlook['areas'][number] | null;
  readonly whatIf: Outlook['areas'][number] | null;
}

/** The areas of both futures, those that are there already first. */
export function areaLines(preview: Preview): AreaLine[] {
  const key = (area: Outlook['areas'][number]): string => `${area.kind} ${area.name}`;
  const asIs = new Map(preview.as_is.areas.map((area) => [key(area), area]));
  const whatIf = new Map((preview.what_if?.areas ?? []).map((area) => [key(area), area]));
  return [...new Set([...asIs.keys(), ...whatIf.keys()])].map((name) => ({
    name: (asIs.get(name) ?? whatIf.get(name))!.name,
    asIs: asIs.get(name) ?? null,
    whatIf: whatIf.get(name) ?? null,
  }));
}

/** No drone covers at its end: what speaks of a swarm that covers says nothing then. */
export const isUncovered = (outlook: Outlook): boolean => outlook.active === 0;

/** The last value of a series; null for an empty one. */
export const last = (values: readonly number[]): number | null => values[values.length - 1] ?? null;

/**
 * What is still ahead of a drone's ghost trail, `elapsedS` after it was computed: from where it would be by now to where it
 * would be `lengthS` after that, or to its end. Places that are not known are left out.
 */
export function trailAhead(
  xy: readonly (number | null)[],
  spacingS: number,
  elapsedS: number,
  lengthS: number,
): Point[] {
  const points: Point[] = [];
  const most = Math.floor((Math.max(0, elapsedS) + lengthS) / spacingS) + 1;
  for (let i = 0; i + 1 < xy.length && points.length < most; i += 2) {
    const [x, y] = [xy[i], xy[i + 1]];
    if (x != null && y != null) points.push([x, y]);
  }
  const passed = Math.max(0, elapsedS / spacingS);
  const next = Math.floor(passed) + 1;
  if (next >= points.length) return points.slice(-1);
  const [from, to, share] = [points[next - 1]!, points[next]!, passed - Math.floor(passed)];
  return [[from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])], ...points.slice(next)];
}
