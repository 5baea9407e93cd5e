// Three plots of the throw that is shown: joint speeds, joint torques, finger forces.

import uPlot from 'uplot';

import { colour, onThemeChange } from './theme';
import type { Throw } from './messages';
import { element, make, setText } from './page';
import type { Record } from './record';

const drawPeriod = 66; // ms: a plot that grows is drawn fifteen times a second
const mostPoints = 700;
const readPeriod = 50; // ms: nobody reads numbers that change faster
const shownSpan = 3.4; // [s], a throw takes about that
const leastForce = 8; // [N], at the top of the scale
const timeLabel = 'time from the planned release, s';
const colours = ['--series-1', '--series-2', '--series-3', '--series-4'];

interface Kind {
  id: string;
  title: string;
  names: string[];
  unit: string;
  digits: number;
  /** First value of the sample. */
  from: (record: Record) => number;
  /** What is drawn is the value over this, in per cent; empty: the value. */
  limits: (record: Record) => number[];
}

const joints = ['J1', 'J2', 'J3', 'J4'];
const kinds: Kind[] = [
  {
    id: 'plot-speed',
    title: 'Joint speed',
    names: joints,
    unit: 'rad/s',
    digits: 2,
    from: (record) => record.hello.layout.speed,
    limits: (record) => record.hello.speedLimits,
  },
  {
    id: 'plot-torque',
    title: 'Joint torque',
    names: joints,
    unit: 'N m',
    digits: 1,
    from: (record) => record.hello.layout.torque,
    limits: (record) => record.hello.torqueLimits,
  },
  {
    id: 'plot-force',
    title: 'Finger force',
    names: ['A', 'thumb', 'B'],
    unit: 'N',
    digits: 2,
    from: (record) => record.hello.layout.normal,
    limits: () => [],
  },
];

class Plot {
  private chart: uPlot | null = null;
  private readonly readings: HTMLElement[];
  private readonly area = make('div', { className: 'area' });
  private readonly line = make('div', { className: 'playhead' });

  constructor(
    readonly kind: Kind,
    private readonly figure: HTMLElement,
  ) {
    this.readings = kind.names.map(() => make('span', { className: 'value' }));
    const legend = kind.names.map((name, i) =>
      make('span', { className: `key key-${i + 1}` }, make('b', {}, name), ' ', this.readings[i]!),
    );
    figure.append(
      make(
        'figcaption',
        {},
        make('span', { className: 'title' }, kind.title, ' ', make('small', {}, kind.unit)),
        make('span', { className: 'keys' }, ...legend),
      ),
      this.area,
    );
    new ResizeObserver(() => this.resize()).observe(this.area);
    this.make();
  }

  /** Draws anew in today's colours. */
  make(): void {
    this.chart?.destroy();
    const relative = this.kind.unit !== 'N';
    const axis = {
      stroke: colour('--muted'),
      grid: { stroke: colour('--grid'), width: 1 },
      ticks: { show: false },
      font: '11px system-ui, sans-serif',
    };
    this.chart = new uPlot(
      {
        width: Math.max(this.area.clientWidth, 50),
        height: Math.max(this.area.clientHeight, 50),
        padding: [6, 8, 0, 0],
        legend: { show: false },
        cursor: { show: false },
        scales: {
          x: { time: false },
          y: {
            range: relative
              ? [-115, 115]
              : (_, __, max) => [0, Math.max(leastForce, 1.08 * (max ?? 0))],
          },
        },
        axes: [
          {
            ...axis,
            size: 22,
            gap: 3,
            space: 45,
            ...(relative ? {} : { label: timeLabel, labelSize: 15, labelFont: axis.font }),
          },
          {
            ...axis,
            size: 46,
            gap: 3,
            space: 24,
            ...(relative
              ? {
                  splits: () => [-100, -50, 0, 50, 100],
                  values: (_: uPlot, splits: number[]) => splits.map((v) => `${v} %`),
                }
              : {}),
          },
        ],
        series: [
          {},
          ...this.kind.names.map((_, i) => ({
            stroke: colour(colours[i]!),
            width: 1.5,
            points: { show: false },
          })),
        ],
        hooks: { draw: [(u) => relative && drawLimits(u)] },
      },
      [[], ...this.kind.names.map(() => [])] as unknown as uPlot.AlignedData,
      this.area,
    );
    this.chart.over.append(this.line);
  }

  draw(data: uPlot.AlignedData, span: [number, number]): void {
    this.chart!.batch(() => {
      this.chart!.setData(data, false);
      this.chart!.setScale('x', { min: span[0], max: span[1] });
    });
  }

