// What the server tells (launch/view/frame.cpp): a greeting, then frames.

export type Vector = [number, number, number];

/** Where each value stands in a sample. */
export interface Layout {
  speed: number;
  torque: number;
  angle: number;
  normal: number;
  tangential: number;
  armPhase: number;
  handPhase: number;
  points: number;
  values: number;
}

export interface Target {
  p: Vector;
  n: Vector;
  right: Vector;
  up: Vector;
  radius: number;
}

export interface Part {
  from: number;
  to: number;
  radius: number;
  hand: boolean;
}

export interface Hello {
  version: string;
  live: boolean;
  source: string;
  mayThrow: boolean;
  layout: Layout;
  parts: Part[];
  heldBall: number;
  /** The points of the arm at rest; null: not known. */
  rest: (Vector | [null, null, null])[];
  ballRadius: number;
  arm: string;
  speedLimits: number[];
  torqueLimits: number[];
  target: Target;
  floor: number;
}

export interface Landing {
  heard: number;
  t: number;
  measured: boolean;
  at: [number, number];
  cov: Vector;
  speed: number;
  observations: number;
  residual: number;
  message: string;
}

export interface Plan {
  t: number;
  ok: boolean;
  message: string;
  ms: number;
  speed: number;
  landing: [number, number];
  flightTime: number;
  flight: Vector[];
}

/** Times [s] on the time axis; null: not heard, or not known yet. */
export interface Throw {
  number: number;
  id: number;
  t: number;
  strategy: string;
  target: Target | null;
  plan: Plan | null;
  scene: number | null;
  start: number | null;
  plannedRelease: number | null;
  commanded: number | null;
  departed: number | null;
  landing: Landing | null;
  note: string;
  noted: number;
}

export interface Heartbeat {
  t: number;
  age: number;
  name: string;
  host: string;
  pid: number;
  version: string;
  state: string;
  detail: string;
  lost: number;
  invalid: number;
  meanUs: number;
  maxUs: number;
}

export interface Pictures {
  from: number;
  kept: number;
  t: number[];
}

/** Number of the throw, time, place, and 1 if it was measured. */
export type TrackPoint = [number, number, number, number, number, number];

/** A run that a page has started. */
export interface Run {
  goesOn: boolean;
  failed: boolean;
  words: string;
}

export interface FrameHeader {
  samples: number;
  now: number;
  whole: boolean;
  skipped?: number;
  heartbeats?: Heartbeat[];
  track?: TrackPoint[];
  throws?: Throw[];
  pictures?: Record<string, Pictures>;
  notices?: string[];
  heard?: boolean;
  run?: Run;
  recorded?: string;
  advice?: string;
}

export interface Frame {
  header: FrameHeader;
  times: Float64Array;
  values: Float32Array;
}

export function decodeFrame(bytes: ArrayBuffer): Frame {
  const length = new DataView(bytes).getUint32(0, true);
  const header = JSON.parse(
    new TextDecoder().decode(new Uint8Array(bytes, 4, length)),
  ) as FrameHeader;
  const start = 4 + length;
  return {
    header,
    times: new Float64Array(bytes, start, header.samples),
    values: new Float32Array(bytes, start + 8 * header.samples),
  };
}

export const armPhases = ['idle', 'approach', 'ready', 'swing', 'follow-through', 'hold', 'brake'];
export const handPhases = ['open', 'grasps', 'holds', 'releases', 'clears'];
