import { effect, signal } from '@preact/signals';
import type { Snapshot } from '../link/frames';
import { vectorOf } from '../model/drones';
import type { Point } from '../model/geometry';
import type { Editor } from '../session/editor';
import type { Foresight } from '../session/foresight';
import type { Session } from '../session/session';
import type { Settings } from '../session/settings';
import { boundsOf, fit, panned, toScreen, toWorld, zoomed, type Camera, type Size } from './camera';
import { DroneLayer, glyphSize } from './drone_layer';
import { DronePlaces } from './drone_places';
import { drawDroneNotes } from './drones_overlay';
import { drawGhosts } from './ghosts_overlay';
import type { Frame, Gl } from './gl';
import { drawGround, drawRulers } from './ground';
import { hitAt, type Hit } from './hit';
import { kPalettes } from './palette';
import type { Pen } from './pen';
import {
  ageStyle,
  agePicture,
  coveragePicture,
  coverageStyle,
  densityPicture,
  densityStyle,
  ghostStyle,
} from './pictures';
import { RasterLayer, type Placement } from './raster_layer';
import { drawSketch } from './sketch_overlay';
import { drawStations } from './stations_overlay';
import { drawTargets } from './targets_overlay';
import { TrailLayer } from './trail_layer';

const kFitMargin = 36;
/** The map's buttons stand there: a fitted field is beside them, not below. */
const kFitRightMargin = 72;
/** Trails of this many crossings of the field's longer side at full speed stay on the map. */
const kTrailCrossings = 5;

interface Layers {
  readonly density: RasterLayer;
  readonly ghost: RasterLayer;
  readonly coverage: RasterLayer;
  readonly age: RasterLayer;
  readonly trails: TrailLayer;
  readonly drones: DroneLayer;
}

/**
 * The field: a 2-D canvas with the ground, a WebGL2 canvas with everything that is large, and a 2-D canvas with text and
 * whatever is edited. Draws at most once a display frame, and only when something changed.
 */
export class MapView {
  readonly camera = signal<Camera>({ centre: [0, 0], pixelsPerMetre: 100 });
  readonly pointer = signal<Point | null>(null);
  /** Seconds that the age map's strongest tint stands for. */
  readonly ageScaleS = signal(10);
  /** Why there is no picture, where the browser cannot draw. */
  readonly problem = signal('');
  readonly canvas: HTMLCanvasElement;

  private readonly ground: HTMLCanvasElement;
  private readonly glCanvas: HTMLCanvasElement;
  private readonly gl: Gl | null;
  private layers: Layers | null = null;
  private size: Size = { width: 1, height: 1 };
  private readonly drones = new DronePlaces();
  private isDirty = true;
  private isGroundDirty = true;
  private fitted: unknown = null;
  /** Until somebody pans or zooms, the field stays fitted to a canvas that changes its size. */
  private staysFitted = true;
  private shown: Record<'density' | 'ghost' | 'coverage' | 'age' | 'trails' | 'mission', unknown> = {
    density: undefined,
    ghost: undefined,
    coverage: undefined,
    age: undefined,
    trails: undefined,
    mission: undefined,
  };
  private readonly stops: (() => void)[] = [];

  constructor(
    host: HTMLElement,
    readonly session: Session,
    readonly editor: Editor,
    readonly settings: Settings,
    readonly foresight: Foresight,
  ) {
    [this.ground, this.glCanvas, this.canvas] = ['ground', 'picture', 'notes'].map((name) => {
      const canvas = document.createElement('canvas');
      canvas.className = `map-${name}`;
      canvas.setAttribute('aria-hidden', 'true');
      return host.appendChild(canvas);
    }) as [HTMLCanvasElement, HTMLCanvasElement, HTMLCanvasElement];
    this.gl = this.glCanvas.getContext('webgl2', { premultipliedAlpha: true, antialias: false, alpha: true });
    this.glCanvas.addEventListener('webglcontextlost', (event) => event.preventDefault());
    this.glCanvas.addEventListener('webglcontextrestored', () => this.makeLayers());
    this.makeLayers();
    this.listen(host);
  }

