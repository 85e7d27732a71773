import { distance, subtract, type Point } from '../model/geometry';
import { find, pointsOf, type EntryName } from '../model/targets';
import type { Hit } from './hit';
import type { MapView } from './map_view';

/** CSS pixels that a pointer may wander and still be a click. */
const kClickReach = 5;
const kMouseReach = 12;
const kTouchReach = 22;
const kArrowShare = 0.02;
const kMostSketch = 2000;

type Drag =
  | { readonly kind: 'pan' }
  | { readonly kind: 'sketch' }
  | { readonly kind: 'lasso-drones' }
  | { readonly kind: 'point'; readonly which: EntryName; readonly index: number }
  | {
      readonly kind: 'move' | 'spread';
      readonly which: EntryName;
      readonly points: readonly Point[];
      readonly centre: Point;
    };

/** Pointer, wheel and arrow keys on the map. One gesture at a time; a second finger turns it into pinch and pan. */
export class Gestures {
  private readonly down = new Map<number, Point>();
  private start: Point = [0, 0];
  private last: Point = [0, 0];
  private under: Hit | null = null;
  private drag: Drag | null = null;
  private hasMoved = false;
  private pinch = 0;
  private middle: Point = [0, 0];

  constructor(
    private readonly host: HTMLElement,
    private readonly map: MapView,
  ) {
    host.addEventListener('pointerdown', (event) => this.pressed(event));
    host.addEventListener('pointermove', (event) => this.moved(event));
    host.addEventListener('pointerup', (event) => this.released(event));
    host.addEventListener('pointercancel', (event) => this.cancelled(event));
    host.addEventListener('pointerleave', () => (map.pointer.value = null));
    host.addEventListener('wheel', (event) => this.wheeled(event), { passive: false });
    host.addEventListener('dblclick', () => this.doubleClicked());
    host.addEventListener('contextmenu', (event) => event.preventDefault());
    host.addEventListener('keydown', (event) => this.arrowPressed(event));
  }

