import { batch, computed, signal } from '@preact/signals';
import { ConsoleLink, type Answer, type Command, type LinkState, type World } from '../link/console_link';
import type { AgeMap, Coverage, Density, Frame, Snapshot, Trails } from '../link/frames';
import type { Hello, MessageOf, Mission, Operator, ServerMessage, Status, TargetsMessage } from '../link/messages';
import { FieldFrame } from '../model/field_frame';
import { draftOf, isStaged, nothingStaged, rebase, touched, unsent, type Staging, type Step } from '../model/staging';
import { kNoTargets, type EntryName, type Targets } from '../model/targets';
import { deedOf } from '../model/deeds';
import { refusalWords } from '../model/refusals';
import { sentence } from '../model/units';
import { EventBook, type LoggedEvent } from './event_book';
import { kMostOthers, Notices, type NoticeKind } from './notices';
import { RestartWatch } from './restart_watch';
import { Series } from './series';
import { WaitingOrders } from './waiting_orders';

const kBeatMs = 200;
/** A picture that is older than this is not live; one that comes after it must be this young to be live again. */
export const kStaleS = 1.5;
const kFreshS = 1;
/** An order that brings drones down should be confirmed by then; if not, that is said. */
const kConfirmedWithinMs = 400;

/**
 * What this page knows of the swarm. Fast data (frames) is held as it came, for the map to read at its own rate; slow
 * data are signals. `beat` ticks at most five times a second: what shows fast data as text listens to that.
 */
export class Session {
  readonly link: ConsoleLink;
  readonly linkState = signal<LinkState>({
    phase: 'connecting',
    reason: '',
    hasEnded: false,
    retryAtMs: null,
  });
  readonly hello = signal<Hello | null>(null);
  readonly mission = signal<Mission | null>(null);
  readonly targets = signal<TargetsMessage | null>(null);
  readonly status = signal<Status | null>(null);
  readonly operators = signal<readonly Operator[]>([]);
  private readonly told: Notices;
  private readonly book = new EventBook();
  readonly events = this.book.events;
  readonly staging = signal<Staging>(nothingStaged(0));
  readonly beat = signal(0);
  readonly hasSnapshot = signal(false);

  readonly field = computed<FieldFrame | null>(() => {
    const field = this.mission.value?.display.field;
    return field ? new FieldFrame(field.origin_m, field.yaw_rad, [field.length_x_m, field.length_y_m]) : null;
  });
  readonly droneIds = computed<readonly string[]>(() => this.mission.value?.mission.drones.map((d) => d.id) ?? []);
  /** How many drones there are; of very many only some are shown, which `droneIds` names. */
  readonly fleetSize = computed(() => this.mission.value?.display.drones ?? this.droneIds.value.length);
  /** What is committed, and what it would be with the staged edits. */
  readonly committed = computed<Targets>(() => this.targets.value ?? kNoTargets);
  readonly draft = computed<Targets>(() => draftOf(this.committed.value, this.staging.value) ?? this.committed.value);
  readonly isStaged = computed(() => isStaged(this.staging.value));
  /** The socket is open, though what comes may be old, or nothing may come. */
  readonly isConnected = computed(() => ['live', 'silent'].includes(this.linkState.value.phase));
  /** The newest picture is older than `kStaleS`, for whatever reason. */
  readonly isOld = signal(false);
  readonly isLive = computed(
    () => this.linkState.value.phase === 'live' && this.hasSnapshot.value && !this.isOld.value,
  );
  /** What happened in a recording cannot be changed; only its clock obeys. */
  readonly isRecording = computed(() => this.mission.value?.fleet === 'REPLAY');
  /** A recording's clock obeys also whoever sees it late: no drone is at stake. */
  readonly mayTurnClock = computed(
    () =>
      (this.isRecording.value ? this.isConnected.value : this.isLive.value) &&
      (this.hello.value?.role ?? 'viewer') !== 'viewer',
  );
  readonly mayOperate = computed(() => this.mayTurnClock.value && !this.isRecording.value);
  /** Drones are brought down also by who sees an old picture, or none. */
  readonly mayLand = computed(
    () => this.isConnected.value && !this.isRecording.value && (this.hello.value?.role ?? 'viewer') !== 'viewer',
  );
  readonly mayStopMotors = computed(() => this.mayLand.value && this.hello.value?.role === 'safety_pilot');

