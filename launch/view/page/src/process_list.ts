// The processes with the state that they last said, and how long ago.

import { element, make, setText } from './page';
import type { HeardBeat, Record } from './record';

const lateAfter = 2.5; // [s], HEARTBEAT comes once a second
const columns = 5;

export class ProcessList {
  private readonly body = element<HTMLTableSectionElement>('process-rows');
  private readonly rows = new Map<string, HTMLTableRowElement>();

  reset(): void {
    this.rows.clear();
    this.body.replaceChildren();
  }

  /** `now`: the newest heartbeats count, by wall time; else those said by `t`. */
  show(record: Record, t: number, now: boolean): void {
    const newest = new Map<string, HeardBeat>();
    for (const beat of record.heartbeats)
      if (now || beat.t <= t + 1e-9) newest.set(`${beat.name} ${beat.host}`, beat);
    for (const [key, row] of this.rows) row.hidden = !newest.has(key);
    const hosts = new Set([...newest.values()].map((beat) => beat.host));
    for (const [key, beat] of newest) {
      const cells = this.rowOf(key).cells;
      const age = now && record.hello.live ? (performance.now() - beat.heardAt) / 1000 : t - beat.t;
      const late = age > lateAfter && beat.state !== 'ended';
      setText(cells[0]!, hosts.size > 1 ? `${beat.name} (${beat.host})` : beat.name);
      setText(cells[1]!, beat.state);
      setText(cells[2]!, age < 100 ? `${Math.max(age, 0).toFixed(1)} s` : '> 100 s');
      setText(cells[3]!, beat.meanUs.toFixed(0));
      setText(cells[4]!, String(beat.lost + beat.invalid));
      cells[1]!.className = beat.state === 'failed' ? 'bad' : '';
      cells[2]!.className = late ? 'bad' : '';
      cells[0]!.parentElement!.title =
        `${beat.name} ${beat.version}, process ${beat.pid} on ${beat.host}` +
        (beat.detail ? `: ${beat.detail}` : '');
    }
  }

  private rowOf(key: string): HTMLTableRowElement {
    let row = this.rows.get(key);
    if (!row) {
      row = make('tr', {}, ...Array.from({ length: columns }, () => make('td')));
      this.rows.set(key, row);
      const after = [...this.rows.keys()].sort().indexOf(key);
      this.body.insertBefore(row, this.body.children[after] ?? null);
    }
    return row;
  }
}
