import { Editor } from '../session/editor';
import { Session } from '../session/session';
import type { Edit } from '../model/targets';
import { FakeWorld, kHello, kMission } from './fake_world';

export const targetsOf = (revision: number, weight: number, names = ['east'], by = 'Ana') => ({
  type: 'targets',
  epoch: 1,
  revision,
  by,
  what: '',
  can_undo: false,
  can_redo: false,
  undo_what: '',
  redo_what: '',
  clusters: names.map((name) => ({ name, points_m: [[1, 1]], weight, revisit_s: null, protect: false })),
  areas: [],
  no_fly: [],
  uniform_floor: 0,
});

export const event = (number: number, severity: string, text: string, source = 'swarm', by = '', what = 'landing') => ({
  number,
  tick: 0,
  time_s: 0,
  wall_ms: 0,
  severity,
  source,
  what,
  drone: '',
  was: '',
  by,
  text,
  effect: '',
  next: '', // prettier-ignore
});

/** Two drones at rest, as the program sends them. */
export function snapshotBytes(epoch = 1, active = 2, isPaused = false, steadyMs = 0): ArrayBuffer {
  const bytes = new ArrayBuffer(104 + 16 + 8 + 8 + 3 * 8 + 2 * 4 + 5 * 4);
  const view = new DataView(bytes);
  view.setUint32(0, 0x56474c31, false);
  view.setUint8(4, 1);
  view.setUint8(5, isPaused ? 1 : 0);
  view.setUint16(6, 104, true);
  view.setUint32(8, epoch, true);
  view.setUint32(12, 2, true);
  view.setUint32(72, active, true);
  view.setFloat32(84, 0.001, true);
  view.setFloat64(96, steadyMs, true);
  return bytes;
}

/** A page that has read a mission of two drones and its first targets, live. */
export function begin() {
  const world = new FakeWorld();
  const session = new Session(world, {});
  session.link.open();
  const socket = world.last;
  socket.onopen?.();
  for (const message of [kHello, kMission, targetsOf(1, 1)]) socket.say(message);
  socket.onmessage?.({ data: snapshotBytes() });
  world.pass(1); // beats are counted from 0
  world.now = 1000;
  socket.onmessage?.({ data: snapshotBytes(1, 2, false, 1000) });
  const sent = (type: string) => socket.sent.filter((message) => message['type'] === type);
  const heavier: Edit = { op: 'set_weight', kind: 'cluster', name: 'east', weight: 4 };
  const editor = new Editor(session, () => undefined);
  return { world, session, socket, sent, heavier, editor };
}

export const settled = async (): Promise<void> => {
  for (let i = 0; i < 5; i++) await Promise.resolve();
};
