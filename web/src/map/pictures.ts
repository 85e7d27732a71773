import type { AgeMap, Coverage, Density } from '../link/frames';
import { gridShape, reconstruct } from '../model/basis';
import { ageScale } from './legend';
import type { Palette } from './palette';
import type { RasterData, RasterStyle } from './raster_layer';

/** What the tints of the map show, made from what the program sends, and how each is painted. */

const kCoverageCells = 96;

const kPlain = { contour: [0, 0, 0], mostAlpha: 0.7, gamma: 1, contours: 0, contourAlpha: 0, striped: false } as const;
const kContours = { contours: 7, contourAlpha: 0.8, gamma: 0.7 } as const;

export function densityPicture(density: Density | null): RasterData | null {
  if (!density || density.isEmpty) return null;
  const { width, height, cells } = density;
  return { width, height, values: Float32Array.from(cells, (cell) => cell / 65535) };
}

/** On the importance's own scale, so that the two maps can be held against each other. */
export function coveragePicture(coverage: Coverage | null, density: Density | null): RasterData | null {
  if (!coverage?.hasSamples) return null;
  const size = [coverage.lengthX, coverage.lengthY] as const;
  const grid = reconstruct(coverage.coefficients, size, ...gridShape(size, kCoverageCells));
  const peak = grid.values.reduce(
    (most, value) => Math.max(most, value),
    density && !density.isEmpty ? density.peak : 0,
  );
  return { ...grid, values: grid.values.map((value) => Math.max(0, value / (peak || 1))) };
}

/** The picture, and the seconds that its strongest tint stands for; `deadlineS`: the longest of all areas. */
export function agePicture(age: AgeMap, deadlineS: number | null): RasterData & { scaleS: number } {
  const oldest = age.cells.reduce((most, cell) => (cell < 65534 && cell > most ? cell : most), 0) / 10;
  const scaleS = ageScale(oldest, deadlineS);
  const values = Float32Array.from(age.cells, (cell) => Math.min(1, cell / 10 / scaleS));
  return { width: age.width, height: age.height, values, scaleS };
}

export const ageStyle = (palette: Palette): RasterStyle => ({
  ...kPlain,
  tint: palette.age,
  mostAlpha: 0.55,
  gamma: 1.3,
});

export const coverageStyle = (palette: Palette): RasterStyle => ({
  ...kPlain,
  tint: palette.coverage,
  contour: palette.coverage,
  contours: 6,
  contourAlpha: 0.6,
  gamma: 0.8,
});

/** While an edit is staged, what is committed steps back behind its ghost. */
export const densityStyle = (palette: Palette, isGhosted: boolean): RasterStyle => ({
  ...kPlain,
  tint: palette.density,
  contour: palette.densityContour,
  ...(isGhosted ? { mostAlpha: 0.25, gamma: 0.7 } : { mostAlpha: 0.85, ...kContours }),
});

export const ghostStyle = (palette: Palette): RasterStyle => ({
  ...kPlain,
  tint: palette.density,
  contour: palette.densityContour,
  mostAlpha: 0.85,
  ...kContours,
  striped: true,
});
