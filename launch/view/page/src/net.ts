// The net: its ring, its bag, and the plane in which landings are measured.

import * as THREE from 'three';

import type { Target } from './messages';
import { colour } from './theme';

const tube = 0.007; // [m], for drawing
const bagDepth = 0.32;
const plane = 0.5;

export class Net {
  readonly group = new THREE.Group();
  private readonly ring = new THREE.MeshStandardMaterial({ roughness: 0.4 });
  private readonly bag = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.45 });
  private readonly frame = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.6 });
  private shown = '';

  constructor(target: Target) {
    this.show(target);
    this.recolour();
  }

  recolour(): void {
    this.ring.color.set(colour('--ring'));
    this.bag.color.set(colour('--line'));
    this.frame.color.set(colour('--line'));
  }

  show(target: Target): void {
    const key = JSON.stringify(target);
    if (key === this.shown) return;
    this.shown = key;
    this.group.clear();
    this.group.add(
      new THREE.Mesh(new THREE.TorusGeometry(target.radius + tube, tube, 12, 64), this.ring),
      new THREE.LineSegments(bagLines(target.radius), this.bag),
      new THREE.LineLoop(
        new THREE.BufferGeometry().setFromPoints(
          [
            [-1, -1],
            [1, -1],
            [1, 1],
            [-1, 1],
          ].map(([x, y]) => new THREE.Vector3((x! * plane) / 2, (y! * plane) / 2, 0)),
        ),
        this.frame,
      ),
    );
    // Right, up and the normal towards the robot.
    const basis = new THREE.Matrix4().makeBasis(
      new THREE.Vector3(...target.right),
      new THREE.Vector3(...target.up),
      new THREE.Vector3(...target.n),
    );
    this.group.setRotationFromMatrix(basis);
    this.group.position.set(...target.p);
  }
}

/** Meridians and hoops of a bag behind the ring. */
function bagLines(radius: number): THREE.BufferGeometry {
  const outline = (share: number): [number, number] => [
    radius * Math.sqrt(1 - share * share * 0.95),
    -bagDepth * share,
  ];
  const at = (share: number, angle: number): THREE.Vector3 => {
    const [r, z] = outline(share);
    return new THREE.Vector3(r * Math.cos(angle), r * Math.sin(angle), z);
  };
  const points: THREE.Vector3[] = [];
  const rows = 8;
  const columns = 20;
  for (let row = 0; row < rows; ++row)
    for (let column = 0; column < columns; ++column) {
      const a = (2 * Math.PI * column) / columns;
      const b = (2 * Math.PI * (column + 1)) / columns;
      points.push(at(row / rows, a), at((row + 1) / rows, a));
      points.push(at((row + 1) / rows, a), at((row + 1) / rows, b));
    }
  return new THREE.BufferGeometry().setFromPoints(points);
}
