import { describe, expect, it } from 'vitest';
import { readAreas, writeAreas } from './geojson';
import { apply, kNoTargets, type Edit, type Targets } from './targets';

const targets: Targets = {
  clusters: [{ name: 'east', points_m: [[1, 2], [3, 4]], weight: 2, revisit_s: 30, protect: false }], // prettier-ignore
  areas: [{ name: 'ridge', outline_m: [[0, 0], [1, 0], [0, 1]], weight: 5, soft_edge_m: 0.5, revisit_s: null, protect: false }], // prettier-ignore
  no_fly: [{ name: 'road', outline_m: [[5, 5], [6, 5], [5, 6]] }], // prettier-ignore
  uniform_floor: 0,
};

const applied = (edits: Edit[] | string, base: Targets): Targets | null => {
  if (typeof edits === 'string') throw new Error(edits);
  return edits.reduce<Targets | null>((draft, edit) => draft && apply(draft, edit), base);
};

const kMetres = { frame: 'world', unit: 'm' };

describe('GeoJSON', () => {
  it('What is exported comes back the same', () => {
    expect(applied(readAreas(JSON.stringify(writeAreas(targets)), kNoTargets), kNoTargets)).toEqual(targets);
  });

  it('An entry without a deadline has no deadline in the file', () => {
    expect(JSON.stringify(writeAreas(targets))).not.toMatch('null');
  });

  const square = (x: number) => [[[x, 0], [x + 1, 0], [x + 1, 1], [x, 1], [x, 0]]]; // prettier-ignore
  const collection = (geometry: unknown, properties: unknown = null): string =>
    JSON.stringify({
      type: 'FeatureCollection',
      vigil: kMetres,
      features: [{ type: 'Feature', properties, geometry }],
    });

  it('What has the name of an entry of its kind replaces it, what has no name gets a free one', () => {
    const heavier = { ...targets, areas: [{ ...targets.areas[0]!, weight: 9 }] };
    expect(applied(readAreas(JSON.stringify(writeAreas(heavier)), targets), targets)).toEqual(heavier);
    const nameless = collection({ type: 'Polygon', coordinates: square(0) });
    const once = applied(readAreas(nameless, targets), targets)!;
    expect(applied(readAreas(nameless, once), once)?.areas.map((entry) => entry.name)).toEqual(
      ['ridge', 'imported', 'imported-2'], // prettier-ignore
    );
  });

  it('Degrees are never taken for metres', () => {
    const file = JSON.parse(collection({ type: 'Polygon', coordinates: square(0) })) as Record<string, unknown>;
    const crs = { type: 'name', properties: { name: 'urn:ogc:def:crs:OGC:1.3:CRS84' } };
    for (const says of [
      { vigil: undefined },
      { vigil: { ...kMetres, frame: 'WGS84' } },
      { crs },
      { vigil: { ...kMetres, unit: 'ft' } },
    ])
      expect(readAreas(JSON.stringify({ ...file, ...says }), targets)).toMatch(/longitude and latitude/);
    expect(readAreas(JSON.stringify(file), targets)).toHaveLength(1);
  });

  it('A name of the other kind, and one that is there twice, are refused', () => {
    expect(readAreas(collection({ type: 'Polygon', coordinates: square(0) }, { name: 'east' }), targets)).toBe(
      'features[0]: east is the name of a cluster already',
    );
    const { features } = writeAreas(targets) as { features: unknown[] };
    const twice = JSON.stringify({ type: 'FeatureCollection', vigil: kMetres, features: [...features, features[1]] });
    expect(readAreas(twice, kNoTargets)).toBe('features[3]: the name ridge is there twice');
  });

  it('Every polygon of a MultiPolygon is an entry, with a number where there are several', () => {
    const both = { type: 'MultiPolygon', coordinates: [square(0), square(2)] };
    const areas = applied(readAreas(collection(both, { name: 'wood', weight: 3 }), targets), targets)!.areas.slice(1);
    expect(areas.map(({ name, weight, outline_m }) => [name, weight, outline_m[0]])).toEqual([
      ['wood-1', 3, [0, 0]],
      ['wood-2', 3, [2, 0]],
    ]);
    const one = collection({ type: 'MultiPolygon', coordinates: [square(0)] }, { name: 'lake', kind: 'no_fly' });
    expect(applied(readAreas(one, targets), targets)?.no_fly.map((entry) => entry.name)).toEqual(['road', 'lake']);
  });

  it('A hole is refused with the reason', () => {
    const holed = [...square(0), ...square(0)];
    expect(readAreas(collection({ type: 'Polygon', coordinates: holed }), kNoTargets)).toMatch(/2 rings.*no hole/);
    expect(readAreas(collection({ type: 'MultiPolygon', coordinates: [square(0), holed] }), kNoTargets)).toMatch(
      /coordinates\[1\]: has 2 rings/,
    );
  });

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
