/**
 * The Fourier basis (5) on a grid: what the swarm has covered, as a picture, from the coefficients c_k that arrive.
 * f_k(q) = cos(k1 pi q1/L1) cos(k2 pi q2/L2) / h_k, h_k^2 = L1 L2 times 1, 1/2 or 1/4 for no, one or two indices not 0.
 */
export interface Grid {
  readonly width: number;
  readonly height: number;
  /** Row by row, the row of the smallest q2 first. Values at cell midpoints, 1/m^2. */
  readonly values: Float32Array;
}

/**
 * sum over k of c_k f_k at the cell midpoints of a grid. `coefficients` has (K+1)^2 entries; index k1 + (K+1) k2.
 * Two products, one per axis: (K+1)^2 width + (K+1) width height multiplications.
 */
export function reconstruct(
  coefficients: ArrayLike<number>,
  size: readonly [number, number],
  width: number,
  height: number,
): Grid {
  const n = Math.round(Math.sqrt(coefficients.length));
  const alongX = cosines(n, width, size[0]);
  const alongY = cosines(n, height, size[1]);
  const values = new Float32Array(width * height);
  const perColumn = new Float64Array(n);
  for (let x = 0; x < width; x++) {
    for (let k2 = 0; k2 < n; k2++) {
      let sum = 0;
      for (let k1 = 0; k1 < n; k1++) sum += coefficients[k1 + n * k2]! * alongX[k1 * width + x]!;
      perColumn[k2] = sum;
    }
    for (let y = 0; y < height; y++) {
      let sum = 0;
      for (let k2 = 0; k2 < n; k2++) sum += perColumn[k2]! * alongY[k2 * height + y]!;
      values[y * width + x] = sum;
    }
  }
  return { width, height, values };
}

/** cos(k pi q/L) over the axis' share of h_k, for every k and every midpoint q. */
function cosines(n: number, cells: number, length: number): Float64Array {
  const table = new Float64Array(n * cells);
  for (let k = 0; k < n; k++) {
    const norm = Math.sqrt(k === 0 ? length : length / 2);
    for (let i = 0; i < cells; i++) table[k * cells + i] = Math.cos((k * Math.PI * (i + 0.5)) / cells) / norm;
  }
  return table;
}

/** A grid for a field of this shape: `cells` along the longer side, in proportion along the other. */
export function gridShape(size: readonly [number, number], cells: number): [number, number] {
  const longer = Math.max(size[0], size[1]);
  return [Math.max(8, Math.round((cells * size[0]) / longer)), Math.max(8, Math.round((cells * size[1]) / longer))];
}
