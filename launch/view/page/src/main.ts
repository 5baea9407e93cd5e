// Puts the parts of the page together, and shows sixty times a second what there is to show.

import 'uplot/dist/uPlot.min.css';
import './colours.css';
import './layout.css';
import './panels.css';
import './small_screen.css';

import { Cameras } from './cameras';
import { Connection } from './connection';
import { Header } from './header';
import type { Hello } from './messages';
import { element, setText } from './page';
import { Playhead, type Span } from './playhead';
import { Plots } from './plots';
import { ProcessList } from './process_list';
import { Reading } from './reading';
import { Record } from './record';
import { Stage, viewNames } from './stage';
import { TargetDrawing } from './target_drawing';
import { ThrowList } from './throw_list';
import { Transport } from './transport';

const tablePeriod = 100; // ms

const head = new Playhead();
const header = new Header();
const cameras = new Cameras();
const reading = new Reading();
const processes = new ProcessList();
const drawing = new TargetDrawing();
let record: Record | null = null;
let stage: Stage | null = null;
let plots: Plots | null = null;
let nextTables = 0;
const transport = new Transport(head, () => (nextTables = 0));
const throws = new ThrowList((t) => {
  head.playing = false;
  transport.goTo(t);
});

function begin(hello: Hello): void {
  record = new Record(hello);
  head.t = 0;
  head.playing = true;
  head.following = hello.live;
  header.greet(hello);
  cameras.reset();
  throws.reset();
  processes.reset();
  if (stage) stage.setRecord(record);
  else {
    stage = new Stage(element<HTMLCanvasElement>('scene'), record);
    stage.onViewChange = showView;
    showView('side');
  }
  if (plots) plots.setRecord(record);
  else plots = new Plots(record);
}

const connection = new Connection({
  hello: begin,
  frame: (frame) => {
    record?.take(frame);
    stage?.touch();
  },
  state: (state) => header.setState(state),
});
header.listen(connection);
header.ordered = () => head.follow();

function showView(name: string | null): void {
  for (const button of document.querySelectorAll<HTMLButtonElement>('#views button'))
    button.setAttribute('aria-pressed', String(button.dataset['view'] === name));
}
for (const button of document.querySelectorAll<HTMLButtonElement>('#views button'))
  button.onclick = () => stage?.look(button.dataset['view']!);

/** Keys that act wherever the focus is, but where they mean something else. */
document.addEventListener('keydown', (event) => {
  const focus = document.activeElement;
  const writes = focus instanceof HTMLInputElement && focus.type !== 'range';
  if (
    writes ||
    focus instanceof HTMLSelectElement ||
    event.ctrlKey ||
    event.altKey ||
    event.metaKey
  )
    return;
  if (event.key === ' ' && focus instanceof HTMLButtonElement) return;
  const turns: { [key: string]: [number, number] } = {
    a: [-1, 0],
    d: [1, 0],
    w: [0, 1],
    s: [0, -1],
  };
  const turn = turns[event.key];
  const view = viewNames[Number(event.key) - 1];
  if (turn) stage?.turn(...turn);
  else if (event.key === '+' || event.key === '-') stage?.zoom(event.key === '+' ? 1 : -1);
  else if (view) stage?.look(view);
  else if (!transport.key(event)) return;
  event.preventDefault();
});

const rate = element('rate');
const frameTimes: number[] = [];
function countFrame(now: number): void {
  frameTimes.push(now);
  while (frameTimes.length > 60) frameTimes.shift();
}

let before = performance.now();
function show(now: number): void {
  requestAnimationFrame(show);
  countFrame(now);
  const passed = Math.min(Math.max(now - before, 0), 250) / 1000;
  before = now;
  header.show(record);
  if (!record) return;
  const span: Span = {
    start: record.start,
    end: Math.max(record.samples.last, record.start),
    live: record.hello.live,
  };
  // A log is not played before it is here.
  if (record.hello.live || record.whole) head.advance(passed, span);
  stage!.draw(head.t);
  plots!.show(head.t);
  cameras.show(record, head.t);
  transport.show(record, span);
  reading.show(record, head.t);
  if (now < nextTables) return;
  nextTables = now + tablePeriod;
  const newest = head.following && record.hello.live;
  const shown = newest ? Infinity : head.t;
  throws.show(record, shown);
  drawing.show(record, newest ? record.now : head.t);
  processes.show(record, head.t, newest);
  reading.tell(record);
  if (frameTimes.length > 1)
    setText(
      rate,
      `${((1000 * (frameTimes.length - 1)) / (frameTimes.at(-1)! - frameTimes[0]!)).toFixed(0)} fps`,
    );
}
requestAnimationFrame(show);