  private at(event: MouseEvent): Point {
    const box = this.host.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  private pressed(event: PointerEvent): void {
    if ((event.target as Element).closest('button, input, select, a')) return;
    this.host.setPointerCapture(event.pointerId);
    const s = this.at(event);
    this.down.set(event.pointerId, s);
    if (this.down.size === 2) this.beginPinch();
    if (this.down.size > 1) return;
    this.start = this.last = s;
    this.hasMoved = false;
    this.under = this.map.hit(s, event.pointerType === 'touch' ? kTouchReach : kMouseReach);
    this.drag = event.button === 0 ? this.dragFor(event) : { kind: 'pan' };
  }

  /** What a drag from here would do. */
  private dragFor(event: PointerEvent): Drag {
    const { editor } = this.map;
    const tool = editor.tool.value;
    if (tool === 'lasso' || tool === 'brush' || tool === 'area' || tool === 'no-fly') return { kind: 'sketch' };
    if (tool !== 'select') return { kind: 'pan' };
    if (event.shiftKey) return { kind: 'lasso-drones' };
    const { under } = this;
    if (under?.part === 'point') return { kind: 'point', which: under.which, index: under.index };
    if (under?.part === 'centre' || under?.part === 'spread' || this.isSelectedBody(under)) {
      const which = (under as { which: EntryName }).which;
      const entry = find(editor.session.draft.value, which)!;
      const kind = under!.part === 'spread' ? 'spread' : 'move';
      return { kind, which, points: pointsOf(entry), centre: editor.centreOf(which)! };
    }
    return { kind: 'pan' };
  }

  /** An area is moved by its inside, once it is selected. */
  private isSelectedBody(under: Hit | null): boolean {
    const selected = this.map.editor.selected.value;
    return under?.part === 'body' && under.which.kind === selected?.kind && under.which.name === selected.name;
  }

  private moved(event: PointerEvent): void {
    const s = this.at(event);
    this.map.pointer.value = this.map.worldAt(s);
    if (!this.down.has(event.pointerId)) return;
    this.down.set(event.pointerId, s);
    if (this.down.size === 2) this.pinched();
    else if (this.drag) this.dragged(s);
    this.last = s;
  }

  private dragged(s: Point): void {
    const isFirst = !this.hasMoved;
    if (isFirst && distance(s, this.start) < kClickReach) return;
    this.hasMoved = true;
    const { map, drag } = this;
    const world = map.worldAt(s);
    const { editor } = map;
    if (drag?.kind === 'pan') map.pan(s[0] - this.last[0], s[1] - this.last[1]);
    else if (drag?.kind === 'sketch' || drag?.kind === 'lasso-drones') this.sketch(isFirst, world);
    else if (drag?.kind === 'point') editor.movePoint(drag.which, drag.index, world, !isFirst);
    else if (drag?.kind === 'move')
      editor.reshape(drag.which, drag.points, subtract(world, map.worldAt(this.start)), 1, !isFirst);
    else if (drag?.kind === 'spread') {
      const factor = distance(world, drag.centre) / Math.max(1e-9, distance(map.worldAt(this.start), drag.centre));
      editor.reshape(drag.which, drag.points, [0, 0], Math.min(20, Math.max(0.02, factor)), !isFirst);
    }
  }

  private sketch(isFirst: boolean, world: Point): void {
    const { editor } = this.map;
    const first = this.map.worldAt(this.start);
    if (isFirst) editor.sketch.value = [first];
    if (editor.sketch.value.length < kMostSketch) editor.sketch.value = [...editor.sketch.value, world];
  }

  private released(event: PointerEvent): void {
    if (!this.down.delete(event.pointerId)) return;
    if (this.down.size === 2) this.beginPinch();
    if (this.down.size > 0) return;
    const { drag } = this;
    this.drag = null;
    if (this.pinch > 0) this.pinch = 0;
    else if (!this.hasMoved) this.clicked(event);
    else if (drag?.kind === 'sketch') this.map.editor.finishSketch();
    else if (drag?.kind === 'lasso-drones') this.selectInside();
  }

  private cancelled(event: PointerEvent): void {
    this.down.delete(event.pointerId);
    this.drag = null;
    this.pinch = 0;
  }

  private clicked(event: PointerEvent): void {
    const { editor } = this.map;
    if (event.button !== 0) return;
    if (editor.tool.value !== 'select') {
      if (!this.closesOutline(this.start)) editor.placeAt(this.map.worldAt(this.start));
      return;
    }
    const { under } = this;
    if (!under) {
      if (!event.shiftKey) editor.selectDrones([]);
      editor.select(null);
    } else if (under.part === 'drone') {
      if (event.shiftKey || event.ctrlKey || event.metaKey) editor.toggleDrone(under.drone);
      else editor.selectDrones([under.drone]);
    } else if (under.part === 'point') editor.select(under.which, under.index);
    else editor.select(under.which);
  }

  /** A click on the first corner closes the outline. */
  private closesOutline(s: Point): boolean {
    const { editor } = this.map;
    const first = editor.sketch.value[0];
    if (!first || editor.sketch.value.length < 3) return false;
    const away = distance(this.map.worldAt(s), first) * this.map.camera.value.pixelsPerMetre;
    if (away > kMouseReach) return false;
    editor.finishSketch();
    return true;
  }

  private doubleClicked(): void {
    const { editor } = this.map;
    const { sketch } = editor;
    if (sketch.value.length < 4) return;
    // The second click of the two has added a corner of its own.
    sketch.value = sketch.value.slice(0, -1);
    editor.finishSketch();
  }

  private selectInside(): void {
    const { editor } = this.map;
    const outline = editor.sketch.value;
    editor.sketch.value = [];
    editor.selectDronesInside(outline, this.map.dronePlaces());
  }

  private beginPinch(): void {
    this.drag = null;
    this.hasMoved = true; // whatever happens to the fingers now, it is no click
    this.map.editor.sketch.value = [];
    this.pinch = this.fingersApart();
    this.middle = this.fingersMiddle();
  }

  private fingersApart(): number {
    const [a, b] = [...this.down.values()];
    return a && b ? Math.max(1, distance(a, b)) : 1;
  }

  private fingersMiddle(): Point {
    const [a, b] = [...this.down.values()];
    return a && b ? [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] : this.middle;
  }

  /** What was between the fingers stays there. */
  private pinched(): void {
    const [apart, middle] = [this.fingersApart(), this.fingersMiddle()];
    this.map.pan(middle[0] - this.middle[0], middle[1] - this.middle[1]);
    if (this.pinch > 0) this.map.zoom(apart / this.pinch, middle);
    this.pinch = apart;
    this.middle = middle;
  }

  private wheeled(event: WheelEvent): void {
    event.preventDefault();
    const { editor } = this.map;
    const entry = editor.selectedEntry.value;
    const which = editor.selected.value;
    if (event.altKey && entry && which && 'weight' in entry) {
      editor.setWeight(which, entry.weight * (event.deltaY < 0 ? 1.1 : 1 / 1.1));
      return;
    }
    const lines = event.deltaMode === 1 ? 20 * event.deltaY : event.deltaY;
    this.map.zoom(Math.exp(-Math.max(-240, Math.min(240, lines)) * 0.0022), this.at(event));
  }

  /** Arrow keys move the map's own cursor; with Ctrl they move the map. */
  private arrowPressed(event: KeyboardEvent): void {
    const way = ({ ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] } as const)[event.key];
    const field = this.map.session.field.value;
    if (!way || !field) return;
    event.preventDefault();
    if (event.ctrlKey) {
      this.map.pan(-60 * way[0], 60 * way[1]);
      return;
    }
    const step = kArrowShare * Math.min(field.size[0], field.size[1]) * (event.shiftKey ? 5 : 1);
    const from = this.map.editor.cursor.value ?? field.centre;
    this.map.editor.cursor.value = field.clamped([from[0] + way[0] * step, from[1] + way[1] * step]);
  }
}