  private makeLayers(): void {
    const { gl } = this;
    if (!gl) {
      this.problem.value =
        'This browser has no WebGL2, so the map shows no density and no trails. The tables show everything.';
      return;
    }
    this.layers = {
      density: new RasterLayer(gl),
      ghost: new RasterLayer(gl),
      coverage: new RasterLayer(gl),
      age: new RasterLayer(gl),
      trails: new TrailLayer(gl),
      drones: new DroneLayer(gl),
    };
    for (const key of Object.keys(this.shown)) this.shown[key as keyof typeof this.shown] = undefined;
    this.isDirty = true;
  }

  private listen(host: HTMLElement): void {
    const resized = new ResizeObserver(() => this.resize(host));
    resized.observe(host);
    this.stops.push(() => resized.disconnect());
    this.stops.push(
      effect(() => this.watchGround()),
      effect(() => this.watchNotes()),
    );
    this.stops.push(this.session.onSnapshot((snapshot) => this.snapshotCame(snapshot)));
    let handle = 0;
    const turn = (): void => {
      handle = requestAnimationFrame(turn);
      this.drawIfNeeded();
    };
    handle = requestAnimationFrame(turn);
    this.stops.push(() => cancelAnimationFrame(handle));
  }

  /** Reads every signal that the ground depends on: a change of any makes the next frame draw it. */
  private watchGround(): void {
    const { session, settings } = this;
    for (const read of [settings.theme, settings.layers, this.camera, session.mission, session.isLive]) void read.value;
    this.isDirty = this.isGroundDirty = true;
    const field = session.field.value;
    if (field && field !== this.fitted) {
      this.fitted = field;
      queueMicrotask(() => this.fitField());
    }
  }

  /** The same for what is drawn over it. */
  private watchNotes(): void {
    const { session, editor } = this;
    for (const read of [session.draft, session.committed, session.operators, session.status, session.beat])
      void read.value;
    for (const read of [editor.selected, editor.selectedPoint, editor.selectedDrones, editor.sketch, editor.measured])
      void read.value;
    for (const read of [editor.cursor, editor.tool, this.pointer, this.foresight.answer]) void read.value;
    this.isDirty = true;
  }

  close(): void {
    for (const stop of this.stops) stop();
  }

  // --- camera -----------------------------------------------------------------------------------------------------

  fitField(): void {
    const field = this.session.field.value;
    this.staysFitted = true;
    if (field) this.camera.value = fit(boundsOf(field.corners()), this.size, kFitMargin, kFitRightMargin);
  }

  pan(dx: number, dy: number): void {
    this.staysFitted = false;
    this.camera.value = panned(this.camera.value, dx, dy);
  }

  zoom(factor: number, at: Point = [this.size.width / 2, this.size.height / 2]): void {
    this.staysFitted = false;
    this.camera.value = zoomed(this.camera.value, this.size, at, factor);
  }

  worldAt = (s: Point): Point => toWorld(this.camera.value, this.size, s);

  hit(s: Point, reach: number): Hit | null {
    return hitAt(
      {
        camera: this.camera.value,
        size: this.size,
        targets: this.session.draft.value,
        selected: this.editor.selected.value,
        sigmaMin: this.sigmaMin(),
        drones: this.drones.places,
      },
      s,
      reach,
    );
  }

  /** Selects what lies at a place of the world, as a click there would. */
  selectAt(world: Point): void {
    const found = this.hit(toScreen(this.camera.value, this.size, world), 24);
    if (found?.part === 'drone') this.editor.selectDrones([found.drone]);
    else if (found?.part === 'point') this.editor.select(found.which, found.index);
    else this.editor.select(found?.which ?? null);
  }

