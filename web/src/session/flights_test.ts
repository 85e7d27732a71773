import { describe, expect, it } from 'vitest';
import { begin, event, settled, snapshotBytes, targetsOf } from '../testing/fake_session';
import { kHello, kMission } from '../testing/fake_world';
import { FleetOrders } from './fleet_orders';

/** One flight after another in the same page: by a mission that is loaded, or a program that is started again. */

const texts = ({ session }: ReturnType<typeof begin>): string[] => session.notices.value.map((one) => one.text);

/** The program was started again; it flies a mission that looks the same, as it always says first. */
function restart({ socket }: ReturnType<typeof begin>): void {
  for (const message of [{ ...kHello, run: 'other' }, kMission, targetsOf(1, 1)]) socket.say(message);
}

describe('another flight', () => {
  it('A restarted program is told, and nothing chosen or staged reaches its flight, though it looks the same', async () => {
    const page = begin();
    const { session, editor, sent, heavier } = page;
    editor.selectDrones([1]);
    editor.take('point');
    editor.stage('heavier', heavier);
    restart(page);
    expect(editor.selectedDrones.value.size).toBe(0);
    expect([editor.tool.value, session.isStaged.value, session.hasSnapshot.value]).toEqual(['select', false, false]);
    expect(session.notices.value).toMatchObject([
      {
        kind: 'alarm',
        text: 'The program was restarted and flies test again. Nothing is selected any more. Your staged edit was dropped.',
      },
    ]);
    await editor.commit();
    expect(sent('edit')).toEqual([]);
  });

  it('What was told of the drones before goes with their flight; an order that was not confirmed does not', async () => {
    const page = begin();
    const { world, session, socket, editor } = page;
    socket.say({ type: 'events', events: [event(1, 'info', 'begins', 'program')] });
    socket.say({ type: 'events', events: [event(2, 'alarm', 'd2 is marked as failed')] });
    socket.say({ type: 'events', events: [event(3, 'alarm', '', 'operator', 'Ben', 'emergency_stop')] });
    new FleetOrders(session, editor).landAll();
    world.pass(5000);
    await settled();
    restart(page);
    expect(texts(page)).toEqual([
      expect.stringMatching(/^LAND ALL is not confirmed/),
      'The program was restarted and flies test again. Nothing is selected any more. The 2 alarms of before are in the event log.',
    ]);
  });

  it('What a restarted program tells first is news, and stands in the log beside what was before', () => {
    const page = begin();
    const { session, socket } = page;
    socket.say({ type: 'events', events: [7, 8, 9].map((number) => event(number, 'info', `before ${number}`)) });
    restart(page);
    socket.say({ type: 'events', events: [event(1, 'info', 'begins', 'program'), event(2, 'alarm', 'd1 is lost')] });
    expect(texts(page)).toContain('d1 is lost');
    expect(session.events.value.map((one) => [one.run, one.number])).toEqual([
      ['1f', 7],
      ['1f', 8],
      ['1f', 9],
      ['other', 1],
      ['other', 2],
    ]);
    expect(session.events.value.map((one) => session.isOfThisFlight(one))).toEqual([false, false, false, true, true]);
  });

  it('What comes again after a broken connection stands in the log once', () => {
    const { session, socket } = begin();
    socket.say({ type: 'events', events: [1, 2].map((number) => event(number, 'info', '')) });
    socket.say(kHello);
    socket.say(kMission);
    socket.say({ type: 'events', events: [1, 2, 3].map((number) => event(number, 'alarm', `d${number} lands`)) });
    expect(session.events.value.map((one) => one.number)).toEqual([1, 2, 3]);
    expect(session.notices.value.map((one) => one.text)).toEqual(['d3 lands']);
  });

  it('An event is of the flight that it names; the next mission’s timeline has none of the one before', () => {
    const { session, socket } = begin();
    const beginning = { ...event(1, 'info', 'the program begins'), epoch: 0 };
    const one = { ...event(2, 'info', 'one'), epoch: 1 };
    socket.say({ type: 'events', events: [beginning, one, event(3, 'info', 'unsaid')] });
    expect(session.events.value.map((each) => session.isOfThisFlight(each))).toEqual([true, true, true]);
    socket.say({ ...kMission, epoch: 2 });
    socket.say({
      type: 'events',
      events: [
        { ...event(4, 'info', 'late'), epoch: 1 },
        { ...event(5, 'info', 'two'), epoch: 2 },
      ],
    });
    const own = session.events.value.filter((one) => session.isOfThisFlight(one));
    expect(own.map((one) => one.text)).toEqual(['two']);
  });

  it('A status of the mission before is left out, and what it told of the areas is gone with that', () => {
    const { session, socket } = begin();
    const status = { type: 'status', epoch: 1, areas: [], lost_events: 0, clients: 1, waits_for_resume: true };
    socket.say(status);
    expect(session.status.value?.epoch).toBe(1);
    socket.say({ ...kMission, epoch: 2 });
    expect(session.status.value).toBe(null);
    socket.say(status);
    expect(session.status.value).toBe(null);
  });
});

