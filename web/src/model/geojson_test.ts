import { describe, expect, it } from 'vitest';
import { readAreas, writeAreas } from './geojson';
import { apply, kNoTargets, type Edit, type Targets } from './targets';

const targets: Targets = {
  clusters: [{ name: 'east', points_m: [[1, 2], [3, 4]], weight: 2, revisit_s: 30 }], // prettier-ignore
  areas: [{ name: 'ridge', outline_m: [[0, 0], [1, 0], [0, 1]], weight: 5, soft_edge_m: 0.5, revisit_s: null }], // prettier-ignore
  no_fly: [{ name: 'road', outline_m: [[5, 5], [6, 5], [5, 6]] }], // prettier-ignore
  uniform_floor: 0,
};

const applied = (edits: Edit[] | string, base: Targets): Targets | null => {
  if (typeof edits === 'string') throw new Error(edits);
  return edits.reduce<Targets | null>((draft, edit) => draft && apply(draft, edit), base);
};

describe('GeoJSON', () => {
  it('What is exported comes back the same', () => {
    expect(applied(readAreas(JSON.stringify(writeAreas(targets)), kNoTargets), kNoTargets)).toEqual(targets);
  });

  it('An entry without a deadline has no deadline in the file', () => {
    expect(JSON.stringify(writeAreas(targets))).not.toMatch('null');
  });

  it('Names that are taken get a number', () => {
    const twice = applied(readAreas(JSON.stringify(writeAreas(targets)), targets), targets);
    expect(twice?.areas.map((entry) => entry.name)).toEqual(['ridge', 'ridge-2']);
    expect(twice?.no_fly.map((entry) => entry.name)).toEqual(['road', 'road-2']);
  });

  const collection = (geometry: unknown): string =>
    JSON.stringify({ type: 'FeatureCollection', features: [{ type: 'Feature', properties: null, geometry }] });

  it('What cannot be read is refused with the place', () => {
    expect(readAreas('{', kNoTargets)).toBe('it is not JSON');
    expect(readAreas('{"type":"Feature"}', kNoTargets)).toMatch(/file.type: FeatureCollection/);
    expect(readAreas(collection({ type: 'LineString', coordinates: [] }), kNoTargets)).toMatch(
      /features\[0\].geometry.type/,
    );
    expect(readAreas(collection({ type: 'Polygon', coordinates: [[[0, 0], [1, 1]]] }), kNoTargets)).toMatch(/three corners/); // prettier-ignore
    expect(
      readAreas(collection({ type: 'Polygon', coordinates: [[[0, 0], [1, 1], [1, 0], [0, 1]]] }), kNoTargets), // prettier-ignore
    ).toMatch(/crosses itself/);
    expect(readAreas(collection({ type: 'Point', coordinates: ['a', 1] }), kNoTargets)).toMatch(/a number expected/);
  });
});
