// The ball, its planned flight, its measured track, and the places of earlier landings.

import * as THREE from 'three';

import { ballAt, landingPoint } from './ball';
import type { Throw } from './messages';
import type { Record } from './record';
import { colour } from './theme';

const mostFixes = 2048;

export class Flight {
  readonly group = new THREE.Group();
  private readonly ball: THREE.Mesh<THREE.SphereGeometry, THREE.MeshStandardMaterial>;
  private readonly plan = new THREE.Line(
    new THREE.BufferGeometry(),
    new THREE.LineDashedMaterial({ dashSize: 0.05, gapSize: 0.04 }),
  );
  private readonly fixes: THREE.InstancedMesh<THREE.SphereGeometry, THREE.MeshBasicMaterial>;
  private readonly marks = new THREE.Group();
  private readonly mark = new THREE.MeshBasicMaterial();
  private readonly markShape: THREE.SphereGeometry;
  private shownPlan = -1;
  private shownMarks = '';

  constructor(private readonly record: Record) {
    const radius = record.hello.ballRadius;
    this.ball = new THREE.Mesh(
      new THREE.SphereGeometry(radius, 40, 20),
      new THREE.MeshStandardMaterial({ roughness: 0.6, transparent: true }),
    );
    this.fixes = new THREE.InstancedMesh(
      new THREE.SphereGeometry(0.008, 8, 6),
      new THREE.MeshBasicMaterial(),
      mostFixes,
    );
    this.fixes.frustumCulled = false;
    this.plan.frustumCulled = false;
    this.markShape = new THREE.SphereGeometry(0.01, 12, 8);
    this.group.add(this.ball, this.plan, this.fixes, this.marks);
    this.recolour();
  }

  recolour(): void {
    this.ball.material.color.set(colour('--ball'));
    this.plan.material.color.set(colour('--muted'));
    this.fixes.material.color.set(colour('--track'));
    this.mark.color.set(colour('--ball'));
  }

  show(t: number): void {
    const place = ballAt(this.record, t);
    this.ball.visible = place !== null;
    if (place) {
      this.ball.position.set(...place.p);
      this.ball.material.opacity = place.kind === 'planned' ? 0.35 : 1;
    }
    const thrown = this.record.throwAt(t);
    this.showPlan(thrown);
    this.showFixes(thrown, t);
    this.showMarks(t);
  }

  private showPlan(thrown: Throw | null): void {
    const flight = thrown?.plan?.flight ?? [];
    this.plan.visible = flight.length > 1;
    if (!thrown || !this.plan.visible || this.shownPlan === thrown.number) return;
    this.shownPlan = thrown.number;
    this.plan.geometry.dispose();
    this.plan.geometry = new THREE.BufferGeometry().setFromPoints(
      flight.map((p) => new THREE.Vector3(...p)),
    );
    this.plan.computeLineDistances();
  }

  private showFixes(thrown: Throw | null, t: number): void {
    const track = thrown ? (this.record.tracks.get(thrown.number) ?? []) : [];
    const place = new THREE.Matrix4();
    let count = 0;
    for (const fix of track) {
      if (fix.t > t || count === mostFixes) break;
      if (fix.measured) this.fixes.setMatrixAt(count++, place.makeTranslation(...fix.p));
    }
    this.fixes.count = count;
    this.fixes.visible = count > 0;
    this.fixes.instanceMatrix.needsUpdate = true;
  }

  private showMarks(t: number): void {
    const landed = this.record.throws.filter(
      (thrown) => thrown.landing?.measured && thrown.landing.t < t,
    );
    const key = landed.map((thrown) => thrown.number).join();
    if (key === this.shownMarks) return;
    this.shownMarks = key;
    this.marks.clear();
    for (const thrown of landed) {
      const mark = new THREE.Mesh(this.markShape, this.mark);
      mark.position.set(...landingPoint(thrown, thrown.target ?? this.record.hello.target));
      this.marks.add(mark);
    }
  }
}