  snapshot: Snapshot | null = null;
  /** When the snapshot came (World.nowMs). */
  snapshotAtMs = 0;
  density: Density | null = null;
  ghost: Density | null = null;
  coverage: Coverage | null = null;
  ageMap: AgeMap | null = null;
  trails: Trails | null = null;
  readonly series = new Series();
  /** Which drones have held since the program was restarted. */
  readonly restart = new RestartWatch();

  private isCommitting = false;
  private targetsWhileCommitting: TargetsMessage | null = null;
  /** What is staged became this revision, whose targets have not come yet. */
  private committedRevision: number | null = null;
  /** The staged steps that were sent to be committed; those that come after them are not among them. */
  private sent: readonly Step[] = [];

  private readonly waiting: WaitingOrders;
  /** Which run of the program flies `mission`; with its epoch it tells which flight that is, see protocol/README.md. */
  private run = '';
  /** Flights that this page has seen; what was asked in another one is not about this one. */
  private flights = 0;

  private readonly missionListeners = new Set<() => void>();
  private readonly snapshotListeners = new Set<(snapshot: Snapshot) => void>();
  private lastBeatMs = 0;
  private previewBusy = false;
  private previewWanted = false;
  private shownEditing = '[]';
  private cancelOld: () => void = () => undefined;

  constructor(
    readonly world: World,
    identity: Readonly<Record<string, unknown>>,
  ) {
    const listener = {
      stateChanged: (state: LinkState) => this.linkChanged(state),
      messageCame: (message: ServerMessage) => batch(() => this.take(message)),
      frameCame: (frame: Frame) => this.takeFrame(frame),
      mistakeSeen: (what: string) => this.notify('warning', `The program sent something unexpected: ${what}`),
    };
    this.link = new ConsoleLink(world, listener, identity);
    this.told = new Notices(world);
    this.waiting = new WaitingOrders(this.told);
  }

  get notices(): Notices['all'] {
    return this.told.all;
  }

  /** Calls back at every snapshot; the function returned ends that. */
  onSnapshot(listener: (snapshot: Snapshot) => void): () => void {
    this.snapshotListeners.add(listener);
    return () => this.snapshotListeners.delete(listener);
  }

  /** Calls back when another flight is shown than before: indices and names of the old one mean something else then. */
  onAnotherMission(listener: () => void): void {
    this.missionListeners.add(listener);
  }

  /** Seconds since what is shown was true, the way to this page and its own lateness included; Infinity before anything came. */
  dataAgeS(): number {
    const programMs = this.link.clock.at(this.world.nowMs());
    if (!this.snapshot || programMs === null) return Infinity;
    return Math.max(0, (programMs - this.snapshot.steadyMs) / 1000);
  }

  /** See `Notices`. */
  notify(kind: NoticeKind, text: string, lastsMs?: number | null): number {
    return this.told.notify(kind, text, lastsMs);
  }

  dismiss(number: number): void {
    this.told.dismiss(number);
  }

  dismissAlarms(): void {
    this.told.dismissAlarms();
  }

  /** Sends a command and says what became of it; true when it was accepted. */
  async command(command: Command, done?: string): Promise<boolean> {
    // A recording follows also who sees it late: no drone is at stake.
    if (this.isConnected.value && !this.isLive.value && !this.isRecording.value) {
      this.notify('warning', 'There is no fresh picture: nothing was sent. Landing and stopping motors still work.');
      return false;
    }
    const answer = await this.link.command(command);
    this.report(command.type, answer, done);
    return answer.ok;
  }

  /** Meant for the drones, or the targets, of the flight that is shown here: another flight refuses it. */
  forThisFlight(command: Command): Command {
    return { ...command, run: this.run, epoch: this.mission.value?.epoch ?? 0 };
  }

