import { computed, effect, signal } from '@preact/signals';
import type { Answer } from '../link/console_link';
import type { Snapshot } from '../link/frames';
import type { Why } from '../link/messages';
import type { Editor } from './editor';
import type { Session } from './session';

/** Questions follow each other no faster. */
const kPauseMs = 250;
/** After a refusal nobody asks again before that. */
const kPatienceMs = 2000;

/**
 * Why the selected drone flies as it does: asked for while somebody looks, one question at a time, and anew whenever another
 * tick is shown than the one that was answered of.
 */
export class Reasons {
  /** Somebody looks. */
  readonly isOpen = signal(false);
  readonly answer = signal<Why | null>(null);
  /** Why there is no answer; empty while there is or will be one. */
  readonly problem = signal('');
  /** The id of the drone that is asked about; null: nobody asks. */
  readonly drone = computed<string | null>(() => {
    const selected = [...this.editor.selectedDrones.value];
    const isAsked = this.isOpen.value && this.session.isLive.value && selected.length === 1;
    return isAsked ? (this.session.droneIds.value[selected[0]!] ?? null) : null;
  });

  private newest = 0;
  private isBusy = false;
  private notBeforeMs = 0;

  constructor(
    private readonly session: Session,
    private readonly editor: Editor,
  ) {
    effect(() => {
      void session.mission.value;
      this.begin(this.drone.value);
    });
    session.onSnapshot((snapshot) => this.look(snapshot));
  }

  private begin(drone: string | null): void {
    this.newest++;
    this.isBusy = false;
    this.answer.value = null;
    this.problem.value = '';
    if (drone !== null) this.send(drone);
  }

  private look(snapshot: Snapshot): void {
    const drone = this.drone.peek();
    if (drone === null || this.isBusy || this.session.world.nowMs() < this.notBeforeMs) return;
    if (this.answer.peek()?.tick !== snapshot.tick) this.send(drone);
  }

  private send(drone: string): void {
    const number = ++this.newest;
    this.isBusy = true;
    this.notBeforeMs = this.session.world.nowMs() + kPauseMs;
    void this.session.link.command({ type: 'why', drone }).then((answer) => {
      if (number === this.newest) this.take(answer);
    });
  }

  private take(answer: Answer): void {
    this.isBusy = false;
    if (answer.ok) {
      this.answer.value = answer.why ?? null;
      this.problem.value = '';
    } else if (answer.refused.code !== 'superseded') {
      this.answer.value = null;
      this.problem.value = answer.refused.reason;
      this.notBeforeMs = this.session.world.nowMs() + kPatienceMs;
    }
  }
}
