import { beforeEach, describe, expect, it } from 'vitest';
import type { Snapshot } from '../link/frames';
import { FakeWorld, kHello, kMission } from '../testing/fake_world';
import { Editor } from './editor';
import { Reasons } from './reasons';
import { Session } from './session';

const answerTo = (id: unknown, tick: number, drone = 'd1') => ({
  type: 'why',
  id,
  epoch: 1,
  tick,
  time_s: 0.02 * tick,
  drone,
  activity: 'active',
  u_max_m_s: 0.3,
  u_nom_m_s: [0.3, null],
  u_m_s: [0.1, 0],
  changed_m_s: 0.2,
  speed_limited: false,
  margin_used: false,
  fallback: false,
  rows: [],
});

let world: FakeWorld;
let session: Session;
let editor: Editor;
let reasons: Reasons;
let listeners: ((snapshot: Snapshot) => void)[];

const asked = () => world.last.sent.filter((message) => message['type'] === 'why');
const newest = () => asked()[asked().length - 1]!['id'];
const show = (tick: number) => listeners.forEach((listener) => listener({ tick } as Snapshot));
const answered = async (message: unknown) => {
  world.last.say(message);
  for (let n = 0; n < 4; n++) await Promise.resolve();
};

beforeEach(() => {
  world = new FakeWorld();
  session = new Session(world, {});
  listeners = [];
  session.onSnapshot = (listener) => {
    listeners.push(listener);
    return () => undefined;
  };
  editor = new Editor(session, () => undefined);
  reasons = new Reasons(session, editor);
  session.link.open();
  world.last.onopen?.();
  world.last.say(kHello);
  world.last.say(kMission);
  session.hasSnapshot.value = true;
});

describe('the reasons for a velocity', () => {
  it('Nobody asks but for one selected drone, while somebody looks', () => {
    show(1);
    reasons.isOpen.value = true;
    editor.selectDrones([0, 1]);
    show(2);
    expect(asked()).toEqual([]);
    editor.selectDrones([1]);
    expect(asked()).toMatchObject([{ drone: 'd2' }]);
    reasons.isOpen.value = false;
    world.pass(1000);
    show(3);
    expect(asked().length).toBe(1);
  });

  it('The next question waits for the answer, for another tick and for a quarter of a second', async () => {
    reasons.isOpen.value = true;
    editor.selectDrones([0]);
    world.pass(1000);
    show(5);
    expect(asked().length).toBe(1);
    await answered(answerTo(newest(), 5));
    expect(reasons.answer.value).toMatchObject({ tick: 5, u_nom_m_s: [0.3, NaN] });
    show(5);
    expect(asked().length).toBe(1);
    show(6);
    expect(asked().length).toBe(2);
    await answered(answerTo(newest(), 6));
    show(7);
    expect(asked().length).toBe(2);
    world.pass(250);
    show(8);
    expect(asked().length).toBe(3);
  });

  it('What comes of a drone that is no longer selected is not shown', async () => {
    reasons.isOpen.value = true;
    editor.selectDrones([0]);
    const older = newest();
    editor.selectDrones([1]);
    await answered(answerTo(older, 5));
    expect(reasons.answer.value).toBeNull();
    await answered(answerTo(newest(), 5, 'd2'));
    expect(reasons.answer.value?.drone).toBe('d2');
  });

  it('A refusal is shown, and nobody insists for a while', async () => {
    reasons.isOpen.value = true;
    editor.selectDrones([0]);
    await answered({ type: 'refused', id: newest(), code: 'not_now', reason: 'it cannot be recomputed' });
    expect(reasons.problem.value).toBe('it cannot be recomputed');
    world.pass(1000);
    show(9);
    expect(asked().length).toBe(1);
    world.last.say(kHello); // the program is still there
    world.pass(1000);
    show(9);
    expect(asked().length).toBe(2);
  });
});