  /** Whether it happened in the flight that is shown. */
  isOfThisFlight(event: LoggedEvent): boolean {
    return event.run === this.run && event.epoch === this.mission.value?.epoch;
  }

  /** The same of an order that brings drones down, which goes out however old the picture is; says where it stands. */
  async bringDown(command: Command, name: string, done: string): Promise<boolean> {
    let notice = 0;
    const cancel = this.world.after(kConfirmedWithinMs, () => {
      notice = this.notify('warning', `${name} was sent; it is not confirmed yet.`, 60_000);
    });
    const answer = await this.link.command(command);
    cancel();
    this.dismiss(notice);
    if (!answer.ok && ['no_answer', 'offline'].includes(answer.refused.code))
      this.notify('alarm', `${name} is not confirmed. ${sentence(answer.refused.reason)}`);
    else this.report(command.type, answer, done);
    return answer.ok;
  }

  private report(type: string, answer: Answer, done: string | undefined): void {
    if (!answer.ok) {
      this.notify('warning', answer.refused.reason);
      return;
    }
    if (answer.ack.pending && type !== 'undo' && type !== 'redo') {
      // targets are shown at once, whenever a tick takes them
      const why = this.snapshot?.isPaused ? 'the clock is paused' : 'the next tick is late';
      this.waiting.add(type, why, done, this.status.value?.waiting != null);
      return;
    }
    const refused = refusalWords(done ?? type, answer.ack);
    if (refused !== '') this.notify('warning', refused);
    else if (done) this.notify('info', done);
  }

  // --- what comes from the program --------------------------------------------------------------------------------

  private linkChanged(state: LinkState): void {
    this.linkState.value = state;
    if (state.phase !== 'live') this.beat.value++;
  }

  private take(message: ServerMessage): void {
    switch (message.type) {
      case 'hello':
        if (message.run !== this.hello.value?.run) this.waiting.drop();
        this.hello.value = message;
        this.isOld.value = this.snapshot !== null;
        this.shownEditing = '[]';
        break;
      case 'mission':
        this.takeMission(message);
        break;
      case 'targets':
        this.takeTargets(message);
        break;
      case 'events':
        this.takeEvents(message);
        break;
      case 'status':
        if (message.epoch !== this.mission.value?.epoch) break;
        this.status.value = message;
        this.restart.take(message.waits_for_resume, this.snapshot);
        break;
      case 'presence':
        this.operators.value = message.operators;
        break;
      default:
        break;
    }
  }

  private takeMission(mission: Mission): void {
    const before = this.mission.value;
    const run = this.hello.value?.run ?? '';
    const isRestarted = run !== this.run;
    const isAnother = isRestarted || !isSameMission(mission, before);
    this.mission.value = mission;
    this.run = run;
    if (!isAnother) return;
    this.flights++;
    this.snapshot = this.density = this.ghost = this.coverage = this.ageMap = this.trails = null;
    this.hasSnapshot.value = false;
    this.isOld.value = false;
    this.targets.value = null;
    this.status.value = null;
    this.isCommitting = false;
    this.committedRevision = null;
    this.targetsWhileCommitting = null;
    this.restart.forget();
    if (before) this.partWith(before, mission, isRestarted);
    this.restage(nothingStaged(0));
    this.series.reset(mission.mission.drones.length);
  }

  /**
   * Nothing that was chosen, staged or told for the old flight is taken for the new one's, also where a restarted program
   * goes on with the same mission: what became of its drones and targets meanwhile this page cannot know.
   */
  private partWith(before: Mission, now: Mission, isRestarted: boolean): void {
    this.waiting.drop();
    const alarms = this.told.dismissEvents();
    const what = partingWords(before.mission.name, now.mission.name, isRestarted);
    const gone = goneWords(this.staging.value.steps.length, alarms);
    this.notify(isRestarted ? 'alarm' : 'warning', `${what} Nothing is selected any more.${gone}`);
    for (const listener of this.missionListeners) listener();
  }

