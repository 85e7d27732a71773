import type { Page, WebSocketRoute } from 'playwright-core';
import { densityBytes, snapshotBytes, type DroneState, type Holding } from './frame_bytes';

/**
 * The program's side of the protocol, played by the test inside the page's own browser: for what a simulated flight cannot
 * be asked for at will (ten thousand drones, a lost link, a restarted program). Tests only.
 */
export class FakeProgram {
  readonly received: Record<string, unknown>[] = [];
  private socket: WebSocketRoute | null = null;
  private tick = 0;
  /** Takes connections but says nothing. */
  isMute = false;
  missionName = 'played';
  /** Another one is another run of the program. */
  run = '1f';
  idOf = (drone: number): string => `d${drone + 1}`;
  /** Of the field, in the world, m. */
  origin: readonly [number, number] = [0, 0];
  /** Attention that is spread evenly; with 0 and no targets nothing is watched. */
  uniformFloor = 0.5;
  greetings = 0;
  /** Where drones are charged. */
  stations: readonly { name: string; pads_m: readonly (readonly [number, number])[] }[] = [];
  drones: DroneState[];
  holding: Holding[] = [];

  constructor(
    count: number,
    readonly size: readonly [number, number],
  ) {
    this.drones = Array.from({ length: count }, (_, i) => this.placed(i, count));
  }

  /** A sunflower over the field: even, and no two at one place. */
  private placed(i: number, count: number): DroneState {
    const radius = 0.46 * Math.sqrt((i + 0.5) / count);
    const angle = 2.399963 * i;
    const [x, y] = [(0.5 + radius * Math.cos(angle)) * this.size[0], (0.5 + radius * Math.sin(angle)) * this.size[1]];
    return { x, y, vx: -0.3 * Math.sin(angle), vy: 0.3 * Math.cos(angle), activity: 0, mode: 3, battery: 0.8 };
  }

  async attach(page: Page): Promise<void> {
    await page.routeWebSocket('**/live', (socket) => {
      this.socket = socket;
      socket.onMessage((text) => this.answer(JSON.parse(String(text)) as Record<string, unknown>));
    });
  }

  private answer(message: Record<string, unknown>): void {
    this.received.push(message);
    if (this.isMute) return;
    if (message['type'] === 'hello') this.greet();
    else if (message['type'] === 'confirm') return;
    else if (message['type'] === 'ping') this.say({ type: 'pong', id: message['id'], steady_ms: performance.now() });
    else this.say({ type: 'ack', id: message['id'], tick: this.tick, pending: false, revision: 1 });
  }

  say(message: unknown): void {
    this.socket?.send(JSON.stringify(message));
  }

  hangUp(): void {
    void this.socket?.close();
  }

  sayStatus(more: Record<string, unknown>): void {
    const area = (
      kind: string,
      name: string,
      age_s: number,
      deadline_s: number | null,
      asked: number,
      achieved: number,
    ) => ({
      kind,
      name,
      age_s,
      worst_s: 14,
      deadline_s,
      is_overdue: deadline_s !== null && age_s > deadline_s,
      asked,
      achieved, // prettier-ignore
    });
    this.say({
      type: 'status',
      epoch: 1,
      areas: [area('cluster', 'east', 3.2, 30, 0.31, 0.28), area('area', 'ridge', 34, 30, 0.4, 0.35)],
      recording: { folder: 'out/played', ticks: 1200, lost_ticks: 0 },
      lost_events: 0,
      clients: 1,
      lateness_us: { p50: 60, p99: 210, p999: 400, max: 900 },
      waits_for_resume: false,
      ...more,
    });
  }

  sayTargets(): void {
    this.say({
      ...this.emptyTargets(),
      revision: 2,
      clusters: [{ name: 'east', points_m: [[2.2, 1.6], [2.4, 1.8], [2.3, 1.4]], weight: 2, revisit_s: 30, protect: false }], // prettier-ignore
      areas: [{ name: 'ridge', outline_m: [[0.4, 2.2], [1.4, 2.4], [1.2, 2.8], [0.5, 2.7]], weight: 5, soft_edge_m: 0, revisit_s: 30, protect: false }], // prettier-ignore
      no_fly: [{ name: 'road', outline_m: [[1.3, 0.5], [1.8, 0.6], [1.7, 1.2]] }], // prettier-ignore
    });
  }

