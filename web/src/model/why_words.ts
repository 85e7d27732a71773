import type { Why, WhyRow } from '../link/messages';
import { polygonOfEdge } from './drones';
import type { NoFly } from './targets';
import { metres, metresPerSecond } from './units';

/** What the safety filter said, in words. */

/** A change of velocity that nobody would see. */
const kUnseenMS = 1e-3;

/** "drone cf3", "left wall", "no-fly road". */
export function rowName(row: WhyRow, polygons: readonly NoFly[]): string {
  if (row.kind === 'drone') return `drone ${row.drone ?? '?'}`;
  if (row.kind === 'wall') return `${row.wall ?? ''} wall`.trim();
  const polygon = polygonOfEdge(row.edge ?? -1, polygons);
  return polygon ? `no-fly ${polygon.name}` : 'no-fly';
}

export const kGivesWay: Readonly<Record<string, string>> = {
  doubt: 'doubt',
  margin: 'margin',
  wall: 'wall',
  separation: 'separation',
  physical_radius: 'radius, last',
};

const joined = (parts: readonly string[]): string =>
  parts.length < 2 ? parts.join('') : `${parts.slice(0, -1).join(', ')} and ${parts[parts.length - 1]!}`;

function deed(why: Why): string {
  const [wanted, allowed] = [Math.hypot(...why.u_nom_m_s), Math.hypot(...why.u_m_s)];
  if (allowed < kUnseenMS && wanted > kUnseenMS) return 'Stopped';
  if (wanted < kUnseenMS) return 'Pushed';
  return allowed < wanted - kUnseenMS ? 'Slowed' : 'Turned aside';
}

/** Each body once: what holds a drone may be several rows about the same one. */
function holders(why: Why, polygons: readonly NoFly[]): string[] {
  const held = new Map<string, number>();
  for (const row of why.rows.filter((one) => one.holds)) {
    const name = rowName(row, polygons);
    held.set(name, Math.min(row.distance_m, held.get(name) ?? Infinity));
  }
  return [...held].map(([name, distance]) => `${name}, ${metres(distance)} away`);
}

/** Why the velocity is what it is: a sentence each. */
export function reasonsInWords(why: Why, polygons: readonly NoFly[]): string[] {
  const by = holders(why, polygons);
  const isChanged = (why.changed_m_s ?? 0) >= kUnseenMS;
  const sentences: string[] = [];
  if (why.fallback) sentences.push('No velocity keeps every row, nor without margins: this one breaks them least.');
  else if (why.margin_used) sentences.push('No velocity keeps every row: margins gave way.');
  if (isChanged && by.length > 0) sentences.push(`${deed(why)} by ${joined(by)}.`);
  if (isChanged && why.speed_limited) sentences.push(`Held to ${metresPerSecond(why.u_max_m_s)} by the speed limit.`);
  if (!isChanged) sentences.push('Allowed as it was wanted.');
  if (why.rows.length === 0) sentences.push('Nothing was near enough to ask for anything.');
  return sentences;
}
