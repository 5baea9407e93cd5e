// Which time is shown.

export interface Span {
  start: number;
  end: number;
  live: boolean;
}

export const speeds = [0.02, 0.05, 0.1, 0.25, 0.5, 1, 2];

export class Playhead {
  t = 0;
  playing = true;
  speed = 1;
  /** Shows the newest there is. */
  following = true;

  /** Goes on by `seconds` of wall time. */
  advance(seconds: number, span: Span): void {
    if (this.following && span.live) {
      this.t = span.end;
      return;
    }
    if (this.playing) this.t += seconds * this.speed;
    if (this.t >= span.end) {
      this.t = span.end;
      if (span.live && this.playing) this.following = true;
      else this.playing = false;
    }
    this.t = Math.max(this.t, Math.min(span.start, span.end));
  }

  toggle(span: Span): void {
    if (this.following && span.live) {
      this.following = false;
      this.playing = false;
    } else {
      if (!this.playing && this.t >= span.end) this.t = span.start;
      this.playing = !this.playing;
    }
  }

  seek(t: number, span: Span): void {
    this.following = false;
    this.t = Math.min(Math.max(t, span.start), span.end);
  }

  step(seconds: number, span: Span): void {
    this.playing = false;
    this.seek(this.t + seconds, span);
  }

  follow(): void {
    this.following = true;
    this.playing = true;
  }

  changeSpeed(by: number): void {
    const next = speeds.indexOf(this.speed) + by;
    this.speed = speeds[Math.min(Math.max(next, 0), speeds.length - 1)]!;
  }
}
