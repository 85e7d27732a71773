import type { Turn } from '../link/messages';
import { duration } from '../model/units';
import { useApp } from './app_context';

const kHourS = 3600;
const kMarksMin = [15, 30, 45] as const;

/** Who is away to be charged in the next hour, by the plan of the moment; only where there are stations. */
export function ChargingPlan() {
  const { session } = useApp();
  const stations = session.mission.value?.mission.stations;
  const plan = session.status.value?.plan;
  if (!stations || stations.length === 0 || !plan) return null;
  const padNames = stations.flatMap(({ name, pads_m }) =>
    pads_m.map((_, i) => (pads_m.length > 1 ? `${name} ${i + 1}` : name)),
  );
  return (
    <section class="panel" aria-label="Charging in the next hour">
      <header>
        <h2>Charging</h2>
        <span class="dim">next hour</span>
      </header>
      {plan.length === 0 && <p class="pad dim">Nobody needs to be charged yet.</p>}
      <ul class="charging">
        {plan.map((turn) => (
          <Row
            key={turn.drone}
            turn={turn}
            name={session.droneIds.value[turn.drone] ?? ''}
            pad={turn.pad === null ? null : (padNames[turn.pad] ?? null)}
          />
        ))}
      </ul>
    </section>
  );
}

function Row({ turn, name, pad }: { turn: Turn; name: string; pad: string | null }) {
  const from = turn.leaves_in_s;
  const to = turn.back_in_s ?? kHourS;
  const percentOf = (timeS: number): number => (100 * Math.min(timeS, kHourS)) / kHourS;
  const words =
    (from > 0 ? `leaves in ${duration(from)}` : `away${pad === null ? '' : `, ${pad}`}`) +
    (turn.back_in_s === null ? '' : `, covers again in ${duration(to)}`);
  return (
    <li title={`${name}: ${words}`}>
      <span>{name}</span>
      <span class="hour" role="img" aria-label={words}>
        {kMarksMin.map((min) => (
          <b key={min} style={{ left: `${(100 * min) / 60}%` }} />
        ))}
        {from < kHourS && (
          <i
            class={from > 0 ? '' : 'is-now'}
            style={{ left: `${percentOf(from)}%`, width: `${Math.max(0.5, percentOf(to) - percentOf(from))}%` }}
          />
        )}
      </span>
      <span class="dim">
        {from > 0 ? `in ${duration(from)}` : turn.back_in_s === null ? 'away' : `back ${duration(to)}`}
      </span>
    </li>
  );
}
