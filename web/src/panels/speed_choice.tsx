import { useApp } from './app_context';

/** How fast the clock goes: one of these factors as far as the program takes them. */
export function SpeedChoice({ label, factors }: { label: string; factors: readonly number[] }) {
  const { session } = useApp();
  void session.beat.value;
  const speed = session.snapshot?.speed ?? 1;
  const display = session.mission.value?.display;
  const possible = factors.filter(
    (factor) => factor >= (display?.least_speed ?? 1) && factor <= (display?.most_speed ?? 1),
  );
  const shown = possible.includes(speed) ? possible : [...possible, speed];
  return (
    <select
      aria-label={label}
      value={String(speed)}
      disabled={!session.mayTurnClock.value}
      onChange={(event) => void session.command({ type: 'set_speed', factor: Number(event.currentTarget.value) })}
    >
      {shown.map((factor) => (
        <option key={factor} value={String(factor)}>
          {factor}×
        </option>
      ))}
    </select>
  );
}
