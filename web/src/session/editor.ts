import { computed, signal } from '@preact/signals';
import type { Refused } from '../link/messages';
import {
  add,
  area,
  centroid,
  contains,
  crossesItself,
  distance,
  fillWithPoints,
  scaled,
  simplify,
  type Point,
} from '../model/geometry';
import { isStaged, nothingStaged, redoStep, restage, stage, undoStep, type Step } from '../model/staging';
import { find, freeName, pointsOf, withPoints, type Edit, type EntryName } from '../model/targets';
import type { Session } from './session';

export const kTools = ['select', 'point', 'lasso', 'brush', 'area', 'no-fly', 'measure', 'go-to'] as const;
export type Tool = (typeof kTools)[number];

const kLassoPoints = 12;
const kMostStrokePoints = 200;
const kMostOutline = 200;

/** What a person does to the targets: selection, the tool in hand, what is being drawn, and staged edits. */
export class Editor {
  readonly tool = signal<Tool>('select');
  readonly selected = signal<EntryName | null>(null);
  /** The point or vertex of the selected entry. */
  readonly selectedPoint = signal<number | null>(null);
  readonly selectedDrones = signal<ReadonlySet<number>>(new Set());
  /** Corners of the polygon, or the line of the lasso or brush, that is being drawn. */
  readonly sketch = signal<readonly Point[]>([]);
  readonly measured = signal<readonly Point[]>([]);
  /** Where the keyboard would act on the map; null until an arrow key is pressed there. */
  readonly cursor = signal<Point | null>(null);
  readonly isCommitting = signal(false);
  private isSteppingBack = false;

  readonly selectedEntry = computed(() => {
    const which = this.selected.value;
    return which && find(this.session.draft.value, which);
  });

  constructor(
    readonly session: Session,
    /** What the go-to tool does with a place of the field. */
    private readonly sendTo: (place: Point) => void,
  ) {
    session.onAnotherMission(() => this.letGo());
  }

  /** Nothing selected, nothing drawn, and no tool in hand that would act at a click. */
  private letGo(): void {
    this.take('select');
    this.select(null);
    this.selectDrones([]);
    this.cursor.value = null;
  }

  take(tool: Tool): void {
    this.tool.value = tool;
    this.sketch.value = [];
    if (tool !== 'measure') this.measured.value = [];
    if (tool === 'area' || tool === 'no-fly') this.select(null);
  }

  select(which: EntryName | null, point: number | null = null): void {
    this.selected.value = which;
    this.selectedPoint.value = point;
  }

  selectDrones(drones: Iterable<number>): void {
    this.selectedDrones.value = new Set(drones);
  }

  toggleDrone(drone: number): void {
    const next = new Set(this.selectedDrones.value);
    if (!next.delete(drone)) next.add(drone);
    this.selectedDrones.value = next;
  }

  /** Those inside the outline; `places`: x and y by turns, world frame. */
  selectDronesInside(outline: readonly Point[], places: Float64Array): void {
    const drones = [...this.session.droneIds.value.keys()];
    this.selectDrones(drones.filter((i) => contains(outline, [places[2 * i]!, places[2 * i + 1]!])));
  }

  // --- staging ----------------------------------------------------------------------------------------------------

  stage(what: string, ...edits: Edit[]): boolean {
    return this.put({ what, edits }, false);
  }

  /** A later moment of the same drag: replaces what its first moment staged. */
  stageAgain(what: string, ...edits: Edit[]): boolean {
    return this.put({ what, edits }, true);
  }

  private put(step: Step, again: boolean): boolean {
    const { session } = this;
    if (!this.mayEdit()) return false;
    const revision = session.targets.value?.revision ?? 0;
    session.restage((again ? restage : stage)(session.staging.value, step, revision));
    return true;
  }

  private mayEdit(): boolean {
    const { session } = this;
    if (session.mayOperate.value) return true;
    session.notify(
      'warning',
      session.isRecording.value
        ? 'This is a recording: what happened in it cannot be changed.'
        : session.isLive.value
          ? 'Your role may look, not edit.'
          : 'There is no fresh picture: editing is off.',
    );
    return false;
  }

  /** Closes what is being drawn, or else commits what is staged. */
  async commit(): Promise<void> {
    if (this.sketch.value.length > 0) {
      this.finishSketch();
      return;
    }
    const { session } = this;
    const staging = session.staging.value;
    if (!isStaged(staging) || this.isCommitting.value || !this.mayEdit()) return;
    this.isCommitting.value = true;
    const answer = await session.commit();
    this.isCommitting.value = false;
    if (answer.ok) session.notify('info', `Committed: ${this.whatFollows()}`);
    else this.commitRefused(answer.refused);
  }

  /** What a commit brings about by now. */
  private whatFollows(): string {
    const { snapshot } = this.session;
    if (snapshot?.active === 0) return 'no drone covers now; those that will follow it.';
    return snapshot?.isPaused ? 'the swarm follows once the clock goes on.' : 'the swarm follows.';
  }

