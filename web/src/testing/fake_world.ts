import type { Socket, World } from '../link/console_link';

export const kHello = {
  type: 'hello',
  protocol: 1,
  program: 'vigil 0.1.0',
  client: 1,
  name: 'Ana',
  role: 'operator',
  roles: ['viewer', 'operator'],
  login: false,
  run: '1f',
  steady_ms: 0,
};

/** A mission of two drones. */
export const kMission = {
  type: 'mission',
  epoch: 1,
  fleet: 'SIM',
  mission: { name: 'test', drones: [{ id: 'd1' }, { id: 'd2' }], stations: null },
  display: {
    field: { length_x_m: 3, length_y_m: 3, origin_m: [0, 0], yaw_rad: 0 },
    dt_s: 0.02,
    separation_m: 0.2,
    wall_distance_m: 0.17,
    barrier_radius_m: 0.2,
    speed_limit_m_s: 0.3,
    footprint_radius_m: 0.3,
    sigma_min_m: 0.15,
    can_change_speed: true,
    can_pause: true,
    most_speed: 20,
  },
};

/** A world whose time the test turns. */
export class FakeWorld implements World {
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

/** The program's end of it is played by the test: `say` and `close`. */
export class FakeSocket implements Socket {
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
