// What goes on at the time that is shown, in a few words over the 3-D view; and what is missing.

import { ballAt } from './ball';
import { armPhases, handPhases, type Throw } from './messages';
import { element, make, setText, signed } from './page';
import type { Record } from './record';

const ballWords = {
  held: 'ball in the hand',
  inferred: 'ball by its later track',
  measured: 'ball measured',
  planned: 'ball as planned, not seen',
  landed: 'ball landed',
};

function untilRelease(thrown: Throw, t: number): string {
  const release = thrown.departed ?? thrown.plannedRelease;
  return release === null
    ? ''
    : `${signed(t - release, 3)} s ${thrown.departed === null ? 'from the planned release' : 'from the release'}`;
}

export class Reading {
  private readonly place = element('reading');
  private readonly lines = [make('strong'), make('span'), make('span'), make('span')];
  private readonly notices = element('notices');
  private told = '';

  constructor() {
    this.place.append(...this.lines);
  }

  show(record: Record, t: number): void {
    const thrown = record.throwAt(t);
    const i = record.samples.at(t);
    const phase = (where: number, names: string[]): string =>
      i < 0 ? '' : (names[Math.round(record.samples.value(i, where))] ?? '');
    const { layout } = record.hello;
    const arm = phase(layout.armPhase, armPhases);
    const hand = phase(layout.handPhase, handPhases);
    const ball = ballAt(record, t);
    setText(this.lines[0]!, thrown ? `Throw ${thrown.number}` : '');
    setText(this.lines[1]!, thrown ? untilRelease(thrown, t) : '');
    setText(
      this.lines[2]!,
      [arm && `arm: ${arm}`, hand && `hand: ${hand}`].filter(Boolean).join(', '),
    );
    setText(this.lines[3]!, ball ? ballWords[ball.kind] : '');
  }

  tell(record: Record): void {
    const warnings = [...record.notices];
    if (record.run?.failed) warnings.push(record.run.words);
    for (const thrown of record.throws)
      if (thrown.note) warnings.push(`Throw ${thrown.number}: ${thrown.note}`);
    if (record.skipped > 0)
      warnings.push(`This page was too slow for ${record.skipped} states, which it does not show.`);
    const remarks: string[] = [];
    if (record.run?.goesOn && !record.heard) remarks.push('The processes are starting.');
    else if (record.advice) remarks.push(record.advice);
    if (record.recorded && !record.heard)
      remarks.push(`Recorded. To watch it again: fastball view ${record.recorded}`);
    const key = JSON.stringify([warnings, remarks]);
    if (key === this.told) return;
    this.told = key;
    this.notices.replaceChildren(
      ...warnings.map((sentence) => make('li', { className: 'warning' }, sentence)),
      ...remarks.map((sentence) => make('li', {}, sentence)),
    );
  }
}