  private takeTargets(targets: TargetsMessage): void {
    if (this.isCommitting) {
      this.targetsWhileCommitting = targets;
      return;
    }
    this.targets.value = targets;
    if (this.committedRevision !== null && targets.revision >= this.committedRevision) {
      this.committedRevision = null;
      this.tellTooLate(this.staging.value.undone.filter((step) => this.sent.includes(step)));
      this.carryOver(targets, unsent(this.staging.value, this.sent, targets.revision));
      return;
    }
    this.carryOver(targets, this.staging.value);
  }

  private tellTooLate(steps: readonly Step[]): void {
    if (steps.length > 0)
      this.notify('warning', `Committed before you took it back: “${steps.map((s) => s.what).join('”, “')}”.`);
  }

  /** What is staged goes on where it still fits the targets. */
  private carryOver(targets: TargetsMessage, before: Staging): void {
    const { staging, lost } = rebase(targets, before);
    if (lost.length > 0)
      this.notify(
        'warning',
        `${targets.by} changed what you were editing: dropped “${lost.map((s) => s.what).join('”, “')}”.`,
      );
    this.restage(staging);
  }

  private takeEvents(message: MessageOf<'events'>): void {
    const [run, epoch] = [this.hello.value?.run ?? '', this.mission.value?.epoch ?? 0];
    if (message.afresh) {
      this.series.reset(this.droneIds.value.length);
      this.book.replace(message.events, run, epoch);
      return;
    }
    const news = this.book.take(message.events, run, epoch);
    for (const event of news) if (event.by !== '' && event.by === this.hello.value?.name) this.waiting.settle(event);
    this.tell(news);
  }

  /** What an operator here did is no news to this console; what happened by itself is said before who asked for what. */
  private tell(events: readonly LoggedEvent[]): void {
    this.announce(events.filter((event) => event.severity !== 'info' && event.source !== 'operator'));
    for (const event of events
      .filter((one) => one.source === 'operator' && this.isOfAnother(one))
      .slice(-kMostOthers)) {
      const deed = deedOf(event);
      this.told.tell(deed.kind, deed.text);
    }
  }

  /** Where two consoles have the same name, what either did is said on both. */
  private isOfAnother(event: LoggedEvent): boolean {
    const own = this.hello.value;
    const isShared = this.operators.value.some((one) => one.client !== own?.client && one.name === own?.name);
    return event.by !== own?.name || isShared;
  }

  /** One message for a few events, one for all of them where they are many: the log has each. */
  private announce(news: readonly LoggedEvent[]): void {
    const kind = news.some((event) => event.severity === 'alarm') ? 'alarm' : 'warning';
    const first = news.find((event) => event.severity === kind);
    if (!first) return;
    if (news.length > 2) this.told.tell(kind, `${first.text}, and ${news.length - 1} more: see the event log.`);
    else
      for (const event of news)
        this.told.tell(event.severity, event.effect ? `${event.text}: ${event.effect}.` : event.text);
  }

  private takeFrame(frame: Frame): void {
    if (frame.epoch !== this.mission.value?.epoch) return;
    if (frame.kind === 'snapshot') this.takeSnapshot(frame);
    else if (frame.kind === 'coverage') this.coverage = frame;
    else if (frame.kind === 'age') this.ageMap = frame;
    else if (frame.kind === 'trails') this.trails = frame;
    else if (frame.kind === 'history') this.series.fill(frame, this.droneIds.value.length);
    else if (!frame.isPreview) this.density = frame;
    else if (this.isStaged.value) this.ghost = frame;
  }

  private takeSnapshot(snapshot: Snapshot): void {
    if (snapshot.n !== this.droneIds.value.length) return;
    this.snapshot = snapshot;
    this.snapshotAtMs = this.world.nowMs();
    this.series.take(snapshot);
    this.watchAge();
    for (const listener of this.snapshotListeners) listener(snapshot);
    if (this.snapshotAtMs - this.lastBeatMs < kBeatMs) return;
    this.lastBeatMs = this.snapshotAtMs;
    batch(() => {
      this.restart.take(this.status.value?.waits_for_resume ?? false, snapshot);
      this.hasSnapshot.value = true;
      this.beat.value++;
    });
  }

