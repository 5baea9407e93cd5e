// The 3-D view: light, floor, and the camera with which one looks around. The world's z points up.

import * as THREE from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';

import { Figure } from './figure';
import { Flight } from './flight';
import { Net } from './net';
import type { Record } from './record';
import { colour, onThemeChange } from './theme';

/** `hand`: `from` and `to` are as seen from the grasp, with which the view goes along. */
type View = { from: [number, number, number]; to: [number, number, number]; hand?: boolean };

const views: { [name: string]: View } = {
  side: { from: [0.9, -6.9, 0.8], to: [1.35, 0, -0.32] },
  behind: { from: [-3.6, -1.3, 1.3], to: [1.2, -0.05, -0.35] },
  above: { from: [1.35, -0.5, 6.6], to: [1.35, 0, -0.3] },
  hand: { from: [0.25, -1.3, 0.35], to: [0, 0, 0], hand: true },
};
export const viewNames = Object.keys(views);

const turnStep = 0.08; // [rad]
const zoomStep = 1.1;
/** Half the width that is seen, over the distance. */
const halfWidth = 0.36;

/** True where there is no graphics card: smooth edges would then cost the frame rate. */
function drawnByProcessor(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  const named = gl?.getExtension('WEBGL_debug_renderer_info');
  const name = gl && named ? String(gl.getParameter(named.UNMASKED_RENDERER_WEBGL)) : '';
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

export class Stage {
  private readonly renderer: THREE.WebGLRenderer;
  private readonly scene = new THREE.Scene();
  private readonly camera = new THREE.PerspectiveCamera(35, 1, 0.05, 60);
  private readonly controls: OrbitControls;
  private grid: THREE.GridHelper | null = null;
  private figure: Figure;
  private flight: Flight;
  private net: Net;
  /** Where the grasp was when the view was last moved along with it; null: the view stands still. */
  private followed: THREE.Vector3 | null = null;
  private dirty = true;
  private shownTime = NaN;
  onViewChange: (name: string | null) => void = () => undefined;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private record: Record,
  ) {
    const slow = drawnByProcessor();
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !slow });
    // To ask for them waits for the graphics card, in the middle of a throw.
    this.renderer.debug.checkShaderErrors = false;
    this.renderer.setPixelRatio(slow ? 1 : Math.min(window.devicePixelRatio, 2));
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxDistance = 12;
    this.controls.minDistance = 0.3;
    this.controls.addEventListener('change', () => (this.dirty = true));
    this.controls.addEventListener('start', () => this.onViewChange(null));
    this.figure = new Figure(record.hello);
    this.flight = new Flight(record);
    this.net = new Net(record.hello.target);
    const sun = new THREE.DirectionalLight(0xffffff, 2.2);
    sun.position.set(-2, -4, 6);
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8c8c94, 1.4), sun);
    this.scene.add(this.figure.group, this.flight.group, this.net.group);
    this.recolour();
    onThemeChange(() => this.recolour());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.look('side');
    this.prepare();
  }

  /** Shows another record from now on. */
  setRecord(record: Record): void {
    this.scene.remove(this.figure.group, this.flight.group, this.net.group);
    this.record = record;
    this.figure = new Figure(record.hello);
    this.flight = new Flight(record);
    this.net = new Net(record.hello.target);
    this.scene.add(this.figure.group, this.flight.group, this.net.group);
    this.prepare();
    this.dirty = true;
  }

  /** Makes ready what only shows later, so that nothing stops when a ball begins to fly. */
  private prepare(): void {
    const hidden: THREE.Object3D[] = [];
    this.scene.traverse((thing) => {
      if (!thing.visible) hidden.push(thing);
      thing.visible = true;
    });
    this.renderer.compile(this.scene, this.camera);
    for (const thing of hidden) thing.visible = false;
  }

  look(name: string): void {
    const view = views[name];
    if (!view) return;
    this.followed = view.hand ? new THREE.Vector3() : null;
    this.camera.position.set(...view.from);
    this.controls.target.set(...view.to);
    this.controls.update();
    this.onViewChange(name);
    this.dirty = true;
  }

  turn(left: number, up: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const spherical = new THREE.Spherical().setFromVector3(
      new THREE.Vector3(offset.x, offset.z, -offset.y),
    );
    spherical.theta += left * turnStep;
    spherical.phi -= up * turnStep;
    spherical.makeSafe();
    const turned = new THREE.Vector3().setFromSpherical(spherical);
    this.camera.position
      .copy(this.controls.target)
      .add(new THREE.Vector3(turned.x, -turned.z, turned.y));
    this.controls.update();
    this.onViewChange(null);
  }

  zoom(by: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target);
    this.camera.position.copy(this.controls.target).addScaledVector(offset, zoomStep ** -by);
    this.controls.update();
    this.onViewChange(null);
  }

  /** Something else than the time has changed. */
  touch(): void {
    this.dirty = true;
  }

  /** Draws what was at `t`, if anything has changed. */
  draw(t: number): void {
    if (!this.dirty && t === this.shownTime) return;
    this.dirty = false;
    this.shownTime = t;
    this.figure.pose(this.record.samples, t);
    this.net.show(this.record.throwAt(t)?.target ?? this.record.hello.target);
    this.flight.show(t);
    this.goAlong();
    this.renderer.render(this.scene, this.camera);
  }

  private goAlong(): void {
    const grasp = this.figure.grasp;
    if (!this.followed || !grasp || !Number.isFinite(grasp.x)) return;
    const way = grasp.clone().sub(this.followed);
    this.followed.copy(grasp);
    this.camera.position.add(way);
    this.controls.target.add(way);
    this.camera.lookAt(this.controls.target);
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    // A narrow window sees as much of the flight as a wide one.
    this.camera.fov = (360 / Math.PI) * Math.atan(halfWidth / Math.max(this.camera.aspect, 0.5));
    this.camera.updateProjectionMatrix();
    this.dirty = true;
  }

  private recolour(): void {
    const background = new THREE.Color(colour('--stage'));
    this.scene.background = background;
    this.scene.fog = new THREE.Fog(background, 8, 22);
    if (this.grid) {
      this.scene.remove(this.grid);
      this.grid.dispose();
    }
    this.grid = new THREE.GridHelper(24, 48, colour('--grid-strong'), colour('--grid'));
    this.grid.rotation.x = Math.PI / 2;
    this.grid.position.z = this.record.hello.floor;
    this.scene.add(this.grid);
    this.figure.recolour();
    this.flight.recolour();
    this.net.recolour();
    this.dirty = true;
  }
}
