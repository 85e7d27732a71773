import { useEffect } from 'preact/hooks';
import { useApp } from './app_context';
import { Icon } from './icons';

/** Short messages. Screen readers hear them when they come: alarms at once, the rest when it is quiet. */
export function Notices() {
  const { session, settings } = useApp();
  const notices = session.notices.value;
  const alarms = notices.filter((notice) => notice.kind === 'alarm');
  const newestAlarm = alarms[alarms.length - 1]?.number;
  useEffect(() => {
    if (newestAlarm !== undefined && !settings.isMuted.peek()) beep();
  }, [newestAlarm]);
  const list = (isAlarm: boolean) =>
    notices
      .filter((notice) => (notice.kind === 'alarm') === isAlarm)
      .map((notice) => (
        <div key={notice.number} class={`notice is-${notice.kind}`}>
          <Icon name={notice.kind} />
          <span class="said">{notice.text}</span>
          {notice.kind !== 'info' && (
            <button type="button" aria-label="Dismiss this message" onClick={() => session.dismiss(notice.number)}>
              <Icon name="close" small />
            </button>
          )}
        </div>
      ));
  return (
    <div class="notices" data-testid="notices">
      <div role="alert">{list(true)}</div>
      <div role="status">{list(false)}</div>
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
