import { useRef, useState } from 'preact/hooks';
import { add, centroid, type Point } from '../model/geometry';
import { freeName, pointsOf, type Entry, type EntryName } from '../model/targets';
import { coordinateDecimals } from '../model/units';
import { useApp } from './app_context';
import { Icon } from './icons';
import { NumberField } from './number_field';

const kMostListed = 60;

/** The selected entry by numbers: every drag on the map can be done here. */
export function EntryEditor({ which, entry }: { which: EntryName; entry: Entry }) {
  const { session, editor } = useApp();
  const mayEdit = session.mayOperate.value;
  const points = pointsOf(entry);
  const [x, y] = centroid(points);
  const extent = Math.max(...(session.field.value?.size ?? [1, 1]));
  const decimals = coordinateDecimals(extent);
  const move = (to: Point): void => editor.reshape(which, points, [to[0] - x, to[1] - y], 1, false);
  return (
    <div class="pad" data-testid="entry-editor" style={{ paddingTop: '6px' }}>
      <div class="fields">
        <NameField which={which} />
        {'weight' in entry && (
          <>
            <NumberField
              label="Weight"
              value={entry.weight}
              least={0}
              most={1_000_000}
              disabled={!mayEdit}
              set={(value) => value !== null && editor.setWeight(which, value)}
            />
            <NumberField
              label="Revisit within, s"
              value={entry.revisit_s}
              empty="no deadline"
              least={0.001}
              most={10_000_000}
              disabled={!mayEdit}
              set={(value) =>
                editor.stage(`${which.name}: deadline`, { op: 'set_revisit', ...which, revisit_s: value })
              }
            />
          </>
        )}
        {'weight' in entry && (
          <label class="wide check">
            <input
              type="checkbox"
              checked={entry.protect}
              disabled={!mayEdit}
              onChange={({ currentTarget }) =>
                editor.stage(`${which.name}: ${currentTarget.checked ? 'protected' : 'no longer protected'}`, {
                  op: 'set_protect',
                  ...which,
                  protect: currentTarget.checked,
                })
              }
            />
            Keeps its drones where there are fewer
          </label>
        )}
        {'soft_edge_m' in entry && (
          <NumberField
            label="Soft edge, m"
            value={entry.soft_edge_m}
            least={0}
            most={100_000}
            disabled={!mayEdit}
            set={(value) =>
              value !== null &&
              editor.stage(`${which.name}: soft edge`, { op: 'set_soft_edge', ...which, soft_edge_m: value })
            }
          />
        )}
        <NumberField
          label="Centre x, m"
          value={x}
          decimals={decimals}
          disabled={!mayEdit}
          set={(v) => v !== null && move([v, y])}
        />
        <NumberField
          label="Centre y, m"
          value={y}
          decimals={decimals}
          disabled={!mayEdit}
          set={(v) => v !== null && move([x, v])}
        />
        <NumberField
          label="Spread by a factor"
          value={1}
          least={0.02}
          most={20}
          disabled={!mayEdit}
          set={(factor) => factor !== null && editor.reshape(which, points, [0, 0], factor, false)}
        />
      </div>
      <PointTable which={which} points={points} decimals={decimals} />
      <div class="row">
        <button
          type="button"
          disabled={!mayEdit}
          onClick={() => editor.stage(`a point in ${which.name}`, addPointEdit(which, points))}
        >
          <Icon name="plus" small />
          Point
        </button>
        <button
          type="button"
          disabled={!mayEdit}
          onClick={() => ((editor.selectedPoint.value = null), editor.remove())}
        >
          Remove {which.kind === 'no_fly' ? 'polygon' : which.kind}
        </button>
      </div>
    </div>
  );
}

/** In a cluster beside its middle; in an outline in the middle of its last edge. */
function addPointEdit(which: EntryName, points: readonly Point[]) {
  const [first, last] = [points[0]!, points[points.length - 1]!];
  const [x, y] = add(first, last);
  const point_m: Point = which.kind === 'cluster' ? centroid(points) : [x / 2, y / 2];
  return { op: 'add_point', ...which, point_m } as const;
}

function NameField({ which }: { which: EntryName }) {
  const { session, editor } = useApp();
  const [typed, setTyped] = useState<string | null>(null);
  const isGivenUp = useRef(false);
  const settle = (): void => {
    const name = isGivenUp.current ? '' : (typed?.trim() ?? '');
    isGivenUp.current = false;
    setTyped(null);
    if (name === '' || name === which.name) return;
    const to = freeName(session.draft.value, which.kind, name.slice(0, 64));
    if (editor.stage(`${which.name} is called ${to}`, { op: 'rename', ...which, to }))
      editor.select({ ...which, name: to });
  };
  return (
    <label class="wide">
      Name
      <input
        value={typed ?? which.name}
        maxLength={64}
        disabled={!session.mayOperate.value}
        onInput={(event) => setTyped(event.currentTarget.value)}
        onBlur={settle}
        onKeyDown={(event) => {
          if (event.key !== 'Enter' && event.key !== 'Escape') return;
          event.stopPropagation();
          isGivenUp.current = event.key === 'Escape';
          event.currentTarget.blur();
        }}
      />
    </label>
  );
}

function PointTable({ which, points, decimals }: { which: EntryName; points: readonly Point[]; decimals: number }) {
  const { editor, session } = useApp();
  const word = which.kind === 'cluster' ? 'Point' : 'Corner';
  const disabled = !session.mayOperate.value;
  return (
    <div class="points" tabIndex={0} role="region" aria-label={`${word}s of ${which.name}`}>
      <table>
        <thead>
          <tr>
            <th scope="col">{word}</th>
            <th scope="col">x, m</th>
            <th scope="col">y, m</th>
            <th scope="col">
              <span class="unseen">remove</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {points.slice(0, kMostListed).map((p, i) => (
            <tr key={i}>
              <td class={editor.selectedPoint.value === i ? 'ok' : 'dim'}>{i + 1}</td>
              {([0, 1] as const).map((axis) => (
                <td key={axis}>
                  <NumberField
                    hidesLabel
                    label={`${word} ${i + 1}, ${axis === 0 ? 'x' : 'y'} in metres`}
                    value={p[axis]}
                    decimals={decimals}
                    disabled={disabled}
                    set={(v) => v !== null && editor.movePoint(which, i, axis === 0 ? [v, p[1]] : [p[0], v], false)}
                  />
                </td>
              ))}
              <td>
                <button
                  type="button"
                  class="quiet"
                  disabled={disabled || points.length <= (which.kind === 'cluster' ? 1 : 3)}
                  aria-label={`Remove ${word.toLowerCase()} ${i + 1}`}
                  onClick={() =>
                    editor.stage(`a point of ${which.name} removed`, { op: 'remove_point', ...which, index: i })
                  }
                >
                  <Icon name="close" small />
                </button>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      {points.length > kMostListed && <p class="dim">and {points.length - kMostListed} more</p>}
    </div>
  );
}
