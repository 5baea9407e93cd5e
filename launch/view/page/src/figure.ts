// Arm and hand as capsules between the points of a sample.

import * as THREE from 'three';

import type { Hello } from './messages';
import type { Samples } from './samples';
import { colour } from './theme';

const axis = new THREE.Vector3(0, 1, 0);

class Capsule {
  readonly group = new THREE.Group();
  private readonly rod: THREE.Mesh;
  private readonly ends: THREE.Mesh[];

  constructor(
    private readonly radius: number,
    material: THREE.Material,
  ) {
    const segments = radius > 0.03 ? 32 : 16;
    this.rod = new THREE.Mesh(
      new THREE.CylinderGeometry(radius, radius, 1, segments, 1, true),
      material,
    );
    const ball = new THREE.SphereGeometry(radius, segments, segments / 2);
    this.ends = [new THREE.Mesh(ball, material), new THREE.Mesh(ball, material)];
    this.group.add(this.rod, ...this.ends);
  }

  place(from: THREE.Vector3, to: THREE.Vector3): void {
    const way = to.clone().sub(from);
    const length = way.length();
    this.group.visible = Number.isFinite(length) && this.radius > 0;
    if (!this.group.visible) return;
    this.rod.position.copy(from).addScaledVector(way, 0.5);
    this.rod.scale.set(1, Math.max(length, 1e-6), 1);
    this.rod.quaternion.setFromUnitVectors(axis, length > 0 ? way.divideScalar(length) : axis);
    this.ends[0]!.position.copy(from);
    this.ends[1]!.position.copy(to);
  }
}

export class Figure {
  readonly group = new THREE.Group();
  private readonly arm = new THREE.MeshStandardMaterial({ roughness: 0.55, metalness: 0.15 });
  private readonly hand = new THREE.MeshStandardMaterial({ roughness: 0.5, metalness: 0.1 });
  private readonly armColour = new THREE.Color();
  private readonly restColour = new THREE.Color();
  private readonly capsules: Capsule[];
  private readonly points: THREE.Vector3[] = [];

  constructor(private readonly hello: Hello) {
    this.capsules = hello.parts.map(
      (part) => new Capsule(part.radius, part.hand ? this.hand : this.arm),
    );
    this.group.add(...this.capsules.map((capsule) => capsule.group));
    for (const part of hello.parts)
      for (const i of [part.from, part.to]) this.points[i] ??= new THREE.Vector3(NaN, NaN, NaN);
    this.points[hello.heldBall] ??= new THREE.Vector3();
    this.recolour();
  }

  recolour(): void {
    this.armColour.set(colour('--arm'));
    this.restColour.set(colour('--arm-rest'));
    this.hand.color.set(colour('--hand'));
  }

  /** Poses the figure as it was at `t`; before the first sample, pale and at rest. */
  pose(samples: Samples, t: number): void {
    const i = samples.at(t);
    this.arm.color.copy(i < 0 ? this.restColour : this.armColour);
    const read = (where: number): number => samples.between(i, t, where);
    this.points.forEach((point, index) => {
      const where = this.hello.layout.points + 3 * index;
      if (i >= 0) point.set(read(where), read(where + 1), read(where + 2));
      else point.set(...(this.hello.rest[index]!.map((x) => x ?? NaN) as [number, number, number]));
    });
    this.hello.parts.forEach((part, index) =>
      this.capsules[index]!.place(this.points[part.from]!, this.points[part.to]!),
    );
  }

  /** Centre of the grasp. */
  get grasp(): THREE.Vector3 | undefined {
    return this.points[this.hello.heldBall];
  }
}
