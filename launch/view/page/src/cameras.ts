// What the cameras saw, each image fetched when it is to be shown.

import { element, make, setText } from './page';
import type { Record } from './record';

/** An image older than this is not what the camera sees now [s]. */
const staleAfter = 0.25;
const usual = ['CAMERA_LEFT', 'CAMERA_RIGHT'];

class CameraView {
  readonly figure: HTMLElement;
  private readonly canvas = make('canvas', { width: 640, height: 480 });
  private readonly caption = make('span', { className: 'stamp' });
  private readonly empty = make('p', {}, 'no image heard');
  private shown = -1;
  private fetching = false;

  constructor(private readonly channel: string) {
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', `Image of ${channel}`);
    this.figure = make(
      'figure',
      { className: 'camera' },
      make('div', { className: 'image' }, this.canvas, this.empty),
      make('figcaption', {}, make('span', {}, channel), this.caption),
    );
  }

  reset(): void {
    this.shown = -1;
    this.canvas.hidden = true;
  }

  show(record: Record, t: number): void {
    const kept = record.pictures.get(this.channel);
    const index = kept ? newest(kept.times, t) : -1;
    this.canvas.hidden = this.shown < 0;
    this.empty.hidden = this.shown >= 0;
    setText(this.empty, kept ? 'no image at this time' : 'no image heard');
    if (!kept || index < 0) {
      setText(this.caption, '');
      this.figure.classList.add('stale');
      return;
    }
    const age = t - kept.times[index]!;
    const stale = age > staleAfter;
    this.figure.classList.toggle('stale', stale);
    setText(this.caption, stale ? `${age.toFixed(1)} s ago` : `image ${kept.from + index}`);
    if (kept.from + index !== this.shown && !this.fetching) void this.fetch(kept.from + index);
  }

  private async fetch(number: number): Promise<void> {
    this.fetching = true;
    try {
      const answer = await fetch(`picture/${encodeURIComponent(this.channel)}/${number}`);
      if (answer.ok) {
        const image = await createImageBitmap(await answer.blob());
        if (this.canvas.width !== image.width) this.canvas.width = image.width;
        if (this.canvas.height !== image.height) this.canvas.height = image.height;
        this.canvas.getContext('bitmaprenderer')!.transferFromImageBitmap(image);
      }
      this.shown = number;
    } catch {
      // The connection is lost, which is said elsewhere, or it is no image: the next one is tried.
    } finally {
      this.fetching = false;
    }
  }
}

/** The last of the ascending times that is not later than `t`; -1: none. */
function newest(times: number[], t: number): number {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle]! <= t + 1e-9) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

export class Cameras {
  private readonly views = new Map<string, CameraView>();
  private readonly section = element('cameras');

  reset(): void {
    for (const view of this.views.values()) view.reset();
  }

  show(record: Record, t: number): void {
    const channels = record.pictures.size > 0 ? [...record.pictures.keys()].sort() : usual;
    for (const channel of channels) {
      if (this.views.has(channel)) continue;
      const view = new CameraView(channel);
      this.views.set(channel, view);
      this.section.append(view.figure);
    }
    for (const view of this.views.values()) view.show(record, t);
  }
}
