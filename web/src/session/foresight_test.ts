import { beforeEach, describe, expect, it } from 'vitest';
import { FakeWorld, kHello, kMission } from '../testing/fake_world';
import { Editor } from './editor';
import { Foresight } from './foresight';
import { Session } from './session';

const outlook = { in_s: [0], metric_percent: [5], worst_age_s: [1], areas: [], least_pair_m: null, active: 2 };
const answerTo = (id: unknown, more = {}) => ({
  type: 'preview',
  id,
  epoch: 1,
  revision: 1,
  tick: 9,
  time_s: 1,
  seconds: 60,
  as_is: outlook,
  what_if: null,
  ghosts: { spacing_s: 1, xy_m: [] },
  ...more,
});

let world: FakeWorld;
let session: Session;
let editor: Editor;
let foresight: Foresight;

const asked = () => world.last.sent.filter((message) => message['type'] === 'preview');
const settled = async () => {
  for (let n = 0; n < 4; n++) await Promise.resolve();
};

beforeEach(() => {
  world = new FakeWorld();
  session = new Session(world, {});
  editor = new Editor(session, () => undefined);
  foresight = new Foresight(session, editor);
  session.link.open();
  world.last.onopen?.();
  world.last.say(kHello);
  world.last.say(kMission);
  session.hasSnapshot.value = true;
});

describe('a look ahead', () => {
  it('Nobody asks while nobody wants to know', () => {
    expect(asked()).toEqual([]);
    foresight.toggle();
    expect(asked()).toMatchObject([{ seconds: 60 }]);
    expect(Object.keys(asked()[0]!)).not.toContain('edits');
  });

  it('Staged edits are asked about by themselves', () => {
    editor.addPoints([[1, 1]]);
    expect(asked()[0]).toMatchObject({ edits: [{ op: 'add_point', point_m: [1, 1] }] });
  });

  it('The selected drones are missing only where somebody wants to know', () => {
    editor.selectDrones([1]);
    expect(asked()).toEqual([]);
    foresight.toggle();
    expect(asked()[0]).toMatchObject({ without: ['d2'] });
  });

  it('Many changes in a moment are two questions: the first and the last', () => {
    foresight.toggle();
    for (const drones of [[0], [1], [0, 1]]) editor.selectDrones(drones);
    expect(asked().length).toBe(1);
    world.pass(200);
    expect(asked().map((message) => message['without'])).toEqual([undefined, ['d1', 'd2']]);
  });

  it('Only the newest answer counts', async () => {
    foresight.toggle();
    world.pass(200);
    editor.selectDrones([1]);
    const [older, newer] = asked();
    world.last.say(answerTo(older!['id'], { time_s: 1 }));
    await settled();
    expect(foresight.answer.value).toBe(null);
    world.last.say(answerTo(newer!['id'], { time_s: 2 }));
    await settled();
    expect(foresight.answer.value?.time_s).toBe(2);
    expect(foresight.answered.value.without).toEqual(['d2']);
  });

  it('An answer is asked for anew while it is wanted, and gone when it is not', async () => {
    foresight.toggle();
    world.last.say(answerTo(asked()[0]!['id']));
    await settled();
    world.last.say(kHello); // the link stays alive
    world.pass(1400);
    world.last.say(kHello);
    world.pass(700);
    expect(asked().length).toBe(2);
    foresight.toggle();
    expect(foresight.answer.value).toBe(null);
    world.pass(1000);
    expect(asked().length).toBe(2);
  });

  it('A refusal says why; one that is superseded says nothing', async () => {
    foresight.toggle();
    world.last.say({ type: 'refused', id: asked()[0]!['id'], code: 'not_now', reason: 'the flight has ended' });
    await settled();
    expect(foresight.problem.value).toBe('the flight has ended');
    world.pass(200);
    editor.selectDrones([0]);
    world.last.say({ type: 'refused', id: asked()[1]!['id'], code: 'superseded', reason: 'newer' });
    await settled();
    expect(foresight.problem.value).toBe('the flight has ended');
  });
});
