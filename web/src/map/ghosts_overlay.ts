import type { Preview } from '../link/messages';
import type { Point } from '../model/geometry';
import { trailAhead } from '../model/outlook';
import { at, tracePath, type Pen } from './pen';

/** Where drones would fly: dashed, fading, hollow at the end, and in a colour that nothing else on the map has. */
export interface GhostsScene {
  readonly preview: Preview;
  /** The mission's time now, s. */
  readonly timeS: number;
  readonly selected: ReadonlySet<number>;
}

/** A screen full of dashes says nothing: with more drones than this, only the selected ones' ghosts are drawn. */
export const kMostGhosts = 100;
/** A minute of paths over the same places is a knot; so much of it, s, shows where each drone goes next. */
const kGhostS = 12;
/** In so many steps a path fades to so much of its strength. */
const kFadeSteps = 4;
const kFaintest = 0.35;

export function drawGhosts(pen: Pen, scene: GhostsScene): void {
  const { xy_m: trails, spacing_s: spacingS } = scene.preview.ghosts;
  const elapsedS = scene.timeS - scene.preview.time_s;
  const shown = trails.length <= kMostGhosts ? trails.keys() : [...scene.selected].slice(0, kMostGhosts);
  for (const drone of shown) drawGhost(pen, trailAhead(trails[drone] ?? [], spacingS, elapsedS, kGhostS));
}

function drawGhost(pen: Pen, points: readonly Point[]): void {
  const { context, palette } = pen;
  const end = points[points.length - 1];
  if (!end || points.length < 2) return;
  for (let step = 0; step < kFadeSteps; step++) {
    context.globalAlpha = 1 - ((1 - kFaintest) * step) / (kFadeSteps - 1);
    drawPiece(pen, piece(points, step));
  }
  context.globalAlpha = 1;
  context.beginPath();
  context.arc(...at(pen, end), 5, 0, 2 * Math.PI);
  context.fillStyle = palette.halo;
  context.fill();
  context.strokeStyle = palette.ghost;
  context.stroke();
}

/** One of the steps in which a path fades; each begins where the one before it ends. */
function piece(points: readonly Point[], step: number): readonly Point[] {
  const at = (n: number): number => Math.round((n * (points.length - 1)) / kFadeSteps);
  return points.slice(at(step), at(step + 1) + 1);
}

function drawPiece(pen: Pen, points: readonly Point[]): void {
  const { context, palette } = pen;
  if (points.length < 2) return;
  context.lineCap = 'round';
  for (const [colour, width, dash] of [
    [palette.halo, 4, []],
    [palette.ghost, 2, [3, 5]],
  ] as const) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.setLineDash([...dash]);
    tracePath(pen, points, false);
    context.stroke();
  }
  context.setLineDash([]);
  context.lineCap = 'butt';
}
