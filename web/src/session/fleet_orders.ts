import type { Point } from '../model/geometry';
import type { Editor } from './editor';
import type { Session } from './session';

/** What an operator may ask of drones, in the order of the buttons. */
export const kOrders = ['take_off', 'land', 'hold', 'return', 'resume', 'mark_failed', 'give_back'] as const;
export type Order = (typeof kOrders)[number];

export const kOrderNames: Record<Order, string> = {
  take_off: 'Take off',
  land: 'Land',
  hold: 'Hold',
  return: 'Return',
  resume: 'Resume',
  mark_failed: 'Mark failed',
  give_back: 'Give back',
};

/** What is never asked of all drones by a button that nobody chose drones for: LAND ALL says what it does. */
export const wantsSelection = (order: Order): boolean => order === 'land' || order === 'mark_failed';

/** Orders to the selected drones, or to all. */
export class FleetOrders {
  constructor(
    private readonly session: Session,
    private readonly editor: Editor,
  ) {}

  /** To the selected drones; says so when none is. */
  toSelected(order: Order): void {
    const drones = this.selectedIds();
    if (drones.length === 0)
      this.session.notify(
        'info',
        'Keys order the selected drones, and none is: take a digit, Ctrl+A, the table or the map.',
      );
    else this.to(order, drones);
  }

  to(order: Order, drones: readonly string[] | 'all'): void {
    const areAll = drones === 'all' || drones.length === this.session.fleetSize.value;
    const who = areAll ? 'all drones' : drones.length > 3 ? `${drones.length} drones` : drones.join(', ');
    // Who was chosen is named, also where it is everybody: to resume "all" leaves those that are marked failed.
    const command = this.session.forThisFlight({ type: order, drones });
    const done = `${kOrderNames[order]}: ${who}`;
    if (order === 'land') void this.session.bringDown(command, done, done);
    else void this.session.command(command, done);
  }

  /** The selected drones fly to a place of the world and wait there; says so when none is. */
  goTo(place: Point): void {
    const drones = this.selectedIds();
    if (drones.length === 0) {
      this.session.notify('info', 'Go to sends the selected drones, and none is: select drones first.');
      return;
    }
    const who = drones.length > 3 ? `${drones.length} drones` : drones.join(', ');
    const place_m = [place[0], place[1]];
    const command = { type: 'go_to', drones, place_m };
    void this.session.command(this.session.forThisFlight(command), `On the way: ${who}`);
  }

  landAll(): void {
    void this.session.bringDown({ type: 'land_all' }, 'LAND ALL', 'LAND ALL: every drone comes down.');
  }

  emergencyStop(drones: readonly string[] | 'all'): void {
    const who = drones === 'all' ? 'all drones' : drones.join(', ');
    const done = `EMERGENCY STOP: motors off, ${who}.`;
    const command = { type: 'emergency_stop', drones };
    // A stop of all is always meant; "cf1" may be another drone in another flight.
    const meant = drones === 'all' ? command : this.session.forThisFlight(command);
    void this.session.bringDown(meant, 'EMERGENCY STOP', done);
  }

  /** Says that a button was held too shortly to stop motors, and what else there is to do. */
  stopLetGo(otherwise: string): void {
    this.session.notify('warning', `No motor was stopped: hold the button for one second, ${otherwise}.`);
  }

  /** Whether this console may order that of drones now. */
  may(order: Order): boolean {
    return order === 'land' ? this.session.mayLand.value : this.session.mayOperate.value;
  }

  /** Whether this console may stop motors now; says why where it may not. */
  mayStopMotors(): boolean {
    const { session } = this;
    if (session.mayStopMotors.value) return true;
    const reason = session.isRecording.value
      ? 'This is a recording: nothing was sent.'
      : session.isConnected.value
        ? 'Only a safety pilot may stop motors.'
        : 'Not connected: nothing was sent.';
    session.notify('warning', reason);
    return false;
  }

  private selectedIds(): string[] {
    const ids = this.session.droneIds.value;
    return [...this.editor.selectedDrones.value].flatMap((drone) => ids[drone] ?? []);
  }
}
