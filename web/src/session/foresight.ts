import { computed, effect, signal } from '@preact/signals';
import type { Answer } from '../link/console_link';
import type { Preview } from '../link/messages';
import { editsOf } from '../model/staging';
import type { Editor } from './editor';
import type { Session } from './session';

/** How far this console looks ahead, s. */
export const kAheadS = 60;
/** While somebody drags, questions are asked no oftener. */
const kPauseMs = 200;
/** An answer is asked for anew when it is so old; later where it took long to find. */
const kFreshMs = 2000;

/**
 * What the swarm would do: asked for while edits are staged, and while somebody wants to know (W). The newest answer counts;
 * the program gives up on older questions by itself.
 */
export class Foresight {
  /** Somebody wants to see what is ahead, edits or not. */
  readonly isOn = signal(false);
  readonly answer = signal<Preview | null>(null);
  /** Why there is no answer; empty while there is or will be one. */
  readonly problem = signal('');
  readonly isWanted = computed(() => this.session.isLive.value && (this.isOn.value || this.session.isStaged.value));
  /** The drones that are to be missing: those that are selected, while somebody wants to know. */
  readonly without = computed<readonly string[]>(() =>
    this.isOn.value
      ? [...this.editor.selectedDrones.value].flatMap((drone) => this.session.droneIds.value[drone] ?? [])
      : [],
  );
  /** What the newest answer answers. */
  readonly answered = signal<{ readonly edits: number; readonly without: readonly string[] }>({
    edits: 0,
    without: [],
  });

  private newest = 0;
  private isPausing = false;
  private isAskedAgain = false;
  private cancelRefresh: () => void = () => undefined;

  constructor(
    private readonly session: Session,
    private readonly editor: Editor,
  ) {
    effect(() => {
      for (const read of [session.staging, session.mission, this.without]) void read.value;
      if (this.isWanted.value) this.ask();
      else this.forget();
    });
  }

  toggle(): void {
    if (this.session.isRecording.value && !this.isOn.value) {
      this.session.notify('info', 'This is a recording: play it to see what came.');
      return;
    }
    this.isOn.value = !this.isOn.value;
  }

  private forget(): void {
    this.newest++;
    this.cancelRefresh();
    this.answer.value = null;
    this.problem.value = '';
  }

  /** Now, or, shortly after the last question, with what is wanted then. */
  private ask(): void {
    if (this.isPausing) {
      this.isAskedAgain = true;
      return;
    }
    this.isPausing = true;
    this.session.world.after(kPauseMs, () => {
      this.isPausing = false;
      if (!this.isAskedAgain) return;
      this.isAskedAgain = false;
      if (this.isWanted.peek()) this.ask();
    });
    this.send();
  }

  private send(): void {
    const staging = this.session.staging.peek();
    const edits = editsOf(staging);
    const without = this.without.peek();
    const number = ++this.newest;
    const sentMs = this.session.world.nowMs();
    this.cancelRefresh();
    const command = {
      type: 'preview',
      seconds: kAheadS,
      ...(edits.length > 0 ? { based_on: this.session.targets.peek()?.revision ?? 0, edits } : {}),
      ...(without.length > 0 ? { without } : {}),
    };
    void this.session.link.command(command).then((answer) => {
      if (number === this.newest) this.take(answer, edits.length, without, sentMs);
    });
  }

  private take(answer: Answer, edits: number, without: readonly string[], sentMs: number): void {
    const { world } = this.session;
    if (answer.ok) {
      this.answer.value = answer.preview ?? null;
      this.answered.value = { edits, without };
      this.problem.value = '';
    } else if (answer.refused.code !== 'superseded') {
      this.answer.value = null;
      this.problem.value = answer.refused.reason;
    }
    const tookMs = world.nowMs() - sentMs;
    this.cancelRefresh = world.after(Math.max(kFreshMs, 3 * tookMs), () => {
      if (this.isWanted.peek()) this.ask();
    });
  }
}
