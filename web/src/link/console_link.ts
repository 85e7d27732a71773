import { decodeFrame, FrameError, isFrame, type Frame } from './frames';
import {
  decodeMessage,
  type Ack,
  type Hello,
  type MessageOf,
  type Preview,
  type Refused,
  type ServerMessage,
  type Why,
} from './messages';
import { Parts } from './parts';
import { ProgramClock } from './program_clock';
import { ShapeError } from './shape';

/** The part of a WebSocket that is used here; tests bring their own. */
export interface Socket {
  binaryType: string;
  onopen: (() => void) | null;
  onclose: (() => void) | null;
  onmessage: ((event: { data: unknown }) => void) | null;
  send(text: string): void;
  close(): void;
}

/** What the link needs of the world, so that tests turn its time and its dice. */
export interface World {
  openSocket(): Socket;
  nowMs(): number;
  /** Calls back once after so long; the function returned takes that back. */
  after(ms: number, call: () => void): () => void;
  /** In [0, 1): spreads the reconnects of many consoles over time. */
  random(): number;
}

export type Phase = 'connecting' | 'live' | 'silent' | 'lost' | 'refused';

export interface LinkState {
  readonly phase: Phase;
  /** Why it is not live, for people; empty while it is. */
  readonly reason: string;
  /** The program said that it ends: nothing flies the drones any more, until it is started again. */
  readonly hasEnded: boolean;
  /** When the next try is made (World.nowMs), while lost. */
  readonly retryAtMs: number | null;
}

export type Answer =
  | { readonly ok: true; readonly ack: Ack; readonly preview?: Preview; readonly why?: Why }
  | { readonly ok: false; readonly refused: Refused };
export type Command = { readonly type: string } & Readonly<Record<string, unknown>>;

export interface Listener {
  stateChanged(state: LinkState): void;
  messageCame(message: ServerMessage): void;
  frameCame(frame: Frame): void;
  /** Something came that the protocol does not allow; it was left out. */
  mistakeSeen(what: string): void;
}

/** Silence for longer than this is a broken link, whatever the socket believes: snapshots come 20 times a second. */
export const kSilenceMs = 1500;
const kOpenWithinMs = 8000;
const kAnswerWithinMs = 5000;
const kFirstRetryMs = 400;
const kMostRetryMs = 8000;
/** The program's clock is asked for so often, and more often while it is not well known. */
const kAskClockMs = 2000;
const kAskClockSoonMs = 200;
const kGoodErrorMs = 10;

/** The wait before try number `failures`: doubling, at most 8 s, somewhere between half of it and all. */
export function backOffMs(failures: number, random: number): number {
  const whole = Math.min(kMostRetryMs, kFirstRetryMs * 2 ** Math.min(failures, 10));
  return whole * (0.5 + 0.5 * random);
}

/** One connection that is kept up: decodes what comes, matches answers to commands, notices silence, tries again. */
export class ConsoleLink {
  private socket: Socket | null = null;
  private failures = 0;
  private nextId = 1;
  private cancelTimer: () => void = () => undefined;
  private cancelRetry: () => void = () => undefined;
  private current: LinkState = {
    phase: 'connecting',
    reason: '',
    hasEnded: false,
    retryAtMs: null,
  };
  private readonly waiting = new Map<number, { settle: (answer: Answer) => void; cancel: () => void }>();
  private readonly parts = new Parts();
  /** Of the program that was connected last. */
  readonly clock = new ProgramClock();
  private received = 0;
  private helloAtMs = 0;
  /** The last question for the program's clock; null where none was asked. */
  private asked: { readonly id: number; readonly atMs: number; readonly isAnswered: boolean } | null = null;
  private closing = '';
  private hasEnded = false;

  constructor(
    private readonly world: World,
    private readonly listener: Listener,
    /** What the first message says of this console: name, token, role. */
    private identity: Readonly<Record<string, unknown>>,
  ) {}

