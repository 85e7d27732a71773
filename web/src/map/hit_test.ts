import { describe, expect, it } from 'vitest';
import { kNoTargets, type Targets } from '../model/targets';
import { hitAt, type HitScene } from './hit';

const targets: Targets = {
  ...kNoTargets,
  clusters: [{ name: 'east', points_m: [[1, 0], [1, 1]], weight: 1, revisit_s: null, protect: false }], // prettier-ignore
  areas: [{ name: 'ridge', outline_m: [[-3, -1], [-1, -1], [-2, 1]], weight: 1, soft_edge_m: 0, revisit_s: null, protect: false }], // prettier-ignore
};
// 100 CSS pixels a metre, the world's origin in the middle of 800 x 600.
const scene: HitScene = {
  camera: { centre: [0, 0], pixelsPerMetre: 100 },
  size: { width: 800, height: 600 },
  targets,
  selected: null,
  sigmaMin: 0.1,
  drones: new Float64Array([NaN, NaN, 0, 2]),
};

describe('hits', () => {
  it('The nearest drone within reach is hit; one that nobody has seen never is', () => {
    expect(hitAt(scene, [403, 104], 10)).toEqual({ part: 'drone', drone: 1 });
    expect(hitAt(scene, [403, 130], 10)).toBe(null);
  });

  it('A cluster is hit at its points, an area anywhere inside', () => {
    expect(hitAt(scene, [500, 200], 10)).toEqual({ part: 'body', which: { kind: 'cluster', name: 'east' } });
    expect(hitAt(scene, [200, 340], 10)).toEqual({ part: 'body', which: { kind: 'area', name: 'ridge' } });
    expect(hitAt(scene, [300, 200], 10)).toBe(null);
  });

  it('What is selected shows its points, its centre and its spread', () => {
    const selected = { ...scene, selected: { kind: 'cluster', name: 'east' } as const };
    expect(hitAt(selected, [501, 299], 10)).toMatchObject({ part: 'point', index: 0 });
    expect(hitAt(selected, [500, 250], 10)).toMatchObject({ part: 'centre' });
  });
});
