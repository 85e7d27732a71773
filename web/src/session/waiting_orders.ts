import type { SwarmEvent } from '../link/messages';
import type { Notices } from './notices';

/** An order that was accepted and that no tick has taken yet. */
interface Waiting {
  readonly type: string;
  readonly notice: number;
  readonly done: string | undefined;
}

/** The orders of this console that wait for a tick. Nothing is said to be done that no tick has taken. */
export class WaitingOrders {
  private orders: readonly Waiting[] = [];

  constructor(private readonly notices: Notices) {}

  /** `isToldByProgram`: its status says what waits, for everybody and as long as it does. */
  add(type: string, why: string, done: string | undefined, isToldByProgram: boolean): void {
    const text = `Waiting: ${why}. Not done yet: ${done ?? type}`;
    const notice = this.notices.notify('warning', text, isToldByProgram ? undefined : null);
    this.orders = [...this.orders, { type, notice, done }];
  }

  /** Nobody will tell any more what became of them. */
  drop(): void {
    for (const one of this.orders) this.notices.dismiss(one.notice);
    this.orders = [];
  }

  /** An order of this console was taken by a tick, or refused by it, which is an event of its own. */
  settle(event: SwarmEvent): void {
    const isRefused = event.source === 'swarm' && event.what === 'refused';
    const found = this.orders.find((one) => isRefused || (event.source === 'operator' && event.what === one.type));
    if (!found) return;
    this.orders = this.orders.filter((one) => one !== found);
    this.notices.dismiss(found.notice);
    if (!isRefused && found.done) this.notices.notify('info', found.done);
  }
}
