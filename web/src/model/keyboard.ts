/** What keys do, and how a person changes that. Pure: the page hands key events in, and gets the name of an action out. */

export interface KeyPress {
  readonly key: string;
  readonly ctrl: boolean;
  readonly shift: boolean;
  readonly alt: boolean;
}

interface Binding {
  readonly keys: string;
  readonly does: string;
  readonly group: 'Tools' | 'Edits' | 'Drones' | 'View';
}

/** Every action with its usual keys. `Ctrl` is also the Mac's command key. */
export const kActions = {
  'tool-select': { keys: 'S', does: 'Select', group: 'Tools' },
  'tool-point': { keys: 'P', does: 'Add target points', group: 'Tools' },
  'tool-lasso': { keys: 'B', does: 'Lasso: fill a drawn shape with points', group: 'Tools' },
  'tool-brush': { keys: 'Shift+B', does: 'Brush points', group: 'Tools' },
  'tool-area': { keys: 'A', does: 'Draw an area', group: 'Tools' },
  'tool-no-fly': { keys: 'N', does: 'Draw a no-fly polygon', group: 'Tools' },
  'tool-measure': { keys: 'D', does: 'Measure distances', group: 'Tools' },
  'tool-go-to': { keys: 'J', does: 'Send the selected drones to a place', group: 'Tools' },
  'place-here': { keys: 'Space', does: 'Use the tool at the map’s keyboard cursor', group: 'Tools' },
  edit: { keys: 'E', does: 'Edit the selected area or cluster by numbers', group: 'Edits' },
  remove: { keys: 'Delete', does: 'Remove what is selected', group: 'Edits' },
  commit: { keys: 'Enter', does: 'Commit staged edits', group: 'Edits' },
  drop: { keys: 'Escape', does: 'Drop what is being drawn, then staged edits', group: 'Edits' },
  undo: { keys: 'Ctrl+Z', does: 'Undo', group: 'Edits' },
  redo: { keys: 'Ctrl+Shift+Z', does: 'Redo', group: 'Edits' },
  'all-drones': { keys: 'Ctrl+A', does: 'Select all drones', group: 'Drones' },
  'take-off': { keys: 'T', does: 'Take off', group: 'Drones' },
  land: { keys: 'L', does: 'Land', group: 'Drones' },
  'land-all': { keys: 'Shift+L', does: 'LAND ALL, at once', group: 'Drones' },
  hold: { keys: 'H', does: 'Hold: hover, out of coverage', group: 'Drones' },
  return: { keys: 'R', does: 'Return to where it started, and wait there', group: 'Drones' },
  resume: { keys: 'U', does: 'Resume coverage', group: 'Drones' },
  'mark-failed': { keys: 'X', does: 'Mark failed', group: 'Drones' },
  'give-back': { keys: 'V', does: 'Give back after a pilot took over', group: 'Drones' },
  'emergency-stop': { keys: '.', does: 'EMERGENCY STOP: twice within 0.8 s, motors off', group: 'Drones' },
  'layer-density': { keys: 'Shift+D', does: 'Importance', group: 'View' },
  'layer-coverage': { keys: 'C', does: 'Achieved coverage', group: 'View' },
  'layer-age': { keys: 'G', does: 'Age map', group: 'View' },
  'layer-trails': { keys: 'Shift+T', does: 'Trails', group: 'View' },
  'layer-radii': { keys: 'Shift+R', does: 'Safety radii', group: 'View' },
  fit: { keys: 'F', does: 'Fit the field', group: 'View' },
  'zoom-in': { keys: '+', does: 'Zoom in', group: 'View' },
  'zoom-out': { keys: '-', does: 'Zoom out', group: 'View' },
  'what-if': { keys: 'W', does: 'Look a minute ahead; without the selected drones', group: 'View' },
  'pause-clock': { keys: 'K', does: 'Pause or go on (simulated fleet, recording)', group: 'View' },
  'step-back': { keys: '[', does: 'One tick back (recording)', group: 'View' },
  'step-on': { keys: ']', does: 'One tick on (recording)', group: 'View' },
  'event-log': { keys: 'O', does: 'Event log', group: 'View' },
  theme: { keys: 'Shift+K', does: 'Dark or light', group: 'View' },
  mute: { keys: 'M', does: 'Mute or sound the alarms', group: 'View' },
  help: { keys: '?', does: 'Help', group: 'View' },
} as const satisfies Record<string, Binding>;

