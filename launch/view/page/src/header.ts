// The bar above: where this comes from, whether it still comes, and the order for throws.

import type { Connection, ConnectionState } from './connection';
import type { Hello } from './messages';
import { element, setText } from './page';
import type { Record } from './record';

export class Header {
  private readonly form = element<HTMLFormElement>('order');
  private readonly throwButton = element<HTMLButtonElement>('order-throw');
  private readonly stopButton = element<HTMLButtonElement>('order-stop');
  private readonly connection = element('connection');
  private state: ConnectionState = 'connecting';
  ordered: () => void = () => undefined;

  listen(connection: Connection): void {
    const number = (id: string): number => element<HTMLInputElement>(id).valueAsNumber;
    this.form.onsubmit = (event) => {
      event.preventDefault();
      connection.order({
        order: 'throw',
        throws: number('order-throws'),
        seed: number('order-seed'),
        realtime: element<HTMLInputElement>('order-realtime').checked,
      });
      this.ordered();
    };
    this.stopButton.onclick = () => connection.order({ order: 'stop' });
  }

  greet(hello: Hello): void {
    setText(element('source'), hello.source);
    element('source').title = `fastball ${hello.version}, arm ${hello.arm}`;
    this.form.hidden = !hello.mayThrow;
    document.title = hello.live
      ? 'fastball view'
      : `${hello.source.split('/').pop()} – fastball view`;
  }

  setState(state: ConnectionState): void {
    this.state = state;
  }

  show(record: Record | null): void {
    const lost = this.state === 'lost';
    const live = record?.hello.live ?? true;
    const kind =
      this.state !== 'open' ? this.state : !live ? 'log' : record?.heard ? 'live' : 'quiet';
    const words: { [kind: string]: string } = {
      connecting: 'Connecting',
      lost: 'Connection lost, trying again',
      log: record?.whole ? 'Log' : 'Loading the log',
      live: 'Live',
      quiet: 'Nothing heard',
    };
    this.connection.dataset['state'] = kind;
    setText(this.connection, words[kind]!);
    const runs = record?.run?.goesOn ?? false;
    this.throwButton.disabled = runs || lost;
    setText(this.throwButton, runs ? 'Throwing' : 'Throw');
    this.stopButton.disabled = !runs || lost;
  }
}
