import type { Preview } from '../link/messages';
import { trailAhead } from '../model/outlook';
import { at, tracePath, type Pen } from './pen';

/** Where drones would fly: dashed, hollow at the end, and in a colour that nothing else on the map has. */
export interface GhostsScene {
  readonly preview: Preview;
  /** The mission's time now, s. */
  readonly timeS: number;
  readonly selected: ReadonlySet<number>;
}

/** A screen full of dashes says nothing: with more drones than this, only the selected ones' ghosts are drawn. */
export const kMostGhosts = 100;

export function drawGhosts(pen: Pen, scene: GhostsScene): void {
  const { xy_m: trails, spacing_s: spacingS } = scene.preview.ghosts;
  const elapsedS = scene.timeS - scene.preview.time_s;
  const shown = trails.length <= kMostGhosts ? trails.keys() : [...scene.selected].slice(0, kMostGhosts);
  for (const drone of shown) drawGhost(pen, trailAhead(trails[drone] ?? [], spacingS, elapsedS));
}

function drawGhost(pen: Pen, points: ReturnType<typeof trailAhead>): void {
  const { context, palette } = pen;
  const end = points[points.length - 1];
  if (!end || points.length < 2) return;
  for (const [colour, width, dash] of [
    [palette.halo, 4, []],
    [palette.ghost, 2, [3, 5]],
  ] as const) {
    context.strokeStyle = colour;
    context.lineWidth = width;
    context.lineCap = 'round';
    context.setLineDash([...dash]);
    tracePath(pen, points, false);
    context.stroke();
  }
  context.setLineDash([]);
  context.lineCap = 'butt';
  context.beginPath();
  context.arc(...at(pen, end), 5, 0, 2 * Math.PI);
  context.fillStyle = palette.halo;
  context.fill();
  context.strokeStyle = palette.ghost;
  context.stroke();
}
