import type { SwarmEvent } from '../link/messages';

/** What another operator did, as a message: what ends a flight is an alarm and says so in capitals. */
export function deedOf(event: SwarmEvent): { readonly kind: 'info' | 'alarm'; readonly text: string } {
  const drones = event.drone === '' || event.drone === 'all' ? 'all drones' : event.drone;
  if (event.what === 'emergency_stop')
    return { kind: 'alarm', text: `EMERGENCY STOP by ${event.by}: motors off, ${drones}.` };
  if (event.what === 'land_all') return { kind: 'alarm', text: `LAND ALL by ${event.by}: every drone comes down.` };
  const isNamed = event.text.startsWith(`${event.by}: `);
  return { kind: 'info', text: isNamed ? event.text : `${event.by}: ${event.text}` };
}
