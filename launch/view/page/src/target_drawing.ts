// Landings on the target as the robot sees it: the whole ring, and beside it the landings magnified, with their ellipses.

import type { Landing, Target } from './messages';
import { element } from './page';
import type { Record } from './record';

const svgNamespace = 'http://www.w3.org/2000/svg';
const chiSquare95 = 5.991; // of two degrees of freedom
const half = 50; // of a panel, in the drawing's own units
const gap = 10;

function shape(
  tag: string,
  attributes: { [name: string]: string | number },
  words = '',
): SVGElement {
  const made = document.createElementNS(svgNamespace, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  if (words) made.textContent = words;
  return made;
}

/** Half axes [m] and direction [degrees] of the 95 % region. */
export function ellipse([xx, xy, yy]: Landing['cov']): { a: number; b: number; angle: number } {
  const middle = (xx + yy) / 2;
  const spread = Math.hypot((xx - yy) / 2, xy);
  return {
    a: Math.sqrt(chiSquare95 * Math.max(middle + spread, 0)),
    b: Math.sqrt(chiSquare95 * Math.max(middle - spread, 0)),
    angle: (90 / Math.PI) * Math.atan2(2 * xy, xx - yy),
  };
}

/** 1, 2 or 5 times a power of ten, not smaller than `length`. */
function roundUp(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  return power * ([1, 2, 5, 10].find((factor) => factor * power >= length * 0.999) ?? 10);
}

export class TargetDrawing {
  private readonly svg = element<SVGSVGElement>('target');
  private drawn = '';

  show(record: Record, t: number): void {
    const current = record.throwAt(t);
    const landed = record.throws.filter(
      (thrown) => thrown.landing?.measured && thrown.landing.t <= t,
    );
    const target = current?.target ?? record.hello.target;
    const key = JSON.stringify([
      target.radius,
      landed.map((thrown) => [thrown.number, thrown.landing!.at]),
      current?.number,
    ]);
    if (key === this.drawn) return;
    this.drawn = key;
    const latest = landed.filter((thrown) => thrown === current).length ? current!.number : -1;
    const landings = landed.map((thrown) => ({
      landing: thrown.landing!,
      latest: thrown.number === latest,
    }));
    const width = 4 * half + gap;
    this.svg.setAttribute('viewBox', `${-half - 2} ${-half - 2} ${width + 4} ${2 * half + 14}`);
    this.svg.replaceChildren(
      ...this.whole(target, record.hello.ballRadius, landings),
      ...this.magnified(landings),
    );
  }

  private whole(target: Target, ballRadius: number, landings: Mark[]): SVGElement[] {
    const scale = half / (1.25 * target.radius);
    const radius = target.radius * scale;
    const ring = shape('circle', { class: 'ring', r: radius });
    const cross = shape('path', { class: 'cross', d: `M${-half} 0H${half}M0 ${-half}V${half}` });
    const balls = landings
      .filter((mark) => mark.latest)
      .map(({ landing }) =>
        shape('circle', {
          class: 'ball',
          cx: landing.at[0] * scale,
          cy: -landing.at[1] * scale,
          r: ballRadius * scale,
        }),
      );
    const dots = landings.map(({ landing, latest }) =>
      shape('circle', {
        class: latest ? 'dot latest' : 'dot',
        cx: landing.at[0] * scale,
        cy: -landing.at[1] * scale,
        r: 1.4,
      }),
    );
    return [
      cross,
      ring,
      ...balls,
      ...dots,
      words(0, `ring, ${Math.round(2000 * target.radius)} mm`),
    ];
  }

  private magnified(landings: Mark[]): SVGElement[] {
    const group = shape('g', { transform: `translate(${2 * half + gap} 0)` });
    const frame = shape('rect', {
      class: 'frame',
      x: -half,
      y: -half,
      width: 2 * half,
      height: 2 * half,
    });
    if (landings.length === 0) {
      group.append(frame, words(0, 'no landing yet', 0));
      return [group];
    }
    const reach = Math.max(
      0.0005,
      ...landings.map(
        ({ landing }) =>
          Math.max(Math.abs(landing.at[0]), Math.abs(landing.at[1])) + ellipse(landing.cov).a,
      ),
    );
    const extent = roundUp(reach * 1.1);
    const scale = half / extent;
    const step = extent / 2;
    const grid = shape('path', {
      class: 'cross faint',
      d: [-1, 1]
        .map((k) => `M${-half} ${k * step * scale}H${half}M${k * step * scale} ${-half}V${half}`)
        .join(''),
    });
    const cross = shape('path', { class: 'cross', d: `M${-half} 0H${half}M0 ${-half}V${half}` });
    const marks = landings.flatMap(({ landing, latest }) => {
      const { a, b, angle } = ellipse(landing.cov);
      const place = `translate(${landing.at[0] * scale} ${-landing.at[1] * scale}) rotate(${-angle})`;
      return [
        shape('ellipse', {
          class: latest ? 'region latest' : 'region',
          transform: place,
          rx: a * scale,
          ry: b * scale,
        }),
        shape('path', {
          class: latest ? 'plus latest' : 'plus',
          d: 'M-2 0H2M0 -2V2',
          transform: place.replace(/ rotate.*/, ''),
        }),
      ];
    });
    group.append(
      grid,
      cross,
      frame,
      ...marks,
      words(0, `±${(1000 * extent).toPrecision(1).replace(/e.*/, '')} mm, 95 %`),
    );
    return [group];
  }
}

interface Mark {
  landing: Landing;
  latest: boolean;
}

function words(x: number, text: string, y = half + 10): SVGElement {
  return shape('text', { x, y, 'text-anchor': 'middle' }, text);
}
