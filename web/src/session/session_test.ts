import { describe, expect, it } from 'vitest';
import { stage } from '../model/staging';
import type { Edit } from '../model/targets';
import { begin, event, settled, snapshotBytes, targetsOf } from '../testing/fake_session';
import { kHello, kMission } from '../testing/fake_world';
import { FleetOrders, kOrders } from './fleet_orders';
import type { Session } from './session';

const weightOf = (session: Session): number => session.draft.value.clusters[0]!.weight;
describe('session', () => {
  it('Another moment of a recording brings its own events and plots, and nothing of them is news', () => {
    const { session, socket } = begin();
    socket.say({ type: 'events', events: [event(1, 'info', 'a'), event(2, 'warning', 'b')] });
    socket.say({ type: 'events', afresh: true, events: [event(1, 'alarm', 'a')] });
    expect(session.events.value.map((one) => one.number)).toEqual([1]);
    expect(session.notices.value).toEqual([]);
    expect(session.series.ofSwarm(0, 'whole')[0].length).toBe(0);
    socket.say({ type: 'events', events: [event(2, 'warning', 'b')] });
    expect(session.notices.value).toHaveLength(1);
  });

  it('A recording takes no orders, but its clock does', () => {
    const { session, socket } = begin();
    expect([session.mayOperate.value, session.mayTurnClock.value]).toEqual([true, true]);
    socket.say({ ...kMission, fleet: 'REPLAY' });
    expect([session.mayOperate.value, session.mayTurnClock.value]).toEqual([false, true]);
  });

  it('A recording is sought through also by who sees it late', async () => {
    const { world, session, socket, sent } = begin();
    socket.say({ ...kMission, fleet: 'REPLAY' });
    world.pass(2000);
    expect(session.isLive.value).toBe(false);
    void session.command({ type: 'seek', time_s: 7.5 });
    await settled();
    expect(sent('seek')).toMatchObject([{ time_s: 7.5 }]);
    expect(session.notices.value).toEqual([]);
  });

  it('A staged edit asks for a ghost, and tells others what is edited', () => {
    const { session, sent, heavier } = begin();
    session.restage(stage(session.staging.value, { what: 'heavier', edits: [heavier] }, 1));
    expect(weightOf(session)).toBe(4);
    expect(sent('preview_density')).toMatchObject([{ based_on: 1, edits: [heavier] }]);
    expect(sent('editing')).toMatchObject([{ what: [{ kind: 'cluster', name: 'east' }] }]);
  });

  it('While one ghost is on its way only the newest draft waits for the next', async () => {
    const { session, socket, sent, heavier } = begin();
    for (const weight of [2, 3, 4])
      session.restage(stage(session.staging.value, { what: '', edits: [{ ...heavier, weight } as Edit] }, 1));
    expect(sent('preview_density')).toHaveLength(1);
    socket.say({ type: 'ack', id: sent('preview_density')[0]!['id'], tick: 1 });
    await settled();
    expect(sent('preview_density')).toHaveLength(2);
    expect(sent('preview_density')[1]!['edits']).toHaveLength(3);
  });

  it.each(['the answer', 'the new targets'])('A commit is seen once, also when %s comes first', async (first) => {
    const { session, socket, sent, editor, heavier } = begin();
    editor.stage('heavier', heavier);
    editor.stage('west', { op: 'add_point', kind: 'cluster', name: 'west', point_m: [1, 1] });
    const names: string[][] = [];
    const stop = session.draft.subscribe((draft) => names.push(draft.clusters.map((cluster) => cluster.name)));
    const done = editor.commit();
    const answer = { type: 'ack', id: sent('edit')[0]!['id'], tick: 1, revision: 2 };
    const targets = targetsOf(2, 4, ['east', 'west']);
    for (const message of first === 'the answer' ? [answer, targets] : [targets, answer]) {
      socket.say(message);
      await settled();
    }
    await done;
    stop();
    expect(session.isStaged.value).toBe(false);
    for (const seen of names) expect(seen).toEqual(['east', 'west']);
  });

  it.each(['the answer', 'the new targets'])(
    'An edit that is made while a commit is under way stays staged, also when %s comes first',
    async (first) => {
      const { session, socket, sent, editor, heavier } = begin();
      editor.stage('heavier', heavier);
      const done = editor.commit();
      editor.stage('west', { op: 'add_point', kind: 'cluster', name: 'west', point_m: [1, 1] });
      const answer = { type: 'ack', id: sent('edit')[0]!['id'], tick: 1, revision: 2 };
      for (const message of first === 'the answer' ? [answer, targetsOf(2, 4)] : [targetsOf(2, 4), answer]) {
        socket.say(message);
        await settled();
      }
      await done;
      expect(session.staging.value).toMatchObject({ basedOn: 2, steps: [{ what: 'west' }] });
      expect(session.draft.value.clusters.map((one) => one.name)).toEqual(['east', 'west']);
      void editor.commit();
      expect(sent('edit')[1]).toMatchObject({ based_on: 2, edits: [{ op: 'add_point', name: 'west' }] });
    },
  );

  it('Who takes back an edit that is being committed is told that it was too late', async () => {
    const { session, socket, sent, editor, heavier } = begin();
    editor.stage('heavier', heavier);
    const done = editor.commit();
    editor.undo();
    socket.say(targetsOf(2, 4));
    socket.say({ type: 'ack', id: sent('edit')[0]!['id'], tick: 1, revision: 2 });
    await done;
    expect(session.staging.value).toMatchObject({ steps: [], undone: [] });
    expect(session.notices.value.map((one) => one.text)).toContain('Committed before you took it back: “heavier”.');
  });

  it('An order under a paused clock is said to wait until a tick has taken it', async () => {
    const { world, session, socket, sent } = begin();
    const said = (): string[] => session.notices.value.map((one) => one.text);
    const stopped = event(2, 'alarm', '', 'operator', 'Ana', 'land_all');
    socket.say({ type: 'events', events: [event(1, 'info', 'begins', 'program')] });
    socket.onmessage?.({ data: snapshotBytes(1, 2, true) });
    void session.command({ type: 'land_all' }, 'LAND ALL: every drone comes down.');
    socket.say({ type: 'ack', id: sent('land_all')[0]!['id'], tick: 2, pending: true });
    await settled();
    expect(said()).toEqual(['Waiting: the clock is paused. Not done yet: LAND ALL: every drone comes down.']);
    for (let i = 0; i < 30; i++) {
      world.pass(1000);
      socket.onmessage?.({ data: snapshotBytes(1, 2, true) });
    }
    expect(said()).toHaveLength(1);
    socket.say({ type: 'events', events: [stopped] });
    expect(said()).toEqual(['LAND ALL: every drone comes down.']);
  });

  it('An order that waited and was refused then is not said to be done', async () => {
    const { session, socket, sent } = begin();
    socket.say({ type: 'events', events: [event(1, 'info', 'begins', 'program')] });
    void session.command(session.forThisFlight({ type: 'land', drones: ['d1'] }), 'Land: d1');
    socket.say({ type: 'ack', id: sent('land')[0]!['id'], tick: 2, pending: true });
    await settled();
    expect(session.notices.value[0]!.text).toBe('Waiting: the next tick is late. Not done yet: Land: d1');
    socket.say({ type: 'events', events: [event(2, 'warning', 'd1 is on the ground', 'swarm', 'Ana', 'refused')] });
    expect(session.notices.value.map((one) => one.text)).toEqual(['d1 is on the ground']);
  });

  it('What waited for a program that was restarted waits no more, and is not said to be done', async () => {
    const { session, socket, sent } = begin();
    void session.command(session.forThisFlight({ type: 'land', drones: ['d1'] }), 'Land: d1');
    socket.say({ type: 'ack', id: sent('land')[0]!['id'], tick: 2, pending: true });
    await settled();
    expect(session.notices.value).toHaveLength(1);
    socket.say({ ...kHello, run: 'other' });
    expect(session.notices.value).toEqual([]);
  });

  it('An order says for which flight it is meant: the one that is shown, not the one that runs since', () => {
    const { session, socket, sent, editor } = begin();
    const hold = { type: 'hold', drones: ['d1'] };
    new FleetOrders(session, editor).to('hold', ['d1']);
    expect(sent('hold')).toMatchObject([{ drones: ['d1'], run: '1f', epoch: 1 }]);
    socket.say({ ...kHello, run: 'other' });
    expect(session.forThisFlight(hold)).toMatchObject({ run: '1f', epoch: 1 });
    socket.say(kMission);
    expect(session.forThisFlight(hold)).toMatchObject({ run: 'other', epoch: 1 });
  });

  it('Undo says what was seen last, and a second one waits for the first', async () => {
    const { socket, sent, editor } = begin();
    socket.say({ ...targetsOf(5, 1), can_undo: true });
    editor.undo();
    editor.undo();
    expect(sent('undo')).toMatchObject([{ based_on: 5 }]);
    socket.say({ ...targetsOf(6, 1), can_undo: true });
    socket.say({ type: 'ack', id: sent('undo')[0]!['id'], tick: 1, revision: 6 });
    await settled();
    editor.undo();
    expect(sent('undo')[1]).toMatchObject({ based_on: 6 });
  });

  it('A refused commit stays staged; after somebody else’s change it is based on what is there now', async () => {
    const { session, socket, sent, editor, heavier } = begin();
    editor.stage('heavier', heavier);
    const done = editor.commit();
    socket.say(targetsOf(2, 2, ['east'], 'Ben'));
    socket.say({ type: 'refused', id: sent('edit')[0]!['id'], code: 'stale', reason: 'Ben changed east' });
    await done;
    expect(session.staging.value).toMatchObject({ basedOn: 2 });
    expect(weightOf(session)).toBe(4);
    expect(session.notices.value.map((notice) => notice.text)).toContain('Ben changed east');
  });

  it('What others remove takes the staged edits of it along, and says so', () => {
    const { session, socket, editor, heavier } = begin();
    editor.stage('heavier', heavier);
    socket.say(targetsOf(2, 1, [], 'Ben'));
    expect(session.isStaged.value).toBe(false);
    expect(session.notices.value[0]?.text).toMatch(/Ben changed what you were editing: dropped “heavier”/);
  });

  it('Frames of another mission are left out', () => {
    const { session, socket } = begin();
    const before = session.snapshot;
    socket.onmessage?.({ data: snapshotBytes(2) });
    expect(session.snapshot).toBe(before);
  });

  it('Old events are history, new ones are said; many at once are said as one', () => {
    const { session, socket } = begin();
    socket.say({ type: 'events', events: [event(1, 'alarm', 'd1 was lost')] });
    expect(session.notices.value).toEqual([]);
    socket.say({ type: 'events', events: [event(2, 'alarm', 'd2 is lost'), event(3, 'info', 'd1 covers')] });
    expect(session.notices.value.map((notice) => notice.text)).toEqual(['d2 is lost']);
    socket.say({ type: 'events', events: [4, 5, 6].map((number) => event(number, 'warning', `d${number} lands`)) });
    expect(session.notices.value.map((notice) => notice.text)).toContain('d4 lands, and 2 more: see the event log.');
    expect(session.events.value).toHaveLength(6);
  });

  it('What another operator does is news and says who; what is done here is not', () => {
    const { session, socket } = begin();
    const say = (...events: unknown[]): void => socket.say({ type: 'events', events });
    const said = (): string[] => session.notices.value.map((notice) => notice.text);
    say(event(1, 'info', 'begins', 'program'));
    say(event(2, 'alarm', 'Ana: emergency_stop all', 'operator', 'Ana', 'emergency_stop'));
    expect(said()).toEqual([]);
    say(
      event(3, 'alarm', '', 'operator', 'Ben', 'emergency_stop'),
      event(4, 'info', '', 'operator', 'Ben', 'land_all'),
    );
    say(event(5, 'info', 'Ben: hold d1', 'operator', 'Ben', 'hold'));
    expect(said()).toEqual([
      'EMERGENCY STOP by Ben: motors off, all drones.',
      'LAND ALL by Ben: every drone comes down.',
      'Ben: hold d1',
    ]);
  });

  it('Where two consoles share a name, what either does is said on both', () => {
    const { session, socket } = begin();
    const ana = (client: number) => ({ client, name: 'Ana', role: 'operator', editing: [] });
    socket.say({ type: 'events', events: [event(1, 'info', 'begins', 'program')] });
    socket.say({ type: 'presence', operators: [ana(1), ana(2)] });
    socket.say({ type: 'events', events: [event(2, 'info', '', 'operator', 'Ana', 'land_all')] });
    expect(session.notices.value).toMatchObject([{ kind: 'alarm', text: 'LAND ALL by Ana: every drone comes down.' }]);
  });

  it('Alarms stay until they are dismissed, whatever else is said meanwhile', () => {
    const { world, session } = begin();
    const first = session.notify('alarm', 'motors off');
    session.notify('alarm', 'd1 is lost');
    for (let i = 0; i < 20; i++) session.notify('warning', `warning ${i}`);
    world.pass(3_600_000);
    expect(session.notices.value.map((notice) => notice.text)).toEqual(['motors off', 'd1 is lost']);
    session.dismiss(first);
    expect(session.notices.value.map((notice) => notice.text)).toEqual(['d1 is lost']);
    session.dismissAlarms();
    expect(session.notices.value).toEqual([]);
  });

  it('What is said twice stands there once', () => {
    const { session } = begin();
    for (const text of ['hold', 'hold', 'land', 'hold']) session.notify('info', text);
    expect(session.notices.value.map((notice) => notice.text)).toEqual(['land', 'hold']);
  });

  it('A message whose time is over is gone', () => {
    const { world, session } = begin();
    session.notify('warning', 'once more', 800);
    world.pass(799);
    expect(session.notices.value).toHaveLength(1);
    world.pass(1);
    expect(session.notices.value).toEqual([]);
  });

  it.each([
    ['nothing covers', 0, false, 'Committed: no drone covers now; those that will follow it.'],
    ['the clock stands', 2, true, 'Committed: the swarm follows once the clock goes on.'],
    ['the swarm flies', 2, false, 'Committed: the swarm follows.'],
  ])('After a commit it is said what becomes of it while %s', async (_, active, isPaused, words) => {
    const { session, socket, sent, editor, heavier } = begin();
    socket.onmessage?.({ data: snapshotBytes(1, active, isPaused, 1000) });
    editor.stage('heavier', heavier);
    const done = editor.commit();
    socket.say({ type: 'ack', id: sent('edit')[0]!['id'], tick: 1, revision: 2 });
    await done;
    expect(session.notices.value.map((notice) => notice.text)).toEqual([words]);
  });

  it('Delete at a corner of a triangle says why it stays, and leaves the whole selected', () => {
    const { session, socket, editor } = begin();
    const road = { name: 'road', outline_m: [[0, 0], [1, 0], [0, 1]] }; // prettier-ignore
    socket.say({ ...targetsOf(2, 1), no_fly: [road] });
    editor.select({ kind: 'no_fly', name: 'road' }, 1);
    editor.remove();
    expect(session.draft.value.no_fly).toHaveLength(1);
    expect(session.notices.value[0]?.text).toMatch(/needs three corners: this one stays.*Delete removes it/);
    editor.remove();
    expect(session.draft.value.no_fly).toEqual([]);
  });

  it('Nothing is staged while the connection is silent', () => {
    const { world, session, editor, heavier } = begin();
    world.pass(2000);
    expect(session.isLive.value).toBe(false);
    expect(editor.stage('heavier', heavier)).toBe(false);
    expect(session.dataAgeS()).toBeGreaterThan(1.9);
  });

  it('The age counts the way to the page, and what the page let lie, by the program’s steady clock', () => {
    const { world, session, socket } = begin();
    world.pass(700);
    socket.onmessage?.({ data: snapshotBytes(1, 2, false, 1000) });
    expect(session.dataAgeS()).toBeCloseTo(0.7);
    world.pass(300);
    expect(session.dataAgeS()).toBeCloseTo(1);
    socket.onmessage?.({ data: snapshotBytes(1, 2, false, 1990) });
    expect(session.dataAgeS()).toBeCloseTo(0.01);
  });

  it('Pictures that keep coming, but old, are not live; they are again once a young one came', () => {
    const { world, session, socket } = begin();
    const come = (ageMs: number): void => {
      world.pass(100);
      socket.onmessage?.({ data: snapshotBytes(1, 2, false, world.now - ageMs) });
    };
    come(1400);
    expect(session.isLive.value).toBe(true);
    come(1600);
    expect([session.isLive.value, session.linkState.value.phase]).toEqual([false, 'live']);
    come(1200);
    expect(session.isLive.value).toBe(false);
    come(900);
    expect(session.isLive.value).toBe(true);
    world.pass(650);
    expect(session.isLive.value).toBe(false);
  });

  it('After a connection broke nothing is live before a young picture came', () => {
    const { world, session, socket } = begin();
    socket.close();
    world.pass(1000);
    world.last.onopen?.();
    world.last.say({ ...kHello, steady_ms: world.now });
    world.last.say(kMission);
    expect([session.isConnected.value, session.isLive.value]).toEqual([true, false]);
    world.last.onmessage?.({ data: snapshotBytes(1, 2, false, world.now) });
    expect(session.isLive.value).toBe(true);
  });

  it('With an old picture drones can be brought down, and nothing else; without a connection not even that', async () => {
    const { world, session, socket, sent, editor } = begin();
    const orders = new FleetOrders(session, editor);
    world.pass(2000);
    for (const order of kOrders) orders.to(order, 'all');
    orders.landAll();
    await settled();
    expect(kOrders.filter((order) => sent(order).length > 0)).toEqual(['land']);
    expect(sent('land_all')).toHaveLength(1);
    expect([orders.may('land'), orders.may('hold')]).toEqual([true, false]);
    socket.close();
    expect([session.mayLand.value, orders.may('land')]).toEqual([false, false]);
  });

  it('An order to land that is not confirmed soon says so, until it is; one that never is becomes an alarm', async () => {
    const { world, session, socket, sent, editor } = begin();
    const orders = new FleetOrders(session, editor);
    const texts = (): string[] => session.notices.value.map((notice) => notice.text);
    orders.landAll();
    world.pass(500);
    expect(texts()).toEqual(['LAND ALL was sent; it is not confirmed yet.']);
    socket.say({ type: 'ack', id: sent('land_all')[0]!['id'], tick: 1 });
    await settled();
    expect(texts()).toEqual(['LAND ALL: every drone comes down.']);
    orders.landAll();
    world.pass(5000);
    await settled();
    expect(session.notices.value).toMatchObject([{ kind: 'alarm' }]);
    expect(texts()[0]).toMatch(/LAND ALL is not confirmed. No answer within 5 s/);
  });

  it.each([
    ['is loaded', { epoch: 2 }],
    [
      'comes with a restarted program',
      { mission: { name: 'test', drones: [{ id: 'd2' }, { id: 'd1' }], stations: null } },
    ],
  ])('When another mission %s nothing chosen or staged reaches it', (_, other) => {
    const { session, socket, editor, heavier } = begin();
    editor.selectDrones([1]);
    editor.take('go-to');
    editor.cursor.value = [1, 1];
    editor.sketch.value = [[1, 1]];
    editor.stage('heavier', heavier);
    editor.select({ kind: 'cluster', name: 'east' });
    socket.say({ ...kMission, ...other });
    expect(editor.selectedDrones.value.size).toBe(0);
    expect(editor.selected.value).toBe(null);
    expect([editor.tool.value, editor.sketch.value, editor.cursor.value]).toEqual(['select', [], null]);
    expect(session.isStaged.value).toBe(false);
    expect(session.notices.value.map((notice) => notice.text)).toEqual([
      'Another mission is flown now: test, after test. Nothing is selected any more. Your staged edit was dropped.',
    ]);
  });

  it('The same mission after a broken connection leaves what is chosen and staged', () => {
    const { session, socket, editor, heavier } = begin();
    editor.selectDrones([1]);
    editor.stage('heavier', heavier);
    socket.say(kMission);
    expect(editor.selectedDrones.value.size).toBe(1);
    expect(session.isStaged.value).toBe(true);
  });
});