  get state(): LinkState {
    return this.current;
  }

  /** Connects, in place of whatever connection there is: never two at once. */
  open(): void {
    this.shut();
    this.closing = '';
    if (this.current.phase !== 'lost') this.change('connecting', '');
    const socket = this.world.openSocket();
    this.socket = socket;
    socket.binaryType = 'arraybuffer';
    this.parts.forget();
    this.received = 0;
    this.asked = null;
    socket.onopen = () => this.introduceTo(socket);
    socket.onmessage = (event) => socket === this.socket && this.read(event.data);
    socket.onclose = () => socket === this.socket && this.dropped();
    this.cancelTimer();
    this.cancelTimer = this.world.after(kOpenWithinMs, () => socket.close());
  }

  /** Says who is at this console, and connects anew with that. */
  introduce(identity: Readonly<Record<string, unknown>>): void {
    this.identity = identity;
    this.shut();
    this.change('connecting', '');
    this.open();
  }

  shut(): void {
    this.cancelTimer();
    this.cancelRetry();
    const socket = this.socket;
    this.socket = null;
    socket?.close();
    this.failWaiting('the connection was closed');
  }

  private introduceTo(socket: Socket): void {
    this.helloAtMs = this.world.nowMs();
    socket.send(JSON.stringify({ type: 'hello', ...this.identity, confirms: true }));
  }

  /** Whether commands can be sent: somebody greeted, and the socket is open, however long it has been silent. */
  get isConnected(): boolean {
    return this.socket !== null && (this.current.phase === 'live' || this.current.phase === 'silent');
  }

  /** Sends a command; the answer is a refusal when nobody answers within 5 s or the link breaks. */
  command(command: Command): Promise<Answer> {
    const id = this.nextId++;
    if (!this.isConnected) return Promise.resolve(refusal(id, 'offline', 'Not connected: nothing was sent.'));
    return new Promise((settle) => {
      const cancel = this.world.after(kAnswerWithinMs, () => {
        this.waiting.delete(id);
        settle(refusal(id, 'no_answer', 'No answer within 5 s. It may have taken effect: look at the drones.'));
      });
      this.waiting.set(id, { settle, cancel });
      this.socket!.send(JSON.stringify({ ...command, id }));
    });
  }

  private read(data: unknown): void {
    if (this.current.phase === 'silent') this.closeLater();
    try {
      this.take(data);
    } catch (error) {
      if (!(error instanceof ShapeError) && !(error instanceof FrameError)) throw error;
      this.listener.mistakeSeen(error.message);
    }
    this.confirm();
  }

  /** After the message was read and used: more than two pictures are never on the way, wherever they would wait. */
  private confirm(): void {
    this.received++;
    if (this.isConnected) this.socket!.send(JSON.stringify({ type: 'confirm', received: this.received }));
  }

  private take(data: unknown): void {
    if (typeof data === 'string') this.handle(decodeMessage(data));
    if (!(data instanceof ArrayBuffer)) return;
    const frame = decodeFrame(data);
    if (frame?.kind !== 'part') return this.handleFrame(frame);
    const whole = this.parts.take(frame);
    if (whole) this.take(isFrame(whole) ? whole : new TextDecoder().decode(whole));
  }

  private handle(message: ServerMessage | null): void {
    if (!message) return;
    if (message.type === 'ack') this.settle(message.id, { ok: true, ack: message });
    else if (message.type === 'preview')
      this.settle(message.id, { ok: true, ack: acknowledged(message, message.revision), preview: message });
    else if (message.type === 'why')
      this.settle(message.id, { ok: true, ack: acknowledged(message, null), why: message });
    else if (message.type === 'refused') this.settle(message.id, { ok: false, refused: message });
    else if (message.type === 'pong') this.toldTime(message);
    else if (message.type === 'bye') this.dismissed(message.code, message.reason);
    else if (message.type === 'hello') this.greeted(message);
    else this.listener.messageCame(message);
  }

