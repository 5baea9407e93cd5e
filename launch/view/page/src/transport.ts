// The bar below: pause, time slider, speed; and the keys for them.

import { element, make, setText } from './page';
import { speeds, type Playhead, type Span } from './playhead';
import type { Record } from './record';

const step = 0.005; // [s], an arrow key
const leap = 0.1; // with Shift

export class Transport {
  private readonly play = element<HTMLButtonElement>('play');
  private readonly live = element<HTMLButtonElement>('live');
  private readonly slider = element<HTMLInputElement>('slider');
  private readonly speed = element<HTMLSelectElement>('speed');
  private readonly time = element('time');
  private readonly marks = element('marks');
  private span: Span = { start: 0, end: 0, live: true };
  private shownSpan: Span = { start: NaN, end: NaN, live: true };
  private marked = '';

  constructor(
    private readonly head: Playhead,
    private readonly changed: () => void,
  ) {
    this.play.onclick = () => this.toggle();
    this.live.onclick = () => this.follow();
    this.slider.oninput = () => {
      head.playing = false;
      this.goTo(Number(this.slider.value));
    };
    this.speed.onchange = () => (head.speed = Number(this.speed.value));
    this.slider.onkeydown = (event) => {
      // The arrows step by the same everywhere.
      if (event.key.startsWith('Arrow') || event.key === 'Home' || event.key === 'End')
        event.preventDefault();
    };
  }

  toggle(): void {
    this.head.toggle(this.span);
    this.changed();
  }

  follow(): void {
    this.head.follow();
    if (!this.span.live) this.head.seek(this.span.end, this.span);
    this.changed();
  }

  goTo(t: number): void {
    this.head.seek(t, this.span);
    this.changed();
  }

  /** @return false if the key means nothing here. */
  key(event: KeyboardEvent): boolean {
    const by = event.shiftKey ? leap : step;
    const keys: { [key: string]: () => void } = {
      ' ': () => this.toggle(),
      ArrowLeft: () => this.head.step(-by, this.span),
      ArrowRight: () => this.head.step(by, this.span),
      Home: () => this.goTo(this.span.start),
      End: () => this.follow(),
      '[': () => this.head.changeSpeed(-1),
      ']': () => this.head.changeSpeed(1),
    };
    const act = keys[event.key];
    if (!act) return false;
    act();
    this.changed();
    return true;
  }

  show(record: Record, span: Span): void {
    this.span = span;
    const { head } = this;
    const running = head.playing || (head.following && span.live);
    this.play.dataset['state'] = running ? 'playing' : 'paused';
    this.play.setAttribute('aria-label', running ? 'Pause' : 'Play');
    this.live.hidden = !span.live;
    this.live.setAttribute('aria-pressed', String(head.following));
    if (this.shownSpan.start !== span.start || this.shownSpan.end !== span.end) {
      this.shownSpan = { ...span };
      this.slider.min = String(span.start);
      this.slider.max = String(span.end);
      this.slider.value = String(head.t);
    }
    const time = `${head.t.toFixed(3)} s`;
    if (this.slider.getAttribute('aria-valuetext') !== time) {
      this.slider.value = String(head.t);
      this.slider.setAttribute('aria-valuetext', time);
    }
    setText(this.time, time);
    this.speed.value = String(speeds.includes(head.speed) ? head.speed : 1);
    this.showMarks(record, span);
  }

  /** Where each ball departed, above the slider. */
  private showMarks(record: Record, span: Span): void {
    const times = record.throws.flatMap((thrown) =>
      thrown.departed === null ? [] : [thrown.departed],
    );
    const key = `${span.start} ${span.end} ${times.join()}`;
    if (key === this.marked) return;
    this.marked = key;
    const length = Math.max(span.end - span.start, 1e-9);
    this.marks.replaceChildren(
      ...times
        .filter((t) => t >= span.start)
        .map((t) => {
          const mark = make('i');
          mark.style.left = `${(100 * (t - span.start)) / length}%`;
          return mark;
        }),
    );
  }
}
