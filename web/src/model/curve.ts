/** What remains of both ends' places and velocities at a share of the way: see `curveAt`. */
export interface CurveWeights {
  readonly place0: number;
  readonly place1: number;
  /** Times the time between both ends. */
  readonly velocity0: number;
  readonly velocity1: number;
}

/** The cubic that has the places and the velocities of both ends (Hermite); `share` of the time between them, 0 to 1. */
export function curveAt(share: number): CurveWeights {
  const [s2, s3] = [share ** 2, share ** 3];
  return {
    place0: 2 * s3 - 3 * s2 + 1,
    place1: 3 * s2 - 2 * s3,
    velocity0: s3 - 2 * s2 + share,
    velocity1: s3 - s2,
  };
}