  /** A picture that comes old is not live, and one that is live grows old by itself. */
  private watchAge(): void {
    this.cancelOld();
    const ageS = this.dataAgeS();
    if (ageS > kStaleS) this.isOld.value = true;
    else if (ageS < kFreshS) this.isOld.value = false;
    this.cancelOld = this.world.after(Math.max(0, 1000 * (kStaleS - ageS)), () => (this.isOld.value = true));
  }

  // --- staged edits -----------------------------------------------------------------------------------------------

  /** Puts other staged edits in place of these; the ghost and what others see follow. */
  restage(staging: Staging): void {
    this.staging.value = staging;
    if (!isStaged(staging)) this.ghost = null;
    else this.wantPreview();
    this.tellEditing(touched(staging));
  }

  /**
   * Sends what is staged. The staged edits make room for the committed ones in the same moment, whichever of the answer
   * and the new targets comes first: nothing is seen twice, or not at all.
   */
  async commit(): Promise<Answer> {
    const { basedOn, steps } = this.staging.value;
    const flight = this.flights;
    this.isCommitting = true;
    this.sent = steps;
    const edits = steps.flatMap((step) => step.edits);
    const answer = await this.link.command(this.forThisFlight({ type: 'edit', based_on: basedOn, edits }));
    if (flight !== this.flights) return ofFlightBefore(answer);
    batch(() => {
      this.isCommitting = false;
      if (answer.ok) this.committedRevision = answer.ack.revision ?? 0;
      const targets = this.targetsWhileCommitting;
      this.targetsWhileCommitting = null;
      if (targets) this.takeTargets(targets);
    });
    return answer;
  }

  /** One preview at a time; the newest draft follows when the answer is there. */
  private wantPreview(): void {
    if (this.previewBusy) {
      this.previewWanted = true;
      return;
    }
    this.previewBusy = true;
    this.previewWanted = false;
    const edits = this.staging.value.steps.flatMap((step) => step.edits);
    void this.link
      .command({ type: 'preview_density', based_on: this.targets.value?.revision ?? 0, edits })
      .then((answer) => this.previewAnswered(answer));
  }

  private previewAnswered(answer: Answer): void {
    this.previewBusy = false;
    if (!answer.ok && !['superseded', 'offline', 'busy'].includes(answer.refused.code)) {
      this.ghost = null;
      this.previewProblem.value = answer.refused.reason;
    } else this.previewProblem.value = '';
    if (this.previewWanted && this.isStaged.value) this.wantPreview();
  }

  /** Why the staged edits could not be committed as they are; empty where they could. */
  readonly previewProblem = signal('');

  private tellEditing(what: readonly EntryName[]): void {
    const told = JSON.stringify(what);
    if (told === this.shownEditing || !this.mayOperate.value) return;
    this.shownEditing = told;
    void this.link.command({ type: 'editing', what });
  }
}

const isSameMission = (a: Mission, b: Mission | null): boolean =>
  a.epoch === b?.epoch &&
  a.mission.name === b.mission.name &&
  a.mission.drones.length === b.mission.drones.length &&
  a.mission.drones.every((drone, i) => drone.id === b.mission.drones[i]!.id);

function partingWords(before: string, now: string, isRestarted: boolean): string {
  if (!isRestarted) return `Another mission is flown now: ${now}, after ${before}.`;
  return `The program was restarted and flies ${now === before ? `${now} again` : `${now}, after ${before}`}.`;
}

/** What went with the flight before. */
function goneWords(edits: number, alarms: number): string {
  const dropped = edits === 1 ? ' Your staged edit was dropped.' : ` Your ${edits} staged edits were dropped.`;
  const put = alarms === 1 ? ' The alarm of before is' : ` The ${alarms} alarms of before are`;
  return `${edits > 0 ? dropped : ''}${alarms > 0 ? `${put} in the event log.` : ''}`;
}

/** What a commit came to whose flight is not shown any more. */
function ofFlightBefore(answer: Answer): Answer {
  if (!answer.ok) return answer;
  const reason = 'Your edit was committed to the flight before; the one that is shown now does not have it.';
  return { ok: false, refused: { type: 'refused', id: answer.ack.id, code: 'stale', reason } };
}
