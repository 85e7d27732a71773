import { useEffect, useRef } from 'preact/hooks';
import uPlot from 'uplot';
import 'uplot/dist/uPlot.min.css';
import { clock } from '../model/units';
import { useApp } from './app_context';

export interface PlotSeries {
  readonly name: string;
  /** A colour of look/colours.css, without its dashes. */
  readonly colour: string;
  readonly dash?: number[];
}

interface Props {
  readonly title: string;
  readonly now: string;
  readonly series: readonly PlotSeries[];
  /** Times and then every series; read at every beat. */
  readonly data: () => uPlot.AlignedData;
  readonly isLogarithmic?: boolean;
  /** A horizontal line, such as R_s. */
  readonly limit?: number | null;
  /** The vertical axis reaches at least to this. */
  readonly atLeast?: number;
  readonly description: string;
  /** The first and the last moment that is shown. */
  readonly range: readonly [number, number] | null;
}

const cssColour = (name: string): string =>
  getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();

/** A plot over mission time, drawn anew at every beat. */
export function Plot(props: Props) {
  const { session, settings } = useApp();
  const host = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const theme = settings.theme.value;
  const seriesKey = props.series.map((series) => series.name).join();
  useEffect(() => {
    const element = host.current!;
    const made = new uPlot(optionsOf(element, props), props.data(), element);
    plot.current = made;
    const resized = new ResizeObserver(() => made.setSize(sizeOf(element)));
    resized.observe(element);
    return () => {
      resized.disconnect();
      made.destroy();
      plot.current = null;
    };
  }, [theme, seriesKey, props.limit, props.atLeast]);
  const beat = session.beat.value;
  useEffect(() => {
    plot.current?.setData(props.data());
  }, [beat]);
  return (
    <figure
      class="plot"
      style={{ margin: 0 }}
      role="img"
      aria-label={`${props.title}: ${props.now}${fromTo(props.range)}. ${props.description}`}
      title={props.description}
    >
      <h3 aria-hidden="true">
        <span>{props.title}</span>
        <output>{props.now}</output>
      </h3>
      <div ref={host} style={{ position: 'absolute', inset: '24px 2px 0 0' }} />
    </figure>
  );
}

const fromTo = (range: Props['range']): string => (range ? `, from ${clock(range[0])} to ${clock(range[1])}` : '');

const sizeOf = (element: HTMLElement): { width: number; height: number } => ({
  width: Math.max(80, element.clientWidth),
  height: Math.max(60, element.clientHeight),
});

function optionsOf(element: HTMLElement, props: Props): uPlot.Options {
  const axis: uPlot.Axis = {
    stroke: cssColour('dim'),
    font: '11px system-ui, sans-serif',
    grid: { stroke: cssColour('line'), width: 1 },
    ticks: { show: false },
  };
  const seconds: uPlot.Axis = {
    ...axis,
    size: 22,
    values: (_, values) => values.map((value) => `${value} s`),
    space: 54,
  };
  return {
    ...sizeOf(element),
    legend: { show: false },
    cursor: { show: false },
    scales: {
      x: { time: false },
      y: props.isLogarithmic ? logarithmic() : linear(Math.max(1.6 * (props.limit ?? 0), props.atLeast ?? 0)),
    },
    axes: [seconds, { ...axis, size: 42, space: 26, values: (_, values) => values.map(shortNumber) }],
    series: [{}, ...props.series.map(lineOf)],
    hooks: props.limit == null ? {} : { draw: [(u) => drawLimit(u, props.limit!)] },
  };
}

const lineOf = (series: PlotSeries): uPlot.Series => ({
  label: series.name,
  stroke: cssColour(series.colour),
  width: 1.75,
  ...(series.dash ? { dash: series.dash } : {}),
  points: { show: false },
  spanGaps: false,
});

/** 0.1 to 100 percent and beyond, whole decades. */
const logarithmic = (): uPlot.Scale => ({
  distr: 3,
  range: (_, low, high) => [10 ** Math.floor(Math.log10(Math.max(low ?? 1, 0.01))), Math.max(100, high ?? 100)],
});

const linear = (least: number): uPlot.Scale => ({
  range: (_, __, high) => [0, high === null ? Math.max(least, 1) : Math.max(high * 1.1, least, 1e-3)],
});

const shortNumber = (value: number | null): string => (value === null ? '' : String(Number(value.toPrecision(3))));

function drawLimit(u: uPlot, limit: number): void {
  const y = u.valToPos(limit, 'y', true);
  const { left, width } = u.bbox;
  u.ctx.save();
  u.ctx.strokeStyle = cssColour('failure');
  u.ctx.lineWidth = 1.5 * devicePixelRatio;
  u.ctx.setLineDash([5 * devicePixelRatio, 4 * devicePixelRatio]);
  u.ctx.beginPath();
  u.ctx.moveTo(left, y);
  u.ctx.lineTo(left + width, y);
  u.ctx.stroke();
  u.ctx.restore();
}