  private dismissed(code: string, reason: string): void {
    this.closing = code;
    this.hasEnded = code === 'ending';
    this.change(this.current.phase, reason);
  }

  private greeted(hello: Hello): void {
    this.failures = 0;
    this.clock.forget();
    this.clock.answered(this.helloAtMs, hello.steady_ms, this.world.nowMs());
    this.heard();
    this.listener.messageCame(hello);
  }

  private handleFrame(frame: Frame | null): void {
    if (!frame) return;
    if (frame.kind === 'snapshot') {
      this.heard();
      this.clock.saw(frame.steadyMs, this.world.nowMs());
      this.askClock();
    }
    this.listener.frameCame(frame);
  }

  private askClock(): void {
    const atMs = this.world.nowMs();
    if (this.asked && atMs - this.asked.atMs < this.clockPauseMs(this.asked.isAnswered)) return;
    this.asked = { id: this.nextId++, atMs, isAnswered: false };
    this.socket?.send(JSON.stringify({ type: 'ping', id: this.asked.id }));
  }

  private clockPauseMs(isAnswered: boolean): number {
    if (!isAnswered) return kAnswerWithinMs;
    return this.clock.errorMs(this.world.nowMs()) < kGoodErrorMs ? kAskClockMs : kAskClockSoonMs;
  }

  private toldTime(pong: MessageOf<'pong'>): void {
    if (pong.id !== this.asked?.id) return;
    this.clock.answered(this.asked.atMs, pong.steady_ms, this.world.nowMs());
    this.asked = { ...this.asked, isAnswered: true };
  }

  /** Fresh data came: live, until nothing comes for too long. */
  private heard(): void {
    this.hasEnded = false;
    if (this.current.phase !== 'live') this.change('live', '');
    this.cancelTimer();
    this.cancelTimer = this.world.after(kSilenceMs, () => this.fellSilent());
  }

  private fellSilent(): void {
    this.change('silent', 'The program has sent no picture for a while.');
    this.closeLater();
  }

  private closeLater(): void {
    const socket = this.socket;
    this.cancelTimer();
    this.cancelTimer = this.world.after(kOpenWithinMs, () => socket?.close());
  }

  private dropped(): void {
    this.cancelTimer();
    this.socket = null;
    this.failWaiting('the connection broke before an answer came; look at the drones');
    if (this.closing === 'bad_token' || this.closing === 'no_hello') {
      this.change('refused', this.current.reason);
      return;
    }
    const wait = backOffMs(this.failures++, this.world.random());
    const reason = this.current.reason || 'The connection to the program broke.';
    this.change('lost', reason, this.world.nowMs() + wait);
    this.cancelRetry = this.world.after(wait, () => this.open());
  }

  private settle(id: number | null, answer: Answer): void {
    const waiting = id === null ? undefined : this.waiting.get(id);
    if (!waiting) {
      if (!answer.ok) this.listener.mistakeSeen(answer.refused.reason);
      return;
    }
    this.waiting.delete(id!);
    waiting.cancel();
    waiting.settle(answer);
  }

  private failWaiting(reason: string): void {
    for (const [id, waiting] of this.waiting) {
      waiting.cancel();
      waiting.settle(refusal(id, 'offline', reason));
    }
    this.waiting.clear();
  }

  private change(phase: Phase, reason: string, retryAtMs: number | null = null): void {
    this.current = { phase, reason, hasEnded: this.hasEnded, retryAtMs };
    this.listener.stateChanged(this.current);
  }
}

/** A preview, and what a question brought, is its own acknowledgement. */
const acknowledged = ({ id, tick }: { id: number; tick: number }, revision: number | null): Ack => ({
  type: 'ack',
  id,
  tick,
  pending: false,
  revision,
  refused_drones: null,
  refused_count: null,
});

const refusal = (id: number, code: string, reason: string): Answer => ({
  ok: false,
  refused: { type: 'refused', id, code, reason },
});