describe('edits', () => {
  it('Edits and steps back say for which flight they are meant', async () => {
    const { socket, sent, editor, heavier } = begin();
    socket.say({ ...targetsOf(5, 1), can_undo: true, can_redo: true });
    editor.undo();
    socket.say({ type: 'ack', id: sent('undo')[0]!['id'], tick: 1, revision: 6 });
    await settled();
    editor.redo();
    editor.stage('heavier', heavier);
    void editor.commit();
    for (const type of ['undo', 'redo', 'edit']) expect(sent(type)).toMatchObject([{ run: '1f', epoch: 1 }]);
  });

  it.each([
    ['refused', { type: 'refused', code: 'stale', reason: 'another mission is flown' }, 'another mission is flown'],
    [
      'committed to the one before',
      { type: 'ack', tick: 1, revision: 2 },
      'Your edit was committed to the flight before; the one that is shown now does not have it.',
    ],
  ])('While a commit was under way another flight began: it is said that it was %s', async (_, answer, words) => {
    const page = begin();
    const { world, session, socket, sent, editor, heavier } = page;
    editor.stage('heavier', heavier);
    const done = editor.commit();
    socket.say({ ...kMission, epoch: 2 });
    socket.say({ ...targetsOf(1, 3), epoch: 2 });
    socket.say({ ...answer, id: sent('edit')[0]!['id'] });
    await done;
    expect(texts(page)).toContain(words);
    expect(texts(page).join()).not.toMatch(/Committed:/);
    expect(session.targets.value).toMatchObject({ epoch: 2, revision: 1 });
    // What is staged next is about the new targets, whatever the old revision was.
    world.pass(300);
    socket.onmessage?.({ data: snapshotBytes(2, 2, false, 1300) });
    editor.stage('heavier', heavier);
    socket.say({ ...targetsOf(2, 3, ['east'], 'Ben'), epoch: 2 });
    expect(session.staging.value.steps).toHaveLength(1);
  });

  it('Who types a place outside of the field is told that it was put on its edge', () => {
    const page = begin();
    const { session, editor } = page;
    const east = { kind: 'cluster', name: 'east' } as const;
    editor.reshape(east, [[1, 1]], [-6, 0], 1, false);
    expect(session.draft.value.clusters[0]!.points_m).toEqual([[0, 1]]);
    expect(texts(page)).toEqual(['That is outside of the field: it was put on its edge (east).']);
    editor.movePoint(east, 0, [1, 99], true);
    editor.movePoint(east, 0, [1, 2], false);
    expect(texts(page)).toHaveLength(1);
  });
});

describe('orders that wait', () => {
  const status = { type: 'status', epoch: 1, areas: [], lost_events: 0, clients: 1, waits_for_resume: false };

  it('They are never pushed out by what is said later', async () => {
    const page = begin();
    const { session, socket, sent } = page;
    void session.command({ type: 'land_all' }, 'LAND ALL');
    socket.say({ type: 'ack', id: sent('land_all')[0]!['id'], tick: 2, pending: true });
    await settled();
    for (let i = 0; i < 20; i++) session.notify('warning', `warning ${i}`);
    expect(texts(page)[0]).toMatch(/Not done yet: LAND ALL/);
  });

  it('Where the program’s status tells of them the page’s own word of it goes by itself', async () => {
    const page = begin();
    const { world, session, socket, sent } = page;
    socket.say({ ...status, waiting: [{ text: 'LAND ALL', from: 'Ana' }], waiting_more: 2 });
    expect(session.status.value).toMatchObject({ waiting: [{ text: 'LAND ALL', from: 'Ana' }], waiting_more: 2 });
    void session.command({ type: 'land_all' }, 'LAND ALL');
    socket.say({ type: 'ack', id: sent('land_all')[0]!['id'], tick: 2, pending: true });
    await settled();
    expect(texts(page)).toHaveLength(1);
    world.pass(9000);
    expect(texts(page)).toEqual([]);
  });
});

it('Of many drones that could not, three are named, all are counted, and the rest are said to do it', async () => {
  const page = begin();
  const { session, socket, sent } = page;
  void session.command({ type: 'hold', drones: 'all' }, 'Hold: all drones');
  const refused_drones = [1, 2, 3, 4].map((n) => ({ drone: `d${n}`, reason: `d${n} is on the ground` }));
  socket.say({ type: 'ack', id: sent('hold')[0]!['id'], tick: 2, refused_drones, refused_count: 39 });
  await settled();
  expect(texts(page)).toEqual([
    'Hold: all drones, but not 39 of them: d1 is on the ground; d2 is on the ground; d3 is on the ground; and 36 more',
  ]);
});
