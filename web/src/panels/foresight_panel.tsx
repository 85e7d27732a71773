import type { Outlook, Preview } from '../link/messages';
import { kMostGhosts } from '../map/ghosts_overlay';
import { areaLines, isUncovered, last, type AreaLine } from '../model/outlook';
import { duration, metres } from '../model/units';
import { kAheadS } from '../session/foresight';
import { useApp } from './app_context';
import { Icon } from './icons';

/** What the swarm would do in the next minute: as it is, and with what is staged or without the selected drones. */
export function ForesightPanel() {
  const { foresight } = useApp();
  if (!foresight.isWanted.value) return null;
  const answer = foresight.answer.value;
  return (
    <section class="foresight" role="region" aria-label={`In ${kAheadS} s`} data-testid="foresight">
      <header>
        <h2>In {kAheadS} s</h2>
        <Question />
        <Close />
      </header>
      {foresight.problem.value && <p class="warning">{foresight.problem.value}</p>}
      {answer && <Figures answer={answer} />}
      {!answer && !foresight.problem.value && <p class="dim">Looking ahead …</p>}
    </section>
  );
}

function Close() {
  const { foresight } = useApp();
  if (!foresight.isOn.value) return null;
  return (
    <button type="button" class="quiet" aria-label="Stop looking ahead" onClick={() => foresight.toggle()}>
      <Icon name="close" />
    </button>
  );
}

/** What the shown answer supposes. */
function Question() {
  const { foresight } = useApp();
  const { edits, without } = foresight.answered.value;
  const drones = without.length > 3 ? `${without.length} drones` : without.join(', ');
  const supposed = [
    edits > 0 && `with ${edits} staged ${edits === 1 ? 'edit' : 'edits'}`,
    without.length > 0 && `without ${drones}`,
  ].filter((part) => part !== false);
  return (
    <p class="dim">{supposed.length > 0 ? supposed.join(', ') : 'if nothing changes; select a drone to miss it'}</p>
  );
}

function Figures({ answer }: { answer: Preview }) {
  const lines = areaLines(answer);
  const futures = [answer.as_is, ...(answer.what_if ? [answer.what_if] : [])];
  const areUncovered = futures.filter(isUncovered).length;
  return (
    <div class="figures" tabIndex={0} role="group" aria-label="Figures of the look ahead">
      {areUncovered > 0 && (
        <p class="warning">
          {areUncovered === futures.length ? 'Nothing is covered' : 'What if: nothing is covered'}: no drone is left to
          do it.
        </p>
      )}
      <table>
        <thead>
          <tr>
            <th scope="col">
              <span class="unseen">figure</span>
            </th>
            <th scope="col">{answer.what_if ? 'as is' : ''}</th>
            {answer.what_if && <th scope="col">what if</th>}
          </tr>
        </thead>
        <tbody>
          <Row name="metric" of={answer} read={metricOf} isOfCovering />
          <Row name="oldest place" of={answer} read={(one) => duration(Math.max(...one.worst_age_s))} />
          <Row name="closest pair" of={answer} read={(one) => metres(one.least_pair_m)} isOfCovering />
        </tbody>
      </table>
      {lines.length > 0 && <AreaTable lines={lines} of={answer} />}
      <MetricCurve futures={futures} seconds={answer.seconds} />
      <Ghosts count={answer.ghosts.xy_m.length} />
    </div>
  );
}

const metricOf = (one: Outlook): string => `${(last(one.metric_percent) ?? 0).toPrecision(3)} %`;

interface RowProps {
  readonly name: string;
  readonly of: Preview;
  readonly read: (outlook: Outlook) => string;
  /** It means nothing where nothing is covered, and is left out there. */
  readonly isOfCovering?: boolean;
}

function Row({ name, of, read, isOfCovering }: RowProps) {
  const isLeftOut = (one: Outlook): boolean => (isOfCovering ?? false) && isUncovered(one);
  if (isLeftOut(of.as_is) && (!of.what_if || isLeftOut(of.what_if))) return null;
  const show = (one: Outlook): string => (isLeftOut(one) ? kLeftOut : read(one));
  return (
    <tr>
      <th scope="row">{name}</th>
      <td>{show(of.as_is)}</td>
      {of.what_if && <td class="ghostly">{show(of.what_if)}</td>}
    </tr>
  );
}

const kLeftOut = '–';
const kCurve = { width: 400, height: 46 };

/** The metric over the time to come, on a logarithmic scale; the table says where it ends. */
function MetricCurve({ futures, seconds }: { futures: readonly Outlook[]; seconds: number }) {
  const curves = futures.filter((future) => !isUncovered(future));
  const [low, high] = rangeOf(curves.flatMap((curve) => curve.metric_percent));
  const path = (curve: Outlook): string =>
    curve.metric_percent
      .map((value, i) => {
        const x = (kCurve.width * curve.in_s[i]!) / seconds;
        const y =
          kCurve.height * (1 - (Math.log(Math.max(value, low)) - Math.log(low)) / (Math.log(high) - Math.log(low)));
        return `${x.toFixed(1)},${y.toFixed(1)}`;
      })
      .join(' ');
  if (curves.length === 0) return null;
  return (
    <svg
      class="curve"
      viewBox={`0 -2 ${kCurve.width} ${kCurve.height + 4}`}
      preserveAspectRatio="none"
      aria-hidden="true"
    >
      {curves.map((curve) => (
        <polyline class={curve === futures[0] ? '' : 'ghostly'} points={path(curve)} />
      ))}
    </svg>
  );
}

/** From the least to the greatest positive value, never nothing. */
function rangeOf(values: readonly number[]): readonly [number, number] {
  const positive = values.filter((value) => value > 0);
  const low = Math.min(...positive, 1e9);
  return positive.length === 0 ? [1, 10] : [low, Math.max(...positive, 1.01 * low)];
}

type Area = AreaLine['asIs'];
const within = (seconds: number | null | undefined): string =>
  seconds === undefined ? kLeftOut : seconds === null ? `> ${kAheadS} s` : seconds === 0 ? 'now' : duration(seconds);

/** Until an area has its share, until all of it was seen, and how long a part of it waits at most. */
function AreaTable({ lines, of }: { lines: readonly AreaLine[]; of: Preview }) {
  const pair = (line: AreaLine, read: (area: NonNullable<Area>, future: Outlook) => number | null | undefined) => {
    const show = (area: Area, future: Outlook): string => within(area === null ? undefined : read(area, future));
    return (
      <td>
        {show(line.asIs, of.as_is)}
        {of.what_if && (
          <>
            <span class="unseen">, what if: </span>
            <span class="ghostly">{show(line.whatIf, of.what_if)}</span>
          </>
        )}
      </td>
    );
  };
  return (
    <table>
      <thead>
        <tr>
          <th scope="col">area</th>
          <th scope="col" title="until it has 90 % of the attention that is asked for it">
            covered in
          </th>
          <th scope="col" title="until every part of it has been seen">
            seen in
          </th>
          <th scope="col" title="the longest that a part of it will have waited">
            waits
          </th>
        </tr>
      </thead>
      <tbody>
        {lines.map((line) => (
          <tr key={line.name} data-testid={`ahead-${line.name}`}>
            <th scope="row">{line.name}</th>
            {pair(line, (area, future) => (isUncovered(future) ? undefined : area.covered_in_s))}
            {pair(line, (area) => area.seen_in_s)}
            {pair(line, (area) => area.worst_age_s)}
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Ghosts({ count }: { count: number }) {
  if (count <= kMostGhosts) return null;
  return <p class="dim">Dashed paths are drawn of selected drones only: {count} are too many.</p>;
}
