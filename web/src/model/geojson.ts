import { flag, list, maybe, oneOf, record, ShapeError, text, finite, type Shape } from '../link/shape';
import { crossesItself, type Point } from './geometry';
import { apply, find, freeName, type Edit, type Entry, type Kind, type Targets } from './targets';

/**
 * Areas as GeoJSON, in the mission's own world frame (metres, not longitude and latitude, whatever datum it has). The
 * collection says so in `vigil`, as the program's do. Clusters are MultiPoints, areas and no-fly polygons are Polygons with a `kind`.
 */
const kMetres = { frame: 'world', unit: 'm' };

const kMostFeatures = 1200;
const kMostPoints = 10_000;
const kMostPolygons = 200;

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
    vigil: kMetres,
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
  protect: maybe(flag),
});

const anyObject: Shape<Record<string, unknown>> = (value, place) => {
  if (typeof value !== 'object' || value === null) throw new ShapeError(`${place}: an object expected`);
  return value as Record<string, unknown>;
};

const featureShape = record({ geometry: anyObject, properties: maybe(propertiesShape) });
const collectionShape = record({
  type: oneOf('FeatureCollection'),
  vigil: maybe(record({ frame: text(80), unit: text(80) })),
  crs: maybe(anyObject),
  features: list(featureShape, kMostFeatures),
});

type Properties = Exclude<ReturnType<typeof featureShape>['properties'], null>;
const kNoProperties: Properties = {
  kind: null,
  name: null,
  weight: null,
  soft_edge_m: null,
  revisit_s: null,
  protect: null,
};

/** Any other GeoJSON is in degrees (RFC 7946, 4), and a valley in degrees is a millimetre wide in metres. */
const isInMetres = ({ vigil, crs }: ReturnType<typeof collectionShape>): boolean =>
  crs === null && vigil?.frame === kMetres.frame && vigil.unit === kMetres.unit;

const kDegrees =
  'it does not say that it is in metres, so it is in longitude and latitude, which are not read here; convert it to ' +
  'metres of the mission’s world frame, then add "vigil": {"frame": "world", "unit": "m"} and no crs';

/**
 * The edits that bring the file's features in, or why it cannot be read. A feature with the name of an entry of its kind
 * replaces that entry, as POST /api/areas does; one without a name gets a free one.
 */
export function readAreas(json: string, targets: Targets): Edit[] | string {
  try {
    const collection = collectionShape(JSON.parse(json), 'file');
    if (!isInMetres(collection)) return kDegrees;
    const { features } = collection;
    if (features.length === 0) return 'there is no feature in it';
    const intake = new Intake(targets);
    return features.flatMap((feature, i) => {
      const place = `features[${i}]`;
      return readFeature(feature.geometry, feature.properties ?? kNoProperties, place).map((read) => intake.take(read));
    });
  } catch (error) {
    if (error instanceof ShapeError) return error.message;
    if (error instanceof SyntaxError) return 'it is not JSON';
    throw error;
  }
}

/** An entry of a file; `name` is empty where the file has none. */
interface Read {
  readonly kind: Kind;
  readonly entry: Entry;
  readonly place: string;
}

/** Names of a file beside those that are there. */
class Intake {
  private readonly seen = new Set<string>();

  constructor(private taken: Targets) {}

  take({ kind, entry, place }: Read): Edit {
    const name = entry.name || freeName(this.taken, kind, 'imported');
    const list = kind === 'no_fly' ? 'no_fly' : 'watched';
    if (this.seen.has(`${list} ${name}`)) throw new ShapeError(`${place}: the name ${name} is there twice`);
    this.seen.add(`${list} ${name}`);
    const named = { ...entry, name };
    if (find(this.taken, { kind, name })) return { op: 'replace', kind, name, entry: named };
    const other = kind === 'cluster' ? 'area' : 'cluster';
    if (kind !== 'no_fly' && find(this.taken, { kind: other, name }))
      throw new ShapeError(`${place}: ${name} is the name of ${other === 'area' ? 'an area' : 'a cluster'} already`);
    const edit: Edit = { op: 'add', kind, entry: named };
    this.taken = apply(this.taken, edit) ?? this.taken;
    return edit;
  }
}

/** A MultiPolygon is as many entries as it has polygons, their names numbered where there are several. */
function readFeature(geometry: Record<string, unknown>, properties: Properties, place: string): Read[] {
  const type = oneOf('Point', 'MultiPoint', 'Polygon', 'MultiPolygon')(geometry['type'], `${place}.geometry.type`);
  const at = `${place}.geometry.coordinates`;
  const coordinates = geometry['coordinates'];
  const name = properties.name ?? '';
  if (type === 'Polygon') return [outlined(outlineOf(coordinates, at), name, properties, place)];
  if (type === 'MultiPolygon') {
    const polygons = list(outlineOf, kMostPolygons)(coordinates, at);
    if (polygons.length === 0) throw new ShapeError(`${at}: at least one polygon expected`);
    const nameOf = (i: number): string => (name !== '' && polygons.length > 1 ? `${name}-${i + 1}` : name);
    return polygons.map((outline, i) => outlined(outline, nameOf(i), properties, place));
  }
  const points_m = type === 'Point' ? [position(coordinates, at)] : list(position, kMostPoints)(coordinates, at);
  if (points_m.length === 0) throw new ShapeError(`${at}: at least one point expected`);
  const entry = {
    name,
    points_m,
    weight: properties.weight ?? 1,
    revisit_s: properties.revisit_s,
    protect: properties.protect ?? false,
  };
  return [{ kind: 'cluster', entry, place }];
}

function outlined(outline_m: Point[], name: string, properties: Properties, place: string): Read {
  if (properties.kind === 'no_fly') return { kind: 'no_fly', entry: { name, outline_m }, place };
  const { weight, soft_edge_m, revisit_s, protect } = properties;
  const rest = { weight: weight ?? 5, soft_edge_m: soft_edge_m ?? 0, revisit_s, protect: protect ?? false };
  const entry = { name, outline_m, ...rest };
  return { kind: 'area', entry, place };
}

function outlineOf(coordinates: unknown, place: string): Point[] {
  const rings = list(list(position, 1001), 10)(coordinates, place);
  if (rings.length !== 1)
    throw new ShapeError(`${place}: has ${rings.length} rings; a polygon must have one: no hole can be cut into it`);
  const ring = rings[0]!;
  const [first, last] = [ring[0], ring[ring.length - 1]];
  const isClosed = first && last && first[0] === last[0] && first[1] === last[1];
  const outline = isClosed ? ring.slice(0, -1) : ring;
  if (outline.length < 3) throw new ShapeError(`${place}: at least three corners expected`);
  if (crossesItself(outline)) throw new ShapeError(`${place}: the outline crosses itself`);
  return outline;
}
