import type { SwarmEvent } from '../link/messages';
import { clock } from '../model/units';
import { useApp } from './app_context';
import { Icon } from './icons';
import { PlotSpan } from './plots';
import { ProgramHealth } from './program_health';

const kWindowS = 120;
const kTickS = [10, 20] as const;

/** The last two minutes with what happened in them; the event log says the same in words. */
export function Timeline() {
  const { session, isLogOpen } = useApp();
  void session.beat.value;
  const now = session.snapshot?.timeS ?? 0;
  const from = Math.max(0, now - kWindowS);
  const span = Math.max(30, now - from);
  const share = (time: number): string => `${(100 * (time - from)) / span}%`;
  const tickS = span <= 60 ? kTickS[0] : kTickS[1];
  const firstTick = Math.ceil((from + 0.02 * span) / tickS);
  const ticks = Array.from({ length: Math.floor(span / tickS) }, (_, i) => (firstTick + i) * tickS).filter(
    (time) => time < from + 0.97 * span,
  );
  const shown = session.events.value
    .filter((event) => session.isOfThisFlight(event) && event.time_s >= from && event.time_s <= now)
    .slice(-60);
  return (
    <div class="timeline">
      <div class="track" role="img" aria-label={describe(shown)}>
        {ticks.map((time) => (
          <span key={time} class="tick" style={{ left: share(time) }}>
            {clock(time)}
          </span>
        ))}
        {shown.map((event) => (
          <span
            key={event.number}
            class={`mark ${event.severity}`}
            style={{ left: share(event.time_s) }}
            title={`${clock(event.time_s)} ${event.text}`}
          >
            <Icon name={event.severity} small />
          </span>
        ))}
      </div>
      <ProgramHealth />
      <PlotSpan />
      <button type="button" class="quiet" onClick={() => (isLogOpen.value = !isLogOpen.value)}>
        <Icon name="log" />
        Events
      </button>
    </div>
  );
}

function describe(events: readonly SwarmEvent[]): string {
  if (events.length === 0) return 'Timeline: nothing happened in the last two minutes';
  return `Timeline: ${events
    .slice(-8)
    .map((event) => `${clock(event.time_s)} ${event.text}`)
    .join('; ')}`;
}
