import { describe, expect, it } from 'vitest';
import { FakeWorld, kHello } from '../testing/fake_world';
import { backOffMs, ConsoleLink, kSilenceMs, type Phase } from './console_link';

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

/** The bytes from `begin` to `end` of a text, as the program sends them. */
function partOf(text: string, begin: number, end: number): ArrayBuffer {
  const part = new TextEncoder().encode(text).subarray(begin, end);
  const bytes = new Uint8Array(24 + part.length);
  const view = new DataView(bytes.buffer);
  view.setUint32(0, 0x56474c31, false);
  view.setUint8(4, 7);
  view.setUint16(6, 24, true);
  view.setUint32(12, part.length, true);
  view.setUint32(16, begin, true);
  view.setUint32(20, text.length, true);
  bytes.set(part, 24);
  return bytes.buffer;
}

describe('console link', () => {
  it('The first message says who is there, and the greeting makes it live', () => {
    const { world, link } = connected();
    expect(world.last.sent[0]).toEqual({ type: 'hello', name: 'Ana', confirms: true });
    expect(link.state.phase).toBe('live');
  });

  it('A try is made in place of the connection that there is: never are two open, however often it is asked for', () => {
    const { world, link } = connected();
    for (let i = 0; i < 3; i++) link.open();
    expect(world.sockets.map((socket) => socket.isClosed)).toEqual([true, true, true, false]);
    world.pass(60_000);
    expect(world.sockets.filter((socket) => !socket.isClosed).length).toBeLessThanOrEqual(1);
  });

  it('An answer reaches the command that it belongs to', async () => {
    const { world, link } = connected();
    const first = link.command({ type: 'land', drones: ['cf1'] });
    const second = link.command({ type: 'land', drones: ['cf2'] });
    const [a, b] = world.last.sent.filter((message) => message['type'] === 'land');
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

  it('Every message is confirmed once it was read, whatever was in it', () => {
    const { world } = connected();
    const confirmed = () =>
      world.last.sent.filter((one) => one['type'] === 'confirm').map((one) => one['received'] as number);
    expect(confirmed()).toEqual([1]);
    world.last.say({ type: 'something_new' });
    world.last.onmessage?.({ data: 'no JSON' });
    world.last.onmessage?.({ data: partOf('{"type":"presence","operators":[]}', 0, 20) });
    expect(confirmed()).toEqual([1, 2, 3, 4]);
  });

  it('A message that comes in parts is taken when its last one is there', () => {
    const { world, types, mistakes } = connected();
    const whole = '{"type":"presence","operators":[]}';
    world.last.onmessage?.({ data: partOf(whole, 0, 20) });
    expect(types).toEqual(['hello']);
    world.last.onmessage?.({ data: partOf(whole, 20, whole.length) });
    expect(types).toEqual(['hello', 'presence']);
    expect(mistakes).toEqual([]);
  });

  it('Commands go out as long as the socket is open, however silent it is', () => {
    const { world, link } = connected();
    world.pass(1.1 * kSilenceMs);
    expect([link.state.phase, link.isConnected]).toEqual(['silent', true]);
    void link.command({ type: 'land_all' });
    expect(world.last.sent.at(-1)).toMatchObject({ type: 'land_all' });
  });

  it('A silent connection over which something comes is not given up', () => {
    const { world } = connected();
    for (let second = 0; second < 30; second++) {
      world.pass(1000);
      world.last.say({ type: 'something_new' });
    }
    expect(world.last.isClosed).toBe(false);
    world.pass(8000);
    expect(world.last.isClosed).toBe(true);
  });

  it('A program that said that it ends has ended, until one greets again', () => {
    const { world, link } = connected();
    world.last.say({ type: 'bye', code: 'ending', reason: 'the program ends' });
    world.last.close();
    expect(link.state).toMatchObject({ phase: 'lost', hasEnded: true });
    world.pass(1000);
    world.last.close();
    expect(link.state.hasEnded).toBe(true);
    link.open();
    world.last.say(kHello);
    expect(link.state).toMatchObject({ phase: 'live', hasEnded: false });
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
