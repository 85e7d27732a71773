import { useMemo } from 'preact/hooks';
import { useSignal } from '@preact/signals';
import type { Recording, Status } from '../link/messages';
import { clock } from '../model/units';
import { Scrubbing } from '../session/scrubbing';
import { useApp } from './app_context';
import { Icon } from './icons';
import { PlotSpan } from './plots';
import { SpeedChoice } from './speed_choice';

const kSpeeds = [0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100];

/** The clock of a recording, from its first tick to its last, with what has happened until now. */
export function ReplayBar() {
  const { session, isLogOpen } = useApp();
  const recording = session.mission.value?.recording;
  if (!recording) return null;
  return (
    <div class="timeline replay">
      <Deck />
      <Scrubber recording={recording} />
      <Standing recording={recording} />
      <PlotSpan />
      <button type="button" class="quiet" onClick={() => (isLogOpen.value = !isLogOpen.value)}>
        <Icon name="log" />
        Events
      </button>
    </div>
  );
}

/** Step back, play or pause, step on, and how fast. */
function Deck() {
  const { session } = useApp();
  void session.beat.value;
  const isPaused = session.snapshot?.isPaused ?? true;
  const mayNot = !session.mayTurnClock.value;
  const step = (ticks: number) => () => void session.command({ type: 'step', ticks });
  return (
    <div class="deck" role="group" aria-label="Clock of the recording">
      <button
        type="button"
        class="quiet"
        aria-label="One tick back"
        title="One tick back ([)"
        disabled={mayNot}
        onClick={step(-1)}
      >
        <Icon name="stepBack" />
      </button>
      <button
        type="button"
        class="quiet"
        aria-label={isPaused ? 'Play' : 'Pause'}
        title={`${isPaused ? 'Play' : 'Pause'} (K)`}
        disabled={mayNot}
        onClick={() => void session.command({ type: isPaused ? 'resume_clock' : 'pause' })}
      >
        <Icon name={isPaused ? 'play' : 'pause'} />
      </button>
      <button
        type="button"
        class="quiet"
        aria-label="One tick on"
        title="One tick on (])"
        disabled={mayNot}
        onClick={step(1)}
      >
        <Icon name="stepOn" />
      </button>
      <SpeedChoice label="Speed of the recording" factors={kSpeeds} />
    </div>
  );
}

/** While it is dragged it shows where it is dragged to, not where the program has come to. */
function Scrubber({ recording }: { recording: Recording }) {
  const { session } = useApp();
  void session.beat.value;
  const scrubbing = useMemo(() => new Scrubbing(session), [session]);
  const dragged = useSignal<number | null>(null);
  const { begin_s: begin, end_s: end } = recording;
  const span = Math.max(end - begin, recording.spacing_s);
  const now = dragged.value ?? session.snapshot?.timeS ?? begin;
  const marks = session.events.value.filter((event) => event.severity !== 'info').slice(-60);
  return (
    <div class="scrubber">
      <div class="marks" aria-hidden="true">
        {marks.map((event) => (
          <i
            key={event.number}
            class={event.severity}
            style={{ left: `${(100 * (event.time_s - begin)) / span}%` }}
            title={`${clock(event.time_s)} ${event.text}`}
          />
        ))}
      </div>
      <input
        type="range"
        aria-label="Moment of the recording"
        aria-valuetext={`${clock(now)} of ${clock(end)}`}
        min={begin}
        max={end}
        step={recording.spacing_s}
        value={now}
        disabled={!session.mayTurnClock.value}
        onInput={(event) => {
          dragged.value = Number(event.currentTarget.value);
          scrubbing.to(dragged.value);
        }}
        onChange={() => (dragged.value = null)}
      />
    </div>
  );
}

/** Where it is, and whatever a person should know of the recording there. */
function Standing({ recording }: { recording: Recording }) {
  const { session } = useApp();
  void session.beat.value;
  const replay = session.status.value?.replay;
  const trouble = replay ? troubleOf(recording, replay) : '';
  return (
    <p class="health" data-testid="replay-standing">
      <span>
        tick {replay ? replay.number : '–'} of {recording.ticks}
      </span>
      <span class={trouble ? 'warning' : ''} title={trouble || recording.incomplete} role="status">
        {trouble || standingOf(recording, replay)}
      </span>
    </p>
  );
}

type Replay = NonNullable<Status['replay']>;

function troubleOf(recording: Recording, replay: Replay): string {
  if (replay.difference) return `differs: ${replay.difference}`;
  if (replay.is_at_end && recording.incomplete) return `cut off here: ${recording.incomplete}`;
  return '';
}

function standingOf(recording: Recording, replay: Replay | null | undefined): string {
  if (!replay) return '–';
  if (replay.is_seeking) return `computing … ${Math.floor(100 * replay.progress)} %`;
  if (replay.is_at_end) return 'end of the recording';
  if (!replay.is_recomputed) return 'as recorded';
  return recording.incomplete ? 'recomputed; was cut off' : 'recomputed';
}