  /** What was refused stays staged; after somebody else's change the next Enter commits it all the same. */
  private commitRefused(refused: Refused): void {
    const { session } = this;
    session.notify('warning', refused.reason);
    const revision = session.targets.value?.revision ?? 0;
    if (refused.code === 'stale') session.restage({ ...session.staging.value, basedOn: revision });
  }

  /** Drops what is being drawn, or else what is staged, or else the selection. */
  drop(): void {
    if (this.sketch.value.length > 0) this.sketch.value = [];
    else if (this.measured.value.length > 0) this.measured.value = [];
    else if (this.session.isStaged.value) {
      this.session.restage(nothingStaged(this.session.targets.value?.revision ?? 0));
      this.session.notify('info', 'Staged edits dropped.');
    } else if (this.tool.value !== 'select') this.take('select');
    else {
      this.select(null);
      this.selectDrones([]);
    }
  }

  undo(): void {
    const { session } = this;
    if (this.sketch.value.length > 0) this.sketch.value = this.sketch.value.slice(0, -1);
    else if (session.isStaged.value) session.restage(undoStep(session.staging.value));
    else if (!session.targets.value?.can_undo) session.notify('info', 'Nothing to undo.');
    else this.stepBack('undo', `Undone: ${session.targets.value.undo_what}`);
  }

  redo(): void {
    const { session } = this;
    if (session.staging.value.undone.length > 0) session.restage(redoStep(session.staging.value));
    else if (!session.targets.value?.can_redo) session.notify('info', 'Nothing to redo.');
    else this.stepBack('redo', `Done again: ${session.targets.value.redo_what}`);
  }

  /** One at a time: the next is about the targets that this one leaves. */
  private stepBack(type: 'undo' | 'redo', done: string): void {
    const { session } = this;
    if (this.isSteppingBack || !this.mayEdit()) return;
    this.isSteppingBack = true;
    const command = session.forThisFlight({ type, based_on: session.targets.value?.revision ?? 0 });
    void session.command(command, done).then(() => (this.isSteppingBack = false));
  }

  // --- points and shapes ------------------------------------------------------------------------------------------

  /** Uses the tool in hand at this place of the world; true where something came of it. */
  placeAt(p: Point): boolean {
    const tool = this.tool.value;
    if (tool === 'measure') {
      this.measured.value = this.measured.value.length === 1 ? [this.measured.value[0]!, p] : [p];
      return true;
    }
    if (tool === 'select' || !this.isInside(p)) return false;
    if (tool === 'go-to') {
      this.sendTo(p);
      return true;
    }
    if (tool === 'area' || tool === 'no-fly') {
      if (this.mayEdit()) this.sketch.value = [...this.sketch.value, p].slice(0, kMostOutline);
      return true;
    }
    return this.addPoints([p]);
  }

  private isInside(p: Point): boolean {
    const inside = this.session.field.value?.contains(p) ?? false;
    if (!inside) this.session.notify('warning', 'That is outside of the field.');
    return inside;
  }

  /** Adds points to the selected cluster; where none is selected, to a new one. */
  addPoints(points: readonly Point[]): boolean {
    if (points.length === 0) return false;
    const selected = this.selected.value;
    const name =
      selected?.kind === 'cluster' && this.selectedEntry.value
        ? selected.name
        : freeName(this.session.draft.value, 'cluster', 'targets');
    const edits = points.map((point_m): Edit => ({
      op: 'add_point',
      kind: 'cluster',
      name,
      point_m: rounded(point_m),
    }));
    const what = points.length === 1 ? `a point in ${name}` : `${points.length} points in ${name}`;
    if (!this.stage(what, ...edits)) return false;
    this.select({ kind: 'cluster', name });
    return true;
  }

  /** The free-hand line of lasso, brush or outline is done. */
  finishSketch(): void {
    const line = this.sketch.value;
    const tool = this.tool.value;
    this.sketch.value = [];
    if (tool === 'brush') this.addPoints(this.alongStroke(line));
    else if (tool === 'lasso') this.finishLasso(line);
    else this.finishOutline(tool === 'no-fly' ? 'no_fly' : 'area', line);
  }

  private finishLasso(line: readonly Point[]): void {
    if (line.length < 3) return;
    const spacing = Math.sqrt(area(line) / kLassoPoints);
    const points = spacing > 0 ? fillWithPoints(line, spacing, 2 * kLassoPoints) : [];
    this.addPoints(points.filter((p) => this.session.field.value?.contains(p)));
  }

  private alongStroke(line: readonly Point[]): Point[] {
    const spacing = 0.04 * this.shorterSide();
    const kept: Point[] = [];
    for (const p of line) {
      const last = kept[kept.length - 1];
      if ((!last || distance(last, p) >= spacing) && this.session.field.value?.contains(p)) kept.push(p);
    }
    return kept.slice(0, kMostStrokePoints);
  }

