// The WebSocket to the server, made anew whenever it ends.

import { decodeFrame, type Frame, type Hello } from './messages';

export type ConnectionState = 'connecting' | 'open' | 'lost';

export interface Listener {
  hello(hello: Hello): void;
  frame(frame: Frame): void;
  state(state: ConnectionState): void;
}

const firstDelay = 250; // ms
const longestDelay = 4000;

export class Connection {
  private socket: WebSocket | null = null;
  private delay = firstDelay;

  constructor(private readonly listener: Listener) {
    this.open();
  }

  /** Asks the server for something; false: there is no connection. */
  order(order: object): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(order));
    return true;
  }

  private open(): void {
    const url = new URL('socket', window.location.href);
    url.protocol = url.protocol === 'https:' ? 'wss:' : 'ws:';
    const socket = new WebSocket(url);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    socket.onmessage = ({ data }: MessageEvent<string | ArrayBuffer>) => {
      if (typeof data === 'string') {
        this.delay = firstDelay;
        this.listener.hello(JSON.parse(data) as Hello);
        this.listener.state('open');
      } else {
        this.listener.frame(decodeFrame(data));
      }
    };
    socket.onclose = () => {
      this.listener.state('lost');
      window.setTimeout(() => this.open(), this.delay);
      this.delay = Math.min(2 * this.delay, longestDelay);
    };
  }
}