  sigmaMin = (): number => this.session.mission.value?.display.sigma_min_m ?? 0.1;

  /** Where drones are drawn: world frame, x and y by turns. */
  dronePlaces = (): Float64Array => this.drones.places;

  private resize(host: HTMLElement): void {
    const { width, height } = host.getBoundingClientRect();
    if (width < 2 || height < 2) return;
    this.size = { width, height };
    for (const canvas of [this.ground, this.glCanvas, this.canvas]) {
      canvas.width = Math.round(width * this.pixelRatio());
      canvas.height = Math.round(height * this.pixelRatio());
    }
    if (this.staysFitted) this.fitField();
    this.isDirty = this.isGroundDirty = true;
  }

  private pixelRatio = (): number => Math.min(2, window.devicePixelRatio || 1);

  // --- drawing ----------------------------------------------------------------------------------------------------

  private drawIfNeeded(): void {
    const isMoving = this.session.isLive.value && this.session.snapshot !== null && !this.session.snapshot.isPaused;
    this.upload();
    if (!this.isDirty && !isMoving) return;
    if (this.isGroundDirty) this.drawGround();
    this.isDirty = this.isGroundDirty = false;
    this.placeDrones();
    this.drawPicture();
    this.drawNotes();
  }

  private penOf(canvas: HTMLCanvasElement): Pen {
    const context = canvas.getContext('2d')!;
    const ratio = this.pixelRatio();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    return { context, camera: this.camera.value, size: this.size, palette: kPalettes[this.settings.theme.value] };
  }

  /**
   * Ground, grid and tints change a few times a second at most: the GPU paints the tints, the ground's canvas keeps them,
   * and a frame in which only drones move does not paint them again.
   */
  private drawGround(): void {
    const pen = this.penOf(this.ground);
    const field = this.session.field.value;
    drawGround(pen, field, this.settings.layers.value.has('grid'));
    const { gl, layers } = this;
    if (!gl || !layers || !field || !this.beginPicture(gl)) return;
    this.drawRasters(layers, this.frame(field.centre));
    pen.context.drawImage(this.glCanvas, 0, 0, this.size.width, this.size.height);
  }

