import { actionOf, chordOf, kEmergencyWindowMs, TwoPresses, type Action } from '../model/keyboard';
import type { App } from './app_context';
import { FieldKeys } from './field_keys';

/** Keys of the whole page. Fields, open dialogs and pressed buttons keep theirs, but for the alarms. */
export function listenForKeys(app: App): void {
  const stop = new StopKey(app);
  const inFields = new FieldKeys(app);
  window.addEventListener('keydown', (event) => {
    const chord = chordOf({
      key: event.key,
      ctrl: event.ctrlKey || event.metaKey,
      shift: event.shiftKey,
      alt: event.altKey,
    });
    const action = actionOf(app.settings.keys.value, chord);
    if (inFields.take(event, action)) return;
    if (action === null || event.repeat || belongsToTarget(event, action)) return;
    event.preventDefault();
    if (action === 'emergency-stop') stop.press(event.timeStamp);
    else if (action.startsWith('drone-')) selectDrone(app, Number(action.slice('drone-'.length)));
    else perform(app, action as Action);
  });
}

/** What must work wherever the focus is. Of fields in which one is typing `FieldKeys` decides. */
const kAlways: readonly string[] = ['emergency-stop', 'land-all'];

/** Enter and Space belong to a button that has the focus; a dialog or a list has all but alarms. */
function belongsToTarget(event: KeyboardEvent, action: string): boolean {
  const target = event.target as HTMLElement;
  if (target.closest('dialog[open], select')) return !kAlways.includes(action);
  return target.matches('button, a, input, summary') && (action === 'commit' || action === 'place-here');
}

/** The emergency stop outside of fields: what it asks for after the first press is gone with the second, or with its time. */
class StopKey {
  private readonly presses = new TwoPresses();
  private notice = 0;
  private timer = 0;

  constructor(private readonly app: App) {}

  press(nowMs: number): void {
    const { app } = this;
    if (!app.orders.mayStopMotors()) return;
    app.session.dismiss(this.notice);
    app.isStopArmed.value = !this.presses.press(nowMs);
    if (!app.isStopArmed.value) app.orders.emergencyStop('all');
    else this.askAgain();
  }

  private askAgain(): void {
    const { app } = this;
    const ask = 'Press . once more within 0.8 s to stop ALL motors.';
    this.notice = app.session.notify('warning', ask, kEmergencyWindowMs);
    window.clearTimeout(this.timer);
    this.timer = window.setTimeout(() => (app.isStopArmed.value = false), kEmergencyWindowMs);
  }
}

function selectDrone(app: App, number: number): void {
  if (number <= app.session.droneIds.value.length) app.editor.selectDrones([number - 1]);
}

function perform(app: App, action: Action): void {
  kDeeds[action](app);
}

const pausing = (app: App): void => {
  const isPaused = app.session.snapshot?.isPaused ?? false;
  if (app.session.mission.value?.display.can_pause)
    void app.session.command({ type: isPaused ? 'resume_clock' : 'pause' });
};

const stepping =
  (ticks: number) =>
  (app: App): void => {
    if (app.session.isRecording.value) void app.session.command({ type: 'step', ticks });
  };

/** Space at the map's cursor; with the selecting tool it takes what is there. */
const placing = (app: App): void => {
  const cursor = app.editor.cursor.value;
  if (!cursor) app.session.notify('info', 'Move the map’s cursor with the arrow keys first.');
  else if (app.editor.tool.value === 'select') app.map.value?.selectAt(cursor);
  else app.editor.placeAt(cursor);
};

const kDeeds: Record<Action, (app: App) => void> = {
  'tool-select': (app) => app.editor.take('select'),
  'tool-point': (app) => app.editor.take('point'),
  'tool-lasso': (app) => app.editor.take('lasso'),
  'tool-brush': (app) => app.editor.take('brush'),
  'tool-area': (app) => app.editor.take('area'),
  'tool-no-fly': (app) => app.editor.take('no-fly'),
  'tool-measure': (app) => app.editor.take('measure'),
  'tool-go-to': (app) => app.editor.take('go-to'),
  'place-here': placing,
  edit: () => document.querySelector<HTMLInputElement>('[data-testid="entry-editor"] input')?.focus(),
  remove: (app) => app.editor.remove(),
  commit: (app) => void app.editor.commit(),
  drop: (app) => app.editor.drop(),
  undo: (app) => app.editor.undo(),
  redo: (app) => app.editor.redo(),
  'all-drones': (app) => app.editor.selectDrones(app.session.droneIds.value.keys()),
  'take-off': (app) => app.orders.toSelected('take_off'),
  land: (app) => app.orders.toSelected('land'),
  'land-all': (app) => app.orders.landAll(),
  hold: (app) => app.orders.toSelected('hold'),
  return: (app) => app.orders.toSelected('return'),
  resume: (app) => app.orders.toSelected('resume'),
  'mark-failed': (app) => app.orders.toSelected('mark_failed'),
  'give-back': (app) => app.orders.toSelected('give_back'),
  'emergency-stop': () => undefined,
  'layer-density': (app) => app.settings.toggle('density'),
  'layer-coverage': (app) => app.settings.toggle('coverage'),
  'layer-age': (app) => app.settings.toggle('age'),
  'layer-trails': (app) => app.settings.toggle('trails'),
  'layer-radii': (app) => app.settings.toggle('radii'),
  fit: (app) => app.map.value?.fitField(),
  'zoom-in': (app) => app.map.value?.zoom(1.4),
  'zoom-out': (app) => app.map.value?.zoom(1 / 1.4),
  'what-if': (app) => app.foresight.toggle(),
  'pause-clock': pausing,
  'step-back': stepping(-1),
  'step-on': stepping(1),
  'event-log': (app) => (app.isLogOpen.value = !app.isLogOpen.value),
  theme: (app) => (app.settings.theme.value = app.settings.theme.value === 'dark' ? 'light' : 'dark'),
  mute: (app) => (app.settings.isMuted.value = !app.settings.isMuted.value),
  help: (app) => (app.isHelpOpen.value = true),
};
