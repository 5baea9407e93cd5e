// The throws as rows; a row's number goes to the moment of its release.

import type { Throw } from './messages';
import { element, make, setText, signed } from './page';
import type { Record } from './record';

const beforeRelease = 0.4; // [s]

interface Row {
  row: HTMLTableRowElement;
  cells: HTMLTableCellElement[];
}

function resultOf(thrown: Throw, radius: number, t: number): { words: string; kind: string } {
  const { landing, plan } = thrown;
  if (landing && landing.heard <= t) {
    if (!landing.measured) return { words: 'not measured', kind: 'bad' };
    const miss = Math.hypot(...landing.at);
    return miss < radius
      ? { words: 'in ring', kind: 'good' }
      : { words: `${(1000 * miss).toFixed(0)} mm off`, kind: 'bad' };
  }
  if (thrown.note && thrown.noted <= t) return { words: 'failed', kind: 'bad' };
  if (thrown.departed !== null && thrown.departed <= t) return { words: 'flying', kind: '' };
  if (thrown.scene !== null && thrown.scene <= t) return { words: 'throwing', kind: '' };
  return plan && plan.t <= t ? { words: 'planned', kind: '' } : { words: 'planning', kind: '' };
}

export class ThrowList {
  private readonly body = element<HTMLTableSectionElement>('throw-rows');
  private readonly rows = new Map<number, Row>();

  constructor(private readonly goTo: (t: number) => void) {}

  reset(): void {
    this.rows.clear();
    this.body.replaceChildren();
  }

  show(record: Record, t: number): void {
    const current = record.throwAt(t);
    for (const thrown of record.throws) {
      const { row, cells } = this.rowOf(record, thrown);
      row.hidden = thrown.t > t + 1e-9;
      row.classList.toggle('current', thrown === current);
      const landed = thrown.landing?.measured && thrown.landing.heard <= t ? thrown.landing : null;
      setText(cells[1]!, thrown.plan?.ok ? thrown.plan.speed.toFixed(2) : '–');
      setText(cells[2]!, landed ? signed(1000 * landed.at[0], 1) : '');
      setText(cells[3]!, landed ? signed(1000 * landed.at[1], 1) : '');
      const { words, kind } = resultOf(thrown, (thrown.target ?? record.hello.target).radius, t);
      setText(cells[4]!, words);
      cells[4]!.className = kind;
      row.title = [`strategy ${thrown.strategy || 'not heard'}`, thrown.note]
        .filter(Boolean)
        .join('; ');
    }
  }

  private rowOf(record: Record, thrown: Throw): Row {
    const known = this.rows.get(thrown.number);
    if (known) return known;
    const button = make('button', { type: 'button' }, String(thrown.number));
    button.setAttribute('aria-label', `Go to throw ${thrown.number}`);
    button.onclick = () => {
      const now = record.throws.find((other) => other.number === thrown.number);
      const release = now?.departed ?? now?.plannedRelease ?? null;
      if (release !== null) this.goTo(release - beforeRelease);
      else if (now) this.goTo(now.scene ?? now.t);
    };
    const cells = [make('td', {}, button), ...Array.from({ length: 4 }, () => make('td'))];
    const row = make('tr', {}, ...cells);
    this.body.prepend(row);
    const made = { row, cells };
    this.rows.set(thrown.number, made);
    return made;
  }
}
