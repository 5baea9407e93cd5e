// Arm and hand over time: what the plots and the figure are made from.

import type { Layout } from './messages';

/** A page that stays open does not grow without end: at more, the oldest quarter goes. */
const mostSamples = 240_000;

export class Samples {
  readonly layout: Layout;
  private times = new Float64Array(4096);
  private data: Float32Array;
  count = 0;

  constructor(layout: Layout) {
    this.layout = layout;
    this.data = new Float32Array(4096 * layout.values);
  }

  append(times: Float64Array, values: Float32Array): void {
    this.makeRoom(times.length);
    this.times.set(times, this.count);
    this.data.set(values, this.count * this.layout.values);
    this.count += times.length;
  }

  time(i: number): number {
    return this.times[i]!;
  }
  value(i: number, which: number): number {
    return this.data[i * this.layout.values + which]!;
  }
  get first(): number {
    return this.count > 0 ? this.times[0]! : 0;
  }
  get last(): number {
    return this.count > 0 ? this.times[this.count - 1]! : 0;
  }

  /** The newest sample that is not later than `t`; -1: none. */
  at(t: number): number {
    let low = 0;
    let high = this.count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.times[middle]! <= t) low = middle + 1;
      else high = middle;
    }
    return low - 1;
  }

  /** Value at `t`, between two samples on the straight line. */
  between(i: number, t: number, which: number): number {
    const a = this.value(i, which);
    if (i + 1 >= this.count) return a;
    const gap = this.time(i + 1) - this.time(i);
    // What lies between two scenes is no motion.
    if (gap > 0.05) return a;
    return a + (this.value(i + 1, which) - a) * Math.min(1, (t - this.time(i)) / gap);
  }

  private makeRoom(more: number): void {
    if (this.count + more > mostSamples) {
      const gone = Math.min(this.count, Math.max(more, mostSamples >> 2));
      this.times.copyWithin(0, gone, this.count);
      this.data.copyWithin(0, gone * this.layout.values, this.count * this.layout.values);
      this.count -= gone;
    }
    if (this.count + more <= this.times.length) return;
    const size = Math.max(this.count + more, 2 * this.times.length);
    const times = new Float64Array(size);
    times.set(this.times.subarray(0, this.count));
    const data = new Float32Array(size * this.layout.values);
    data.set(this.data.subarray(0, this.count * this.layout.values));
    this.times = times;
    this.data = data;
  }
}