  private beginPicture(gl: Gl): boolean {
    if (gl.isContextLost()) return false;
    gl.viewport(0, 0, this.glCanvas.width, this.glCanvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    return true;
  }

  private placeDrones(): void {
    const { snapshot } = this.session;
    const field = this.session.field.value;
    if (!snapshot || !field) return;
    const ahead = this.session.isLive.value ? (this.session.world.nowMs() - this.session.snapshotAtMs) / 1000 : 0;
    this.drones.update(snapshot, field, ahead, this.editor.selectedDrones.value);
  }

  private drawPicture(): void {
    const { gl, layers } = this;
    const field = this.session.field.value;
    if (gl && layers && this.beginPicture(gl) && field) this.drawMovers(layers, this.frame(field.centre));
  }

  private frame(origin: Point): Frame {
    const { centre, pixelsPerMetre } = this.camera.value;
    return {
      pixelsPerMetre,
      ...this.size,
      centre: [centre[0] - origin[0], centre[1] - origin[1]],
      devicePixelRatio: this.pixelRatio(),
      drained: this.session.isLive.value ? 0 : 1,
    };
  }

  private drawRasters(layers: Layers, frame: Frame): void {
    const palette = kPalettes[this.settings.theme.value];
    const on = this.settings.layers.value;
    const placement = this.placement();
    if (on.has('age')) layers.age.draw(frame, placement, ageStyle(palette));
    if (on.has('coverage')) layers.coverage.draw(frame, placement, coverageStyle(palette));
    if (!on.has('density')) return;
    const isGhosted = this.session.ghost !== null;
    layers.density.draw(frame, placement, densityStyle(palette, isGhosted));
    if (isGhosted) layers.ghost.draw(frame, placement, ghostStyle(palette));
  }

  private drawMovers(layers: Layers, frame: Frame): void {
    const palette = kPalettes[this.settings.theme.value];
    const { snapshot } = this.session;
    const on = this.settings.layers.value;
    if (!snapshot) return;
    const display = this.session.mission.value?.display;
    if (on.has('trails'))
      layers.trails.draw(frame, snapshot.timeS, {
        colours: palette.trails,
        casing: palette.casing,
        casingAlpha: snapshot.n > 300 ? 0 : palette.casingAlpha,
        width: snapshot.n <= 30 ? 2.2 : snapshot.n <= 300 ? 1.5 : 1.1,
        alpha: snapshot.n > 2000 ? 0.5 : 0.95,
      });
    if (!on.has('drones')) return;
    layers.drones.set(this.drones.instances);
    layers.drones.draw(frame, {
      colours: [palette.active, palette.away, palette.failed],
      outline: palette.outline,
      ring: palette.coverage,
      ringAlpha: 0.7,
      size: glyphSize(snapshot.n, frame.pixelsPerMetre, display?.separation_m ?? 0),
      radius: on.has('radii') ? (display?.separation_m ?? 0) / 2 : 0,
    });
  }

  private placement(): Placement {
    const field = this.session.field.value!;
    const relative = (p: Point): Point => [p[0] - field.centre[0], p[1] - field.centre[1]];
    return {
      corner: relative(field.toWorld([0, 0])),
      along1: field.turned([field.size[0], 0]),
      along2: field.turned([0, field.size[1]]),
    };
  }

  /** Hands to the GPU what came since the last frame. */
  private upload(): void {
    const { session, shown, layers } = this;
    if (!layers || !session.field.value || this.gl!.isContextLost()) return;
    if (shown.mission !== session.mission.value) {
      shown.mission = session.mission.value;
      layers.trails.reset(session.droneIds.value.length, this.trailMemoryS());
    }
    if (shown.trails !== session.trails) this.uploadTrails(layers);
    for (const key of ['density', 'ghost'] as const) {
      const data = session[key];
      if (shown[key] === data) continue;
      shown[key] = data;
      layers[key].set(densityPicture(data));
      this.isDirty = this.isGroundDirty = true;
    }
    const on = this.settings.layers.value;
    if (shown.coverage !== session.coverage && on.has('coverage')) this.uploadCoverage(layers);
    if (shown.age !== session.ageMap && on.has('age')) this.uploadAge(layers);
  }

  /** Every snapshot leaves its mark on the trails, also those that no display frame shows. */
  private snapshotCame(snapshot: Snapshot): void {
    const { layers } = this;
    if (!layers || this.shown.mission !== this.session.mission.value || this.gl!.isContextLost()) return;
    layers.trails.extend(snapshot.timeS, () => ({
      positions: this.relativePositions(snapshot.position),
      velocities: this.turnedVelocities(snapshot),
    }));
  }

  private trailMemoryS(): number {
    const display = this.session.mission.value?.display;
    if (!display) return 60;
    const longer = Math.max(display.field.length_x_m, display.field.length_y_m);
    return (kTrailCrossings * longer) / display.speed_limit_m_s;
  }

  private relativePositions(positions: Float32Array): Float32Array {
    const field = this.session.field.value!;
    const relative = new Float32Array(positions.length);
    for (let i = 0; i < positions.length; i += 2) {
      const [x, y] = field.turned([positions[i]! - field.size[0] / 2, positions[i + 1]! - field.size[1] / 2]);
      relative[i] = x;
      relative[i + 1] = y;
    }
    return relative;
  }

  private turnedVelocities(snapshot: Snapshot): Float32Array {
    const field = this.session.field.value!;
    const turned = new Float32Array(2 * snapshot.n);
    for (let drone = 0; drone < snapshot.n; drone++)
      turned.set(field.turned(vectorOf(snapshot, drone, 'velocity')), 2 * drone);
    return turned;
  }

  private uploadTrails(layers: Layers): void {
    const { trails } = this.session;
    this.shown.trails = trails;
    if (!trails || trails.n !== this.session.droneIds.value.length) return;
    layers.trails.reset(trails.n, this.trailMemoryS());
    const row = new Float32Array(2 * trails.n);
    const velocities = new Float32Array(2 * trails.n); // its points are close enough: no need to know
    for (let k = 0; k < trails.points; k++) {
      for (let drone = 0; drone < trails.n; drone++) {
        const from = 2 * (drone * trails.points + k);
        row[2 * drone] = trails.position[from]!;
        row[2 * drone + 1] = trails.position[from + 1]!;
      }
      layers.trails.extend(trails.timeS - (trails.points - 1 - k) * trails.spacingS, () => ({
        positions: this.relativePositions(row),
        velocities,
      }));
    }
  }

  private uploadCoverage(layers: Layers): void {
    const { coverage, density } = this.session;
    this.shown.coverage = coverage;
    this.isDirty = this.isGroundDirty = true;
    layers.coverage.set(coveragePicture(coverage, density));
  }

  private uploadAge(layers: Layers): void {
    const { ageMap, committed } = this.session;
    this.shown.age = ageMap;
    this.isDirty = this.isGroundDirty = true;
    const watched = [...committed.value.clusters, ...committed.value.areas];
    const longest = watched.reduce((most, entry) => Math.max(most, entry.revisit_s ?? 0), 0);
    const picture = ageMap && agePicture(ageMap, longest || null);
    if (picture) this.ageScaleS.value = picture.scaleS;
    layers.age.set(picture);
  }

  private drawNotes(): void {
    const pen = this.penOf(this.canvas);
    pen.context.clearRect(0, 0, this.size.width, this.size.height);
    const { session, editor } = this;
    const field = session.field.value;
    if (!field) return;
    const on = this.settings.layers.value;
    drawTargets(pen, {
      committed: session.committed.value,
      draft: session.draft.value,
      selected: editor.selected.value,
      selectedPoint: editor.selectedPoint.value,
      sigmaMin: this.sigmaMin(),
      showsNoFly: on.has('noFly'),
      showsLabels: on.has('labels'),
      editedBy: this.editedBy(),
      overdue: new Set(session.status.value?.areas.filter((area) => area.is_overdue).map((area) => area.name)),
    });
    drawStations(pen, session.mission.value?.mission.stations ?? [], on.has('labels'));
    const preview = this.foresight.answer.value;
    if (session.snapshot && preview && preview.epoch === session.mission.value?.epoch)
      drawGhosts(pen, { preview, timeS: session.snapshot.timeS, selected: editor.selectedDrones.value });
    if (session.snapshot && on.has('drones'))
      drawDroneNotes(pen, {
        snapshot: session.snapshot,
        places: this.drones.places,
        ids: session.droneIds.value,
        selected: editor.selectedDrones.value,
        hovered: this.hovered(),
        field,
        noFly: session.committed.value.no_fly,
        showsLabels: on.has('labels'),
      });
    drawSketch(pen, {
      tool: editor.tool.value,
      sketch: editor.sketch.value,
      measured: editor.measured.value,
      pointer: this.pointer.value,
      cursor: editor.cursor.value,
      extent: Math.max(...field.size),
    });
    if (on.has('grid')) drawRulers(pen);
  }

  private hovered(): number | null {
    const pointer = this.pointer.value;
    const found = pointer && this.hit(toScreen(this.camera.value, this.size, pointer), 12);
    return found?.part === 'drone' ? found.drone : null;
  }

  private editedBy(): ReadonlyMap<string, string> {
    const own = this.session.hello.value?.client;
    return new Map(
      this.session.operators.value
        .filter((operator) => operator.client !== own)
        .flatMap((operator) => operator.editing.map((what) => [`${what.kind} ${what.name}`, operator.name] as const)),
    );
  }
}