  sayEvents(): void {
    const event = (number: number, severity: string, what: string, text: string, effect: string, next: string) => ({
      number,
      tick: 10 * number,
      time_s: 0.2 * number,
      wall_ms: 0,
      severity,
      source: 'operator',
      what,
      drone: '',
      was: '',
      by: 'Ana',
      text,
      effect,
      next, // prettier-ignore
    });
    this.say({
      type: 'events',
      events: [
        event(1, 'info', 'edit', 'east: weight 2', '', ''),
        event(
          2,
          'warning',
          'landing',
          'd3 lands',
          '4 of 5 drones cover; its share goes to them',
          'take off again when it is ready',
        ),
        event(
          3,
          'alarm',
          'tracking_lost',
          'd2 is not tracked',
          'the others keep clear of its last place',
          'look for it',
        ),
      ],
    });
  }

  /** An order of an operator to all drones, as the program tells it to everybody. */
  sayDeed(number: number, by: string, what: string): void {
    const severity = what === 'emergency_stop' ? 'alarm' : 'info';
    const said = { text: `${by}: ${what} all`, effect: '', next: '' };
    const when = { number, tick: number, time_s: 0, wall_ms: 0 };
    this.say({
      type: 'events',
      events: [{ ...when, ...said, severity, source: 'operator', what, drone: 'all', was: '', by }],
    });
  }

  private emptyTargets(): Record<string, unknown> {
    return {
      type: 'targets',
      epoch: 1,
      revision: 1,
      by: 'mission',
      what: '',
      can_undo: false,
      can_redo: false,
      undo_what: '',
      redo_what: '',
      clusters: [],
      areas: [],
      no_fly: [],
      uniform_floor: this.uniformFloor, // prettier-ignore
    };
  }

  private greet(): void {
    this.greetings++;
    const [x, y] = this.size;
    this.say({
      type: 'hello',
      protocol: 1,
      program: 'vigil test',
      client: 1,
      name: 'Ana',
      role: 'safety_pilot',
      roles: ['viewer', 'operator', 'safety_pilot'],
      login: false,
      run: this.run,
      steady_ms: performance.now(),
    });
    this.say({
      type: 'mission',
      epoch: 1,
      fleet: 'SIM',
      mission: {
        name: this.missionName,
        drones: this.drones.map((_, i) => ({ id: this.idOf(i) })),
        stations: this.stations,
      },
      display: {
        field: { length_x_m: x, length_y_m: y, origin_m: this.origin, yaw_rad: 0 },
        dt_s: 0.02,
        separation_m: 0.2,
        contact_distance_m: 0.1,
        wall_distance_m: 0.17,
        no_fly_buffer_m: 0.17,
        barrier_radius_m: 0.2,
        speed_limit_m_s: 0.3,
        footprint_radius_m: 0.3,
        sigma_min_m: 0.15,
        can_change_speed: true,
        can_pause: true,
        most_speed: 20,
      },
    });
    this.say(this.emptyTargets());
    this.socket?.send(densityBytes(this.size, 96, 96, (u, v) => Math.exp(-30 * ((u - 0.3) ** 2 + (v - 0.6) ** 2))));
    this.sendSnapshot();
  }

  /** Moves every drone by 50 ms on its circle, and says so. */
  step(): void {
    this.tick++;
    for (const drone of this.drones) {
      drone.x += 0.05 * drone.vx;
      drone.y += 0.05 * drone.vy;
      [drone.vx, drone.vy] = [drone.vx - 0.02 * drone.vy, drone.vy + 0.02 * drone.vx];
    }
    this.sendSnapshot();
  }

  private sendSnapshot(): void {
    const timeS = this.tick * 0.05;
    const figures = {
      tick: this.tick,
      timeS,
      metricPercent: 100 * Math.exp(-timeS / 20),
      worstAgeS: 4,
      leastPairM: 0.31,
    };
    this.socket?.send(snapshotBytes(this.drones, figures, this.holding));
  }
}
