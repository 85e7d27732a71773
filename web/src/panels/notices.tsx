import { useEffect } from 'preact/hooks';
import type { Notice } from '../session/notices';
import { useApp } from './app_context';
import { Icon } from './icons';

/** So many alarms are shown at once: the newest. */
const kMostAlarmsShown = 3;

/** Short messages. Screen readers hear them when they come: alarms at once, the rest when it is quiet. */
export function Notices() {
  const { session, settings } = useApp();
  const notices = session.notices.value;
  const alarms = notices.filter((notice) => notice.kind === 'alarm');
  const newestAlarm = alarms[alarms.length - 1]?.number;
  useEffect(() => {
    if (newestAlarm !== undefined && !settings.isMuted.peek()) beep();
  }, [newestAlarm]);
  const others = notices.filter((notice) => notice.kind !== 'alarm');
  return (
    <div class="notices" data-testid="notices">
      <div role="alert">{alarms.slice(-kMostAlarmsShown).map((notice) => line(notice))}</div>
      <OlderAlarms count={alarms.length - kMostAlarmsShown} />
      <div role="status">{others.map((notice) => line(notice))}</div>
    </div>
  );

  function line(notice: Notice) {
    return (
      <div key={notice.number} class={`notice is-${notice.kind}`}>
        <Icon name={notice.kind} />
        <span class="said">{notice.text}</span>
        {notice.kind !== 'info' && (
          <button type="button" aria-label="Dismiss this message" onClick={() => session.dismiss(notice.number)}>
            <Icon name="close" small />
          </button>
        )}
      </div>
    );
  }
}

/** Those that are not shown any more, and a way to be done with all of them. */
function OlderAlarms({ count }: { count: number }) {
  const { session } = useApp();
  if (count <= 0) return null;
  return (
    <div class="notice is-alarm">
      <span class="said">
        and {count} older {count === 1 ? 'alarm' : 'alarms'}
      </span>
      <button type="button" onClick={() => session.dismissAlarms()}>
        Dismiss all
      </button>
    </div>
  );
}

let audio: AudioContext | null = null;

/** Two short tones. A browser that wants a click first stays silent: the message is on the screen all the same. */
function beep(): void {
  audio ??= new AudioContext();
  if (audio.state !== 'running') return;
  for (const [start, pitch] of [
    [0, 880],
    [0.18, 660],
  ] as const) {
    // prettier-ignore
    const tone = audio.createOscillator();
    const volume = audio.createGain();
    tone.frequency.value = pitch;
    volume.gain.value = 0.06;
    tone.connect(volume).connect(audio.destination);
    tone.start(audio.currentTime + start);
    tone.stop(audio.currentTime + start + 0.14);
  }
}