export type Action = keyof typeof kActions;
export type KeyMap = Readonly<Record<Action, string>>;

export const kUsualKeys: KeyMap = Object.fromEntries(
  Object.entries(kActions).map(([action, binding]) => [action, binding.keys]),
) as KeyMap;

const isAction = (name: string): name is Action => Object.hasOwn(kActions, name);

/** Shift is part of a letter's or a named key's chord; of `?` or `+` it is only how they are typed. */
export function chordOf(press: KeyPress): string {
  const named = press.key === ' ' ? 'Space' : press.key === 'Backspace' ? 'Delete' : press.key;
  const key = named.length === 1 ? named.toUpperCase() : named;
  const shift = press.shift && (key.length > 1 || /[A-Z]/.test(key));
  return [press.ctrl && 'Ctrl', press.alt && 'Alt', shift && 'Shift', key].filter(Boolean).join('+');
}

/** The action of a chord; `drone-N` (N from 1 to 9) cannot be remapped. */
export function actionOf(map: KeyMap, chord: string): Action | `drone-${number}` | null {
  if (/^[1-9]$/.test(chord)) return `drone-${Number(chord)}`;
  const found = Object.entries(map).find(([, keys]) => keys === chord);
  return found && isAction(found[0]) ? found[0] : null;
}

/** The map with this action's keys changed, or why that cannot be. */
export function remapped(map: KeyMap, action: Action, chord: string): KeyMap | string {
  if (/^[1-9]$/.test(chord)) return 'The digits select drones.';
  if (/^(?:Ctrl\+|Alt\+|Shift\+)*(?:Tab|Control|Shift|Alt|Meta)$/.test(chord))
    return 'Press a key that is not only a modifier.';
  const taken = actionOf(map, chord);
  if (taken !== null && taken !== action && isAction(taken)) return `${chord} already does “${kActions[taken].does}”.`;
  return { ...map, [action]: chord };
}

/** The stored map, with usual keys for whatever the text lacks or gets wrong. */
export function readKeyMap(stored: string | null): KeyMap {
  let map = kUsualKeys;
  for (const [action, chord] of storedEntries(stored)) {
    if (!isAction(action) || typeof chord !== 'string' || chord.length > 40) continue;
    const changed = remapped(map, action, chord);
    if (typeof changed !== 'string') map = changed;
  }
  return map;
}

function storedEntries(stored: string | null): [string, unknown][] {
  try {
    const value: unknown = JSON.parse(stored ?? '{}');
    return typeof value === 'object' && value !== null ? Object.entries(value) : [];
  } catch {
    return [];
  }
}

export const kEmergencyWindowMs = 800;

/** What a key means while somebody types in a field: text of the field, or an alarm of the page all the same. */
export type MeaningInField = 'typed' | 'land-all' | 'stop-in-number' | 'stop-in-text';

/** In a number a letter can never be meant, so LAND ALL acts there; whether dots are an alarm their number and pace decide. */
export function meaningInField(isNumber: boolean, action: string, key: string): MeaningInField {
  if (action === 'emergency-stop') return isNumber ? 'stop-in-number' : 'stop-in-text';
  const isOfNumber = key.length > 1 || /^[-+.,0-9eE]$/.test(key);
  return isNumber && action === 'land-all' && !isOfNumber ? 'land-all' : 'typed';
}

/** Two presses within 0.8 s. Feed it every press with its time; true means: stop the motors. */
export class TwoPresses {
  private last = -Infinity;

  press(nowMs: number): boolean {
    const isSecond = nowMs - this.last <= kEmergencyWindowMs;
    this.last = isSecond ? -Infinity : nowMs;
    return isSecond;
  }

  /** The next press is a first one. */
  forget(): void {
    this.last = -Infinity;
  }
}
