// Where the ball is, as far as the messages tell: in the hand until it departed, then on its measured track, and as long as none
// has been measured on the flight that was planned.

import type { Throw, Vector } from './messages';
import type { Fix, Record } from './record';

export interface BallPlace {
  p: Vector;
  /** 'inferred': by its first measurement, backwards; 'planned': nobody has seen it there. */
  kind: 'held' | 'inferred' | 'measured' | 'planned' | 'landed';
}

/** How far a track is carried on beyond its last point [s]. */
const longestExtension = 0.05;

function mix(a: Vector, b: Vector, share: number): Vector {
  return [0, 1, 2].map((i) => a[i]! + (b[i]! - a[i]!) * share) as Vector;
}

/** On the straight lines between the points, and on the last of them beyond the end. */
function onTrack(track: Fix[], t: number): BallPlace | null {
  const last = track.length - 1;
  if (last < 1 || t < track[0]!.t || t > track[last]!.t + longestExtension) return null;
  let i = last - 1;
  while (i > 0 && track[i]!.t > t) --i;
  const a = track[i]!;
  const b = track[i + 1]!;
  const p = mix(a.p, b.p, (t - a.t) / Math.max(b.t - a.t, 1e-6));
  return { p, kind: a.measured ? 'measured' : 'inferred' };
}

export function landingPoint(
  thrown: Throw,
  target: { p: Vector; right: Vector; up: Vector },
): Vector {
  const [right, up] = thrown.landing!.at;
  return [0, 1, 2].map(
    (i) => target.p[i]! + right * target.right[i]! + up * target.up[i]!,
  ) as Vector;
}

function planned(thrown: Throw, since: number): Vector | null {
  const plan = thrown.plan;
  if (!plan || plan.flight.length < 2 || since > plan.flightTime) return null;
  const place = (since / plan.flightTime) * (plan.flight.length - 1);
  const i = Math.min(Math.floor(place), plan.flight.length - 2);
  return mix(plan.flight[i]!, plan.flight[i + 1]!, place - i);
}

export function ballAt(record: Record, t: number): BallPlace | null {
  const thrown = record.throwAt(t);
  const departed = thrown?.departed ?? null;
  if (!thrown || departed === null || t < departed) {
    const i = record.samples.at(t);
    if (i < 0) return null;
    const where = record.hello.layout.points + 3 * record.hello.heldBall;
    const p = [0, 1, 2].map((axis) => record.samples.between(i, t, where + axis)) as Vector;
    return Number.isNaN(p[0]) ? null : { p, kind: 'held' };
  }
  const landing = thrown.landing;
  if (landing?.measured && t >= landing.t)
    return { p: landingPoint(thrown, thrown.target ?? record.hello.target), kind: 'landed' };
  const seen = onTrack(record.tracks.get(thrown.number) ?? [], t);
  if (seen) return seen;
  const expected = planned(thrown, t - departed);
  return expected ? { p: expected, kind: 'planned' } : null;
}
