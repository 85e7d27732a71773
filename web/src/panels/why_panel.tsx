import { useEffect, useRef } from 'preact/hooks';
import type { Why, WhyRow } from '../link/messages';
import type { Point } from '../model/geometry';
import { metres, metresPerSecond, sentence } from '../model/units';
import { chordOf, forbiddenPath, placeOf, planeOf, type Plane } from '../model/velocity_plane';
import { kGivesWay, reasonsInWords, rowName } from '../model/why_words';
import { useApp } from './app_context';

/** So many rows have their number in the picture; the table has all of them. */
const kMostNumbered = 8;

/** Why the selected drone's velocity is what it is: what was wanted, what every row allows, what came of it. */
export function WhyPanel() {
  const { reasons } = useApp();
  const isOpen = reasons.isOpen.value;
  const hasAnswer = reasons.answer.value !== null;
  const section = useRef<HTMLElement>(null);
  useEffect(() => {
    if (isOpen && hasAnswer) section.current?.scrollIntoView({ block: 'start' });
  }, [isOpen, hasAnswer]);
  return (
    <section ref={section} class="why" aria-label="Why this velocity">
      <button
        type="button"
        class="quiet"
        aria-expanded={isOpen}
        onClick={() => (reasons.isOpen.value = !reasons.isOpen.value)}
      >
        <span aria-hidden="true">{isOpen ? '▾' : '▸'}</span> Why this velocity
      </button>
      {isOpen && <Answer />}
    </section>
  );
}

function Answer() {
  const { reasons, session } = useApp();
  const why = reasons.answer.value;
  const polygons = session.committed.value.no_fly;
  if (reasons.problem.value) return <p class="warning">{sentence(reasons.problem.value)}</p>;
  if (!why) return <p class="dim">Asking …</p>;
  const words = reasonsInWords(why, polygons).join(' ');
  const names = why.rows.map((row) => rowName(row, polygons));
  return (
    <div data-testid="why-answer" data-tick={why.tick}>
      <p class={why.rows.some((row) => row.holds) ? 'warning' : ''}>{words}</p>
      <div class="why-figure">
        <VelocityPicture why={why} words={words} />
        <Legend why={why} />
      </div>
      {why.rows.length > 0 && <Rows why={why} names={names} />}
    </div>
  );
}

function VelocityPicture({ why, words }: { why: Why; words: string }) {
  const plane = planeOf(why);
  const radius = (100 * plane.radius) / plane.extent;
  // The rows that hold are drawn last, over the others.
  const order = why.rows.map((row, i) => ({ row, number: i + 1 })).reverse();
  order.sort((a, b) => Number(a.row.holds) - Number(b.row.holds));
  return (
    <svg class="velocity-plane" viewBox="-100 -100 200 200" role="img" aria-labelledby="why-title why-desc">
      <title id="why-title">{`Velocities of ${why.drone}, world frame, y up`}</title>
      <desc id="why-desc">
        {`Wanted ${spoken(why.u_nom_m_s)}, allowed ${spoken(why.u_m_s)}, at most ${metresPerSecond(why.u_max_m_s)}. ${words}`}
      </desc>
      <circle class="disk" r={radius} />
      <path class="axes" d={`M${-radius} 0H${radius}M0 ${-radius}V${radius}`} />
      {order.map(({ row, number }) => (
        <Forbidden key={number} row={row} number={number} plane={plane} />
      ))}
      <Arrow of={why.u_nom_m_s} plane={plane} kind="wanted" />
      <Arrow of={why.u_m_s} plane={plane} kind="allowed" />
    </svg>
  );
}

const spoken = (v: Point): string => `${metresPerSecond(v[0])} to the right and ${metresPerSecond(v[1])} up`;

function Forbidden({ row, number, plane }: { row: WhyRow; number: number; plane: Plane }) {
  const path = forbiddenPath(row, plane);
  if (path === '') return null;
  const chord = chordOf(row, plane);
  return (
    <g class={row.holds ? 'holds' : ''}>
      <path class="forbidden" d={path} />
      {chord && <path class="edge" d={`M${chord[0].join(' ')}L${chord[1].join(' ')}`} />}
      {chord && number <= kMostNumbered && <Numbered chord={chord} normal={row.normal} number={number} />}
    </g>
  );
}

/** In the forbidden part, beside the edge's end: in its middle the arrows are. */
function Numbered({ chord, normal, number }: { chord: [Point, Point]; normal: Point; number: number }) {
  const along = (k: 0 | 1): number => 0.82 * chord[0][k] + 0.18 * chord[1][k];
  return (
    <text x={along(0) - 7 * normal[0]} y={along(1) + 7 * normal[1]} dy="3.5">
      {number}
    </text>
  );
}

function Arrow({ of, plane, kind }: { of: Point; plane: Plane; kind: 'wanted' | 'allowed' }) {
  if (!of.every(Number.isFinite)) return null;
  const [x, y] = placeOf(of, plane);
  const length = Math.hypot(x, y);
  if (length < 2) return <circle class={`tip ${kind}`} r={3.5} />;
  const [ex, ey] = [x / length, y / length];
  const barb = (side: number): string => `${x - 9 * ex - side * 5 * ey} ${y - 9 * ey + side * 5 * ex}`;
  return (
    <g class={`arrow ${kind}`}>
      <path class="shaft" d={`M0 0L${x - 6 * ex} ${y - 6 * ey}`} />
      <path class="head" d={`M${x} ${y}L${barb(1)}L${barb(-1)}Z`} />
    </g>
  );
}

function Legend({ why }: { why: Why }) {
  return (
    <dl class="why-legend">
      <dt class="wanted">wanted</dt>
      <dd data-testid="why-wanted">{vector(why.u_nom_m_s)}</dd>
      <dt class="allowed">allowed</dt>
      <dd data-testid="why-allowed">{vector(why.u_m_s)}</dd>
      <dt class="limit">at most</dt>
      <dd>{metresPerSecond(why.u_max_m_s)}</dd>
      <dt class="bar">forbidden</dt>
      <dd>shaded, by row</dd>
      <dt class="held">● holds it</dt>
      <dd>keeps it from what was wanted</dd>
    </dl>
  );
}

/** Without the sign of what rounds to nothing. */
const three = (value: number): string => (Number.isFinite(value) ? value.toFixed(3).replace(/^-(0\.0+)$/, '$1') : '–');
const vector = (v: Point): string => `[${three(v[0])}, ${three(v[1])}] m/s`;

/** Every row with its numbers: it asks that the velocity along its normal is at least the offset. */
function Rows({ why, names }: { why: Why; names: readonly string[] }) {
  return (
    <div class="why-rows" role="region" aria-label="Rows of the safety filter" tabIndex={0}>
      <table>
        <thead>
          <tr>
            {['#', 'row about', 'distance', 'normal', 'at least', 'kept by', 'gives way as'].map((title) => (
              <th key={title} scope="col">
                {title}
              </th>
            ))}
          </tr>
        </thead>
        <tbody>
          {why.rows.map((row, i) => (
            <tr key={i} class={row.holds ? 'holds' : ''}>
              <td>{i + 1}</td>
              <th scope="row">
                {row.holds && <span aria-hidden="true">● </span>}
                {names[i]}
                {row.holds && <span class="unseen"> (holds)</span>}
              </th>
              <td>{metres(row.distance_m)}</td>
              <td>{`${row.normal[0].toFixed(2)}, ${row.normal[1].toFixed(2)}`}</td>
              <td>{three(row.offset_m_s)}</td>
              <td>{three(row.slack_m_s)}</td>
              <td>{kGivesWay[row.priority] ?? row.priority}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
