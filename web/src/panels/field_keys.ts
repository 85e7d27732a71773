import { meaningInField, TwoPresses } from '../model/keyboard';
import type { App } from './app_context';

const kField = 'input:not([type=checkbox], [type=range]), textarea';
const kNumberField = 'input[inputmode=decimal]';
const kModifiers: readonly string[] = ['Shift', 'Control', 'Alt', 'Meta'];

/**
 * Keys while somebody types in a field. They are the field's, but an operator who presses an alarm there must get it, or be
 * told: LAND ALL acts in number fields, two presses of the emergency stop as well, with nothing between them; in names
 * both are text, and two presses are answered with what to do.
 */
export class FieldKeys {
  private readonly stop = new TwoPresses();
  private beforeStop = '';

  constructor(private readonly app: App) {}

  /** True where the key is done with: it went into a field, or was an alarm pressed in one. */
  take(event: KeyboardEvent, action: string | null): boolean {
    const field = event.target as HTMLInputElement;
    if (!field.matches(kField)) {
      this.stop.forget();
      return false;
    }
    const isNumber = field.matches(kNumberField);
    const meaning = action === null ? 'typed' : meaningInField(isNumber, action, event.key);
    if (event.repeat) return true;
    if (meaning === 'typed') this.typed(event.key);
    else if (meaning === 'land-all') this.landAll(event);
    else this.pressStop(event, field, isNumber);
    return true;
  }

  /** Decimals typed one after the other are no alarm. */
  private typed(key: string): void {
    if (!kModifiers.includes(key)) this.stop.forget();
  }

  private landAll(event: KeyboardEvent): void {
    event.preventDefault();
    this.app.orders.landAll();
  }

  private pressStop(event: KeyboardEvent, field: HTMLInputElement, isNumber: boolean): void {
    if (!this.stop.press(event.timeStamp)) this.beforeStop = field.value;
    else if (isNumber) this.stopMotors(event, field);
    else
      this.app.session.notify(
        'warning',
        'No emergency stop: the keys went into the field. Press Escape to leave it, then . twice; or hold the button.',
      );
  }

  /** Takes the first press out of the number again. */
  private stopMotors(event: KeyboardEvent, field: HTMLInputElement): void {
    event.preventDefault();
    field.value = this.beforeStop;
    field.dispatchEvent(new Event('input', { bubbles: true }));
    if (this.app.orders.mayStopMotors()) this.app.orders.emergencyStop('all');
  }
}
