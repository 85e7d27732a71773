import { useEffect, useRef } from 'preact/hooks';
import { clock } from '../model/units';
import type { LoggedEvent } from '../session/event_book';
import { useApp } from './app_context';
import { Icon } from './icons';

/** Who did what when, and what became of drones: the newest first. */
export function EventLog() {
  const { session, isLogOpen } = useApp();
  const close = useRef<HTMLButtonElement>(null);
  useEffect(() => {
    if (isLogOpen.value) close.current?.focus();
  }, [isLogOpen.value]);
  if (!isLogOpen.value) return null;
  const events = [...session.events.value].reverse();
  return (
    <aside
      class="drawer"
      aria-label="Event log"
      onKeyDown={(event) => {
        if (event.key !== 'Escape') return;
        event.stopPropagation();
        isLogOpen.value = false;
      }}
    >
      <header>
        <h2>Event log</h2>
        <button
          ref={close}
          type="button"
          class="quiet"
          aria-label="Close the event log"
          onClick={() => (isLogOpen.value = false)}
        >
          <Icon name="close" />
        </button>
      </header>
      {events.length === 0 && <p class="pad dim">Nothing has happened yet.</p>}
      <ol class="log" tabIndex={0} aria-label="Events, newest first">
        {events.flatMap((event, i) => [
          <FlightBefore key={`${keyOf(event)} after`} event={event} next={events[i - 1]} />,
          <li key={keyOf(event)}>
            <span class="dim">{clock(event.time_s)}</span>
            <span class={event.severity}>
              <Icon name={event.severity} small />
              <span class="unseen">{event.severity}</span>
            </span>
            <span>
              {event.text}
              {event.by && <span class="dim"> by {event.by}</span>}
            </span>
            {(event.effect || event.next) && (
              <span class="more">
                {event.effect}
                {event.effect && event.next && '. '}
                {event.next && `Next: ${event.next}`}
              </span>
            )}
          </li>,
        ])}
      </ol>
    </aside>
  );
}

/** Numbers begin anew with the program. */
const keyOf = (event: LoggedEvent): string => `${event.run} ${event.number}`;

/** A line between the events of two flights. */
function FlightBefore({ event, next }: { event: LoggedEvent; next: LoggedEvent | undefined }) {
  if (!next || (next.run === event.run && next.epoch === event.epoch)) return null;
  return (
    <li class="flight">
      {next.run === event.run
        ? 'Before this, in the mission flown before'
        : 'Before this, until the program was restarted'}
    </li>
  );
}
