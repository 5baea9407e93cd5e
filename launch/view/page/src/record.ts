// All that this page has been told.

import type { Frame, Heartbeat, Hello, Run, Throw, TrackPoint, Vector } from './messages';
import { Samples } from './samples';

export interface Fix {
  t: number;
  p: Vector;
  measured: boolean;
}

export interface HeardBeat extends Heartbeat {
  /** performance.now() [ms] when the server heard it. */
  heardAt: number;
}

export interface CameraPictures {
  /** Number of the first of `times`. */
  from: number;
  times: number[];
}

const mostHeartbeats = 20_000;

export class Record {
  readonly hello: Hello;
  readonly samples: Samples;
  readonly throws: Throw[] = [];
  readonly tracks = new Map<number, Fix[]>();
  readonly heartbeats: HeardBeat[] = [];
  readonly pictures = new Map<string, CameraPictures>();
  notices: string[] = [];
  heard = false;
  run: Run | null = null;
  /** How to begin where nothing is heard, or empty. */
  advice = '';
  /** Log that the experiment is recorded in, or empty. */
  recorded = '';
  /** Newest time [s]. */
  now = 0;
  /** A whole log has been received. */
  whole = false;
  /** Samples that this page was too slow for. */
  skipped = 0;

  constructor(hello: Hello) {
    this.hello = hello;
    this.samples = new Samples(hello.layout);
  }

  take(frame: Frame): void {
    const { header } = frame;
    this.samples.append(frame.times, frame.values);
    this.now = header.now;
    this.whole = header.whole;
    this.skipped += header.skipped ?? 0;
    for (const said of header.throws ?? []) this.putThrow(said);
    for (const point of header.track ?? []) this.putFix(point);
    for (const said of header.heartbeats ?? [])
      this.heartbeats.push({ ...said, heardAt: performance.now() - 1000 * said.age });
    if (this.heartbeats.length > mostHeartbeats)
      this.heartbeats.splice(0, this.heartbeats.length - mostHeartbeats);
    for (const [channel, told] of Object.entries(header.pictures ?? {})) {
      const known = this.pictures.get(channel) ?? { from: told.from, times: [] };
      known.times.push(...told.t);
      if (told.kept > known.from) known.times.splice(0, told.kept - known.from);
      known.from = Math.max(known.from, told.kept);
      this.pictures.set(channel, known);
    }
    if (header.notices) this.notices = header.notices;
    if (header.heard !== undefined) this.heard = header.heard;
    if (header.advice !== undefined) this.advice = header.advice;
    if (header.run) this.run = header.run;
    if (header.recorded !== undefined) this.recorded = header.recorded;
  }

  /** First time [s] that can be shown. */
  get start(): number {
    const begun = this.throws.find((thrown) => thrown.t >= this.samples.first);
    if (this.samples.count === 0) return 0;
    return Math.min(this.samples.first, begun?.scene ?? this.samples.first);
  }

  /** The newest throw whose scene has begun at `t`. */
  throwAt(t: number): Throw | null {
    for (let i = this.throws.length - 1; i >= 0; --i) {
      const scene = this.throws[i]!.scene;
      if (scene !== null && scene <= t + 1e-9) return this.throws[i]!;
    }
    return null;
  }

  private putThrow(said: Throw): void {
    const index = this.throws.findIndex((known) => known.number === said.number);
    if (index < 0) this.throws.push(said);
    else this.throws[index] = said;
  }

  private putFix([number, t, x, y, z, measured]: TrackPoint): void {
    const track = this.tracks.get(number) ?? [];
    track.push({ t, p: [x, y, z], measured: measured === 1 });
    this.tracks.set(number, track);
  }
}
