import { useComputed } from '@preact/signals';
import type uPlot from 'uplot';
import { duration, metres, metresPerSecond } from '../model/units';
import { kMostPlotted, Series } from '../session/series';
import { useApp } from './app_context';
import { Plot, type PlotSeries } from './plot';

const kWindowS = 120;
const kColours = ['accent', 'trail', 'warning', 'density', 'failure', 'dim'];
const kDashes = [undefined, [7, 3], [2, 3]];

const lines = (names: readonly string[]): PlotSeries[] =>
  names.map((name, i) => {
    const dash = kDashes[Math.floor(i / kColours.length) % kDashes.length];
    return { name, colour: kColours[i % kColours.length]!, ...(dash ? { dash } : {}) };
  });

/** The paper's figures 4, 6 and 8 as the mission goes on, and the worst age. */
export function Plots() {
  const { session } = useApp();
  void session.beat.value;
  const { snapshot, series } = session;
  const ids = session.droneIds.value;
  const isFew = ids.length <= kMostPlotted;
  const fullSpeed = session.mission.value?.display.speed_limit_m_s ?? 1;
  const separation = useComputed(() => session.mission.value?.display.separation_m ?? null).value;
  const since = (series.swarm.newestTime ?? 0) - kWindowS;
  const ofSwarm = (column: number) => () => {
    const all = series.swarm.columns(since);
    return [all[0], all[column]] as unknown as uPlot.AlignedData;
  };
  const fastest = series.swarm.newest(4);
  return (
    <div class="plots">
      <Plot
        title="Metric, % of first"
        now={snapshot?.hasMetric ? `${snapshot.metricPercent.toPrecision(3)} %` : '–'}
        description="How far the swarm's time is from what was asked; it falls while the swarm covers."
        series={lines(['metric'])}
        data={ofSwarm(1)}
        isLogarithmic
      />
      <Plot
        title="Worst age of an area"
        now={duration(snapshot?.worstAgeS)}
        description="Time since the part that waited longest was seen."
        series={[{ name: 'worst age', colour: 'warning' }]}
        data={ofSwarm(2)}
        atLeast={1}
      />
      <Plot
        title={isFew ? 'Distances, R_s dashed' : 'Least distance, R_s dashed'}
        now={metres(snapshot?.leastPairM)}
        description="Distances between drones against the least that is allowed."
        series={isFew ? lines(Series.pairNames(ids)) : lines(['least'])}
        data={isFew ? () => series.pairs.columns(since) as unknown as uPlot.AlignedData : ofSwarm(3)}
        limit={separation}
      />
      <Plot
        title={isFew ? 'Control inputs |u|' : 'Fastest control input'}
        now={metresPerSecond(fastest)}
        description="Speed that was asked of the drones."
        series={isFew ? lines(ids) : lines(['fastest'])}
        data={isFew ? () => series.inputs.columns(since) as unknown as uPlot.AlignedData : ofSwarm(5)}
        atLeast={1.1 * fullSpeed}
      />
    </div>
  );
}
