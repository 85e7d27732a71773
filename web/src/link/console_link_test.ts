import { describe, expect, it } from 'vitest';
import { backOffMs, ConsoleLink, kSilenceMs, type Phase, type Socket, type World } from './console_link';

const kHello = {
  type: 'hello',
  protocol: 1,
  program: 'vigil 0.1.0',
  client: 1,
  name: 'Ana',
  role: 'operator',
  roles: ['viewer', 'operator'],
  login: false,
};

/** A world whose time the test turns. */
class FakeWorld implements World {
  now = 0;
  sockets: FakeSocket[] = [];
  private timers: { at: number; call: () => void }[] = [];

  openSocket(): Socket {
    const socket = new FakeSocket();
    this.sockets.push(socket);
    return socket;
  }
  nowMs = (): number => this.now;
  random = (): number => 0;
  after(ms: number, call: () => void): () => void {
    const timer = { at: this.now + ms, call };
    this.timers.push(timer);
    return () => (this.timers = this.timers.filter((other) => other !== timer));
  }
  pass(ms: number): void {
    const end = this.now + ms;
    for (;;) {
      const due = this.timers.filter((timer) => timer.at <= end).sort((a, b) => a.at - b.at)[0];
      if (!due) break;
      this.timers = this.timers.filter((other) => other !== due);
      this.now = due.at;
      due.call();
    }
    this.now = end;
  }
  get last(): FakeSocket {
    return this.sockets[this.sockets.length - 1]!;
  }
}

class FakeSocket implements Socket {
  binaryType = '';
  sent: Record<string, unknown>[] = [];
  isClosed = false;
  onopen: (() => void) | null = null;
  onclose: (() => void) | null = null;
  onmessage: ((event: { data: unknown }) => void) | null = null;
  send(text: string): void {
    this.sent.push(JSON.parse(text) as Record<string, unknown>);
  }
  close(): void {
    if (this.isClosed) return;
    this.isClosed = true;
    this.onclose?.();
  }
  say(message: unknown): void {
    this.onmessage?.({ data: JSON.stringify(message) });
  }
}

function connected() {
  const world = new FakeWorld();
  const phases: Phase[] = [];
  const mistakes: string[] = [];
  const types: string[] = [];
  const link = new ConsoleLink(
    world,
    {
      stateChanged: (state) => phases.push(state.phase),
      messageCame: (message) => types.push(message.type),
      frameCame: () => undefined,
      mistakeSeen: (what) => mistakes.push(what),
    },
    { name: 'Ana' },
  );
  link.open();
  world.last.onopen?.();
  world.last.say(kHello);
  return { world, link, phases, mistakes, types };
}

describe('console link', () => {
  it('The first message says who is there, and the greeting makes it live', () => {
    const { world, link } = connected();
    expect(world.last.sent).toEqual([{ type: 'hello', name: 'Ana' }]);
    expect(link.state.phase).toBe('live');
  });

  it('An answer reaches the command that it belongs to', async () => {
    const { world, link } = connected();
    const first = link.command({ type: 'land', drones: ['cf1'] });
    const second = link.command({ type: 'land', drones: ['cf2'] });
    const [, a, b] = world.last.sent;
    world.last.say({ type: 'refused', id: b!['id'], code: 'not_now', reason: 'cf2 is on the ground' });
    world.last.say({ type: 'ack', id: a!['id'], tick: 7 });
    expect(await first).toMatchObject({ ok: true, ack: { tick: 7 } });
    expect(await second).toMatchObject({ ok: false, refused: { reason: 'cf2 is on the ground' } });
  });

  it('A command that nobody answers is a refusal that says it may have taken effect', async () => {
    const { world, link } = connected();
    const answer = link.command({ type: 'land_all' });
    world.pass(6000);
    expect(await answer).toMatchObject({ ok: false, refused: { code: 'no_answer' } });
  });

  it('Silence is not live, though the socket is open', () => {
    const { world, link } = connected();
    world.pass(0.9 * kSilenceMs);
    expect(link.state.phase).toBe('live');
    world.pass(0.2 * kSilenceMs);
    expect(link.state.phase).toBe('silent');
  });

  it('A broken link tries again, waits longer each time, and is live again', () => {
    const { world, link, phases } = connected();
    world.last.close();
    expect(link.state).toMatchObject({ phase: 'lost', retryAtMs: backOffMs(0, 0) });
    world.pass(backOffMs(0, 0));
    expect(world.sockets).toHaveLength(2);
    world.last.close();
    world.pass(backOffMs(1, 0) - 1);
    expect(world.sockets).toHaveLength(2);
    world.pass(1);
    expect(world.sockets).toHaveLength(3);
    world.last.onopen?.();
    world.last.say(kHello);
    expect(phases).toEqual(['connecting', 'live', 'lost', 'lost', 'live']);
  });

  it('Waits double up to 8 s and are spread by chance', () => {
    expect([0, 1, 2, 20].map((n) => backOffMs(n, 0))).toEqual([200, 400, 800, 4000]);
    expect(backOffMs(20, 0.999)).toBeLessThanOrEqual(8000);
  });

  it('A wrong token is not tried again until somebody enters another', () => {
    const { world, link } = connected();
    world.last.say({ type: 'bye', code: 'bad_token', reason: 'That token is not known here.' });
    world.last.close();
    world.pass(60_000);
    expect(world.sockets).toHaveLength(1);
    expect(link.state).toMatchObject({ phase: 'refused', reason: 'That token is not known here.' });
    link.introduce({ token: 'another' });
    expect(world.sockets).toHaveLength(2);
  });

  it('What the protocol does not allow is left out and reported, and breaks nothing', () => {
    const { world, link, mistakes, types } = connected();
    world.last.onmessage?.({ data: '{"type":"events","events":7}' });
    world.last.onmessage?.({ data: 'no JSON' });
    world.last.onmessage?.({ data: new ArrayBuffer(3) });
    world.last.say({ type: 'something_new' });
    expect(mistakes).toHaveLength(3);
    expect(types).toEqual(['hello']);
    expect(link.state.phase).toBe('live');
  });

  it('Nothing is sent while not connected', async () => {
    const { world, link } = connected();
    world.last.close();
    const before = world.last.sent.length;
    expect(await link.command({ type: 'land_all' })).toMatchObject({ ok: false, refused: { code: 'offline' } });
    expect(world.last.sent).toHaveLength(before);
  });
});