  showPlayhead(x: number | null): void {
    const chart = this.chart!;
    const { min, max } = chart.scales['x']!;
    const inside = x !== null && min != null && max != null && x >= min && x <= max;
    this.line.hidden = !inside;
    if (inside) this.line.style.transform = `translateX(${chart.valToPos(x, 'x')}px)`;
  }

  showReadings(values: number[]): void {
    values.forEach((value, i) =>
      setText(this.readings[i]!, Number.isFinite(value) ? plain(value, this.kind.digits) : '–'),
    );
    this.figure.classList.toggle('empty', !values.some(Number.isFinite));
  }

  private resize(): void {
    if (this.area.clientWidth > 0 && this.area.clientHeight > 0)
      this.chart?.setSize({ width: this.area.clientWidth, height: this.area.clientHeight });
  }
}

/** Without the sign of a zero. */
function plain(value: number, digits: number): string {
  const words = Math.abs(value).toFixed(digits);
  return value < 0 && Number(words) !== 0 ? `−${words}` : words;
}

function drawLimits(u: uPlot): void {
  const { ctx, bbox } = u;
  ctx.save();
  ctx.strokeStyle = colour('--limit');
  ctx.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
  ctx.lineWidth = devicePixelRatio;
  for (const limit of [-100, 100]) {
    const y = u.valToPos(limit, 'y', true);
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
  }
  ctx.restore();
}

export class Plots {
  private readonly plots = kinds.map((kind) => new Plot(kind, element(kind.id)));
  private record: Record;
  private drawn = '';
  private nextDraw = 0;
  private nextRead = 0;

  constructor(record: Record) {
    this.record = record;
    onThemeChange(() => {
      for (const plot of this.plots) plot.make();
      this.drawn = '';
    });
  }

  setRecord(record: Record): void {
    this.record = record;
    this.drawn = '';
  }

  show(t: number): void {
    const { samples } = this.record;
    const thrown = this.record.throwAt(t);
    const zero = thrown ? (thrown.plannedRelease ?? thrown.scene!) : samples.first;
    const now = performance.now();
    const [from, to] = this.spanOf(thrown);
    const last = samples.at(to);
    const key = `${thrown?.number} ${from} ${last}`;
    if (key !== this.drawn && now >= this.nextDraw) {
      this.drawn = key;
      this.nextDraw = now + drawPeriod;
      const shown: [number, number] = [
        from - zero,
        Math.max(from + shownSpan, samples.time(Math.max(last, 0))) - zero,
      ];
      const first = samples.at(from - 1e-9) + 1;
      for (const plot of this.plots) plot.draw(this.data(plot.kind, first, last, zero), shown);
    }
    const i = samples.at(t);
    for (const plot of this.plots) plot.showPlayhead(i >= 0 ? t - zero : null);
    if (now < this.nextRead) return;
    this.nextRead = now + readPeriod;
    for (const plot of this.plots) {
      const where = plot.kind.from(this.record);
      plot.showReadings(
        plot.kind.names.map((_, k) => (i < 0 ? NaN : samples.between(i, t, where + k))),
      );
    }
  }

  /** From the throw's first sample to the next throw's. */
  private spanOf(thrown: Throw | null): [number, number] {
    const { samples, throws } = this.record;
    if (!thrown) return [samples.first, samples.first + shownSpan];
    const next = throws.find((other) => other.scene !== null && other.scene > thrown.scene!);
    return [thrown.scene!, next ? next.scene! - 1e-6 : Infinity];
  }

  /** Of every few samples the one farthest from zero, so that no peak is lost. */
  private data(kind: Kind, first: number, last: number, zero: number): uPlot.AlignedData {
    const { samples } = this.record;
    const where = kind.from(this.record);
    const limits = kind.limits(this.record);
    const stride = Math.max(1, Math.ceil((last - first + 1) / mostPoints));
    const x: number[] = [];
    const series: (number | null)[][] = kind.names.map(() => []);
    for (let i = first; i <= last; i += stride) {
      x.push(samples.time(i) - zero);
      kind.names.forEach((_, k) => {
        let peak = samples.value(i, where + k);
        for (let j = i + 1; j < Math.min(i + stride, last + 1); ++j) {
          const value = samples.value(j, where + k);
          if (Math.abs(value) > Math.abs(peak) || Number.isNaN(peak)) peak = value;
        }
        const limit = limits[k];
        series[k]!.push(Number.isNaN(peak) ? null : limit ? (100 * peak) / limit : peak);
      });
    }
    return [x, ...series] as uPlot.AlignedData;
  }
}
