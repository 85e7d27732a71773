import type { Ack } from '../link/messages';

const kMostNamed = 3;

/** What was asked of drones and which of them could not, with how many there are; empty where all could. */
export function refusalWords(asked: string, ack: Ack): string {
  const refused = ack.refused_drones ?? [];
  const count = Math.max(ack.refused_count ?? 0, refused.length);
  if (count === 0) return '';
  const named = refused.slice(0, kMostNamed).map(({ drone, reason }) => reasonOf(drone, reason));
  const more = count > named.length ? [`and ${count - named.length} more`] : [];
  return `${asked.replace(/\.$/, '')}, but not ${count} of them: ${[...named, ...more].join('; ')}`;
}

/** Each drone is named once. */
const reasonOf = (drone: string, reason: string): string =>
  reason.startsWith(`${drone} `) || reason.startsWith(`${drone}:`) ? reason : `${drone}: ${reason}`;
