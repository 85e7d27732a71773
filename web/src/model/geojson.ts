import { list, maybe, oneOf, record, ShapeError, text, finite, type Shape } from '../link/shape';
import { crossesItself, type Point } from './geometry';
import { freeName, type Edit, type Targets } from './targets';

/**
 * Areas as GeoJSON, in the mission's own world frame (metres, not longitude and latitude: a mission has no datum). The
 * collection says so in `frame`. Clusters are MultiPoints, areas and no-fly polygons are Polygons with a `kind`.
 */
export const kFrame = 'local metres, world frame of the mission';

const kMostFeatures = 1200;
const kMostPoints = 10_000;

export function writeAreas(targets: Targets): unknown {
  const closed = (outline: readonly Point[]): readonly Point[] => (outline[0] ? [...outline, outline[0]] : []);
  const feature = (kind: string, entry: object, geometry: unknown): unknown => ({
    type: 'Feature',
    // What an entry does not have is left out, not null: other readers expect numbers.
    properties: Object.fromEntries(Object.entries({ kind, ...entry }).filter(([, value]) => value !== null)),
    geometry,
  });
  return {
    type: 'FeatureCollection',
    frame: kFrame,
    features: [
      ...targets.clusters.map(({ points_m, ...rest }) =>
        feature('cluster', rest, { type: 'MultiPoint', coordinates: points_m }),
      ),
      ...targets.areas.map(({ outline_m, ...rest }) =>
        feature('area', rest, { type: 'Polygon', coordinates: [closed(outline_m)] }),
      ),
      ...targets.no_fly.map(({ outline_m, ...rest }) =>
        feature('no_fly', rest, { type: 'Polygon', coordinates: [closed(outline_m)] }),
      ),
    ],
  };
}

/** Positions may have a height, which is passed over. */
const position: Shape<Point> = (value, place) => {
  const numbers = list(finite, 4)(value, place);
  if (numbers.length < 2) throw new ShapeError(`${place}: a position [x, y] expected`);
  return [numbers[0]!, numbers[1]!];
};

const propertiesShape = record({
  kind: maybe(oneOf('cluster', 'area', 'no_fly')),
  name: maybe(text(64)),
  weight: maybe(finite),
  soft_edge_m: maybe(finite),
  revisit_s: maybe(finite),
});

const anyObject: Shape<Record<string, unknown>> = (value, place) => {
  if (typeof value !== 'object' || value === null) throw new ShapeError(`${place}: an object expected`);
  return value as Record<string, unknown>;
};

const featureShape = record({ geometry: anyObject, properties: maybe(propertiesShape) });
const collectionShape = record({
  type: oneOf('FeatureCollection'),
  features: list(featureShape, kMostFeatures),
});

type Properties = Exclude<ReturnType<typeof featureShape>['properties'], null>;
const kNoProperties: Properties = { kind: null, name: null, weight: null, soft_edge_m: null, revisit_s: null };

/** The edits that add the file's features under free names, or why it cannot be read. */
export function readAreas(json: string, targets: Targets): Edit[] | string {
  try {
    const { features } = collectionShape(JSON.parse(json), 'file');
    if (features.length === 0) return 'there is no feature in it';
    let taken = targets;
    return features.map((feature, i) => {
      const edit = readFeature(feature.geometry, feature.properties ?? kNoProperties, `features[${i}]`, taken);
      if (edit.op === 'add') taken = withNameTaken(taken, edit);
      return edit;
    });
  } catch (error) {
    if (error instanceof ShapeError) return error.message;
    if (error instanceof SyntaxError) return 'it is not JSON';
    throw error;
  }
}

const withNameTaken = (targets: Targets, edit: Extract<Edit, { op: 'add' }>): Targets =>
  edit.kind === 'no_fly'
    ? { ...targets, no_fly: [...targets.no_fly, { name: edit.entry.name, outline_m: [] }] }
    : {
        ...targets,
        clusters: [...targets.clusters, { name: edit.entry.name, points_m: [], weight: 1, revisit_s: null }],
      };

function readFeature(geometry: Record<string, unknown>, properties: Properties, place: string, taken: Targets): Edit {
  const type = oneOf('Point', 'MultiPoint', 'Polygon')(geometry['type'], `${place}.geometry.type`);
  const { weight, revisit_s } = properties;
  const at = `${place}.geometry.coordinates`;
  if (type !== 'Polygon') {
    const points_m =
      type === 'Point'
        ? [position(geometry['coordinates'], at)]
        : list(position, kMostPoints)(geometry['coordinates'], at);
    if (points_m.length === 0) throw new ShapeError(`${at}: at least one point expected`);
    const name = freeName(taken, 'cluster', properties.name ?? 'imported');
    return { op: 'add', kind: 'cluster', entry: { name, points_m, weight: weight ?? 1, revisit_s } };
  }
  const outline_m = outlineOf(geometry['coordinates'], at);
  if (properties.kind === 'no_fly')
    return {
      op: 'add',
      kind: 'no_fly',
      entry: { name: freeName(taken, 'no_fly', properties.name ?? 'imported'), outline_m },
    };
  const name = freeName(taken, 'area', properties.name ?? 'imported');
  const entry = { name, outline_m, weight: weight ?? 5, soft_edge_m: properties.soft_edge_m ?? 0, revisit_s };
  return { op: 'add', kind: 'area', entry };
}

function outlineOf(coordinates: unknown, place: string): Point[] {
  const rings = list(list(position, 1001), 10)(coordinates, place);
  if (rings.length !== 1) throw new ShapeError(`${place}: one ring expected; holes are not known here`);
  const ring = rings[0]!;
  const [first, last] = [ring[0], ring[ring.length - 1]];
  const isClosed = first && last && first[0] === last[0] && first[1] === last[1];
  const outline = isClosed ? ring.slice(0, -1) : ring;
  if (outline.length < 3) throw new ShapeError(`${place}: at least three corners expected`);
  if (crossesItself(outline)) throw new ShapeError(`${place}: the outline crosses itself`);
  return outline;
}
