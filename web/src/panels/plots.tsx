import { useComputed } from '@preact/signals';
import type uPlot from 'uplot';
import { duration, metres, metresPerSecond } from '../model/units';
import { kMostPlotted, Series, type Columns } from '../session/series';
import { useApp } from './app_context';
import { Icon } from './icons';
import { Plot, type PlotSeries } from './plot';

const kColours = ['accent', 'trail', 'warning', 'density', 'failure', 'dim'];
const kOfPairs = 'Distances between drones, and dashed R_s, the least that is allowed.';
const kOfNearest = 'Distance of the two drones nearest to each other, and dashed R_s, the least that is allowed.';
const kDashes = [undefined, [7, 3], [2, 3]];

const lines = (names: readonly string[]): PlotSeries[] =>
  names.map((name, i) => {
    const dash = kDashes[Math.floor(i / kColours.length) % kDashes.length];
    return { name, colour: kColours[i % kColours.length]!, ...(dash ? { dash } : {}) };
  });

/** The paper's figures 4, 6 and 8 as the mission goes on, and the worst age. */
export function Plots() {
  const { session, settings } = useApp();
  void session.beat.value;
  const { snapshot, series } = session;
  const ids = session.droneIds.value;
  const isFew = ids.length <= kMostPlotted;
  const fullSpeed = session.mission.value?.display.speed_limit_m_s ?? 1;
  const separation = useComputed(() => session.mission.value?.display.separation_m ?? null).value;
  const span = settings.plotSpan.value;
  const range = series.range(span);
  const drawn = (read: () => Columns) => () => read() as unknown as uPlot.AlignedData;
  const ofSwarm = (column: number) => drawn(() => series.ofSwarm(column, span));
  return (
    <div class="plots">
      <Plot
        title="Metric"
        now={snapshot?.hasMetric ? `${snapshot.metricPercent.toPrecision(3)} %` : '–'}
        description="How far the swarm's time is from what was asked, in % of the first value; it falls while the swarm covers."
        range={range}
        series={lines(['metric'])}
        data={ofSwarm(0)}
        isLogarithmic
      />
      <Plot
        title="Worst age"
        now={duration(snapshot?.worstAgeS)}
        description="Time since the part that waited longest was seen."
        range={range}
        series={[{ name: 'worst age', colour: 'warning' }]}
        data={ofSwarm(1)}
        atLeast={1}
      />
      <Plot
        title={isFew ? 'Distances' : 'Distance'}
        now={metres(snapshot?.leastPairM)}
        description={isFew ? kOfPairs : kOfNearest}
        range={range}
        series={isFew ? lines(Series.pairNames(ids)) : lines(['least'])}
        data={isFew ? drawn(() => series.ofPairs(span)) : ofSwarm(2)}
        limit={separation}
      />
      <Plot
        title={isFew ? 'Inputs |u|' : 'Fastest'}
        now={metresPerSecond(series.fastest)}
        description="Speed that was asked of the drones."
        range={range}
        series={isFew ? lines(ids) : lines(['fastest'])}
        data={isFew ? drawn(() => series.ofInputs(span)) : ofSwarm(4)}
        atLeast={1.1 * fullSpeed}
      />
    </div>
  );
}

/** Whether plots show the whole flight or its last two minutes. */
export function PlotSpan() {
  const { settings } = useApp();
  const isWhole = settings.plotSpan.value === 'whole';
  return (
    <button
      type="button"
      class="quiet"
      title={
        isWhole
          ? 'Plots show the whole flight; click for its last two minutes'
          : 'Plots show the last two minutes; click for the whole flight'
      }
      aria-label={isWhole ? 'Plots: All' : 'Plots: 2 min'}
      onClick={() => (settings.plotSpan.value = isWhole ? 'recent' : 'whole')}
    >
      <Icon name="plots" />
      {isWhole ? 'All' : '2 min'}
    </button>
  );
}