  private finishOutline(kind: 'area' | 'no_fly', line: readonly Point[]): void {
    // A hand-drawn outline has hundreds of points; those that matter are kept.
    const outline = line.length > 12 ? simplify([...line, line[0]!], 0.006 * this.shorterSide()).slice(0, -1) : line;
    if (outline.length < 3) {
      this.session.notify('warning', 'An outline needs at least three corners.');
      return;
    }
    if (crossesItself(outline)) {
      this.session.notify('warning', 'That outline crosses itself: draw it again without a crossing.');
      return;
    }
    this.addOutline(kind, outline);
  }

  addOutline(kind: 'area' | 'no_fly', points: readonly Point[], name?: string): void {
    const field = this.session.field.value;
    const outline_m = points.map((p) => rounded(field ? field.clamped(p) : p));
    const free = freeName(this.session.draft.value, kind, name ?? (kind === 'area' ? 'area' : 'no-fly'));
    const entry =
      kind === 'area'
        ? { name: free, outline_m, weight: 5, soft_edge_m: this.softEdge(), revisit_s: null, protect: false }
        : { name: free, outline_m };
    if (this.stage(`${kind === 'area' ? 'area' : 'no-fly polygon'} ${free}`, { op: 'add', kind, entry }))
      this.select({ kind, name: free });
  }

  /** A hand is not exact: what it draws fades out over two percent of the field, to two digits. */
  private softEdge(): number {
    return Number((0.02 * this.shorterSide()).toPrecision(2));
  }

  remove(): void {
    const which = this.selected.value;
    const entry = this.selectedEntry.value;
    if (!which || !entry) return;
    const point = this.selectedPoint.value;
    if (point !== null && which.kind !== 'cluster' && pointsOf(entry).length <= 3) this.keepTriangle(which.name);
    else if (point !== null && pointsOf(entry).length > 1) {
      this.stage(`a point of ${which.name} removed`, { op: 'remove_point', ...which, index: point });
      this.selectedPoint.value = null;
    } else if (this.stage(`${which.name} removed`, { op: 'remove', ...which })) this.select(null);
  }

  /** A corner was meant, not the outline: that goes only when it is meant itself. */
  private keepTriangle(name: string): void {
    this.selectedPoint.value = null;
    const reason = 'An outline needs three corners: this one stays.';
    this.session.notify('warning', `${reason} Now ${name} as a whole is selected: Delete removes it.`);
  }

  movePoint(which: EntryName, index: number, to: Point, again: boolean): void {
    const point_m = rounded(this.session.field.value?.clamped(to) ?? to);
    if (!again) this.tellKeptInside(which, [to], [point_m]);
    this.put(
      { what: `a point of ${which.name} moved`, edits: [{ op: 'move_point', ...which, index, point_m }] },
      again,
    );
  }

  setWeight(which: EntryName, weight: number): void {
    const rounding = weight < 10 ? 100 : 10;
    const kept = Math.min(1_000_000, Math.max(0, Math.round(weight * rounding) / rounding));
    this.merge(`${which.name}: weight ${kept}`, { op: 'set_weight', ...which, weight: kept });
  }

  /** Turning a wheel or holding a key makes one step, not twenty. */
  private merge(what: string, edit: Extract<Edit, { op: 'set_weight' }>): void {
    const { steps } = this.session.staging.value;
    const last = steps[steps.length - 1]?.edits[0];
    const isSame = last?.op === edit.op && last.kind === edit.kind && last.name === edit.name;
    this.put({ what, edits: [edit] }, isSame);
  }

  /** Moves the entry as it was, `from`, by so much, or spreads it by a factor around its centre. */
  reshape(which: EntryName, from: readonly Point[], by: Point, factor: number, again: boolean): void {
    const entry = find(this.session.draft.value, which);
    if (!entry) return;
    const field = this.session.field.value;
    const meant = scaled(from, factor).map((p) => add(p, by));
    const points = meant.map((p) => rounded(field ? field.clamped(p) : p));
    if (!again) this.tellKeptInside(which, meant, points);
    const edit: Edit = { op: 'replace', ...which, entry: withPoints(entry, points) };
    this.put({ what: factor === 1 ? `${which.name} moved` : `${which.name} spread`, edits: [edit] }, again);
  }

  /** What was typed is not always what comes of it. */
  private tellKeptInside(which: EntryName, meant: readonly Point[], kept: readonly Point[]): void {
    const moved = meant.filter((p, i) => distance(p, kept[i]!) > 1e-5).length;
    if (moved === 0) return;
    const what = meant.length === 1 ? 'That is' : moved === 1 ? 'One point is' : `${moved} points are`;
    const where = moved === 1 ? 'it was put on its edge' : 'they were put on its edge';
    this.session.notify('warning', `${what} outside of the field: ${where} (${which.name}).`);
  }

  centreOf = (which: EntryName): Point | null => {
    const entry = find(this.session.draft.value, which);
    return entry && centroid(pointsOf(entry));
  };

  private shorterSide(): number {
    const size = this.session.field.value?.size ?? [1, 1];
    return Math.min(size[0], size[1]);
  }
}

/** A micrometre is finer than any place that a person can mean, and keeps messages short. */
const rounded = (p: Point): Point => [Math.round(p[0] * 1e6) / 1e6, Math.round(p[1] * 1e6) / 1e6];
