// The scene: rocks, walls, ground, light and the camera.
import {
  Box3, Color, DirectionalLight, Fog, GridHelper, Group, HemisphereLight, Mesh, MeshLambertMaterial, PerspectiveCamera,
  Plane, PlaneGeometry, Scene, Sphere, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { SPEED } from '../palette.js';
import { isDark } from '../theme.js';
import { Figure } from './figure.js';
import { Rocks } from './rocks.js';
import { Wall } from './walls.js';

const LIGHT = { sky: 0xeef1f2, ground: 0xcdc9c0, lines: 0xc0bbb1 };
const DARK = { sky: 0x20272d, ground: 0x3a3d3e, lines: 0x4a4e50 };
const SLOW_ms = 60;

export class Stage {
  constructor(canvas, head, frames, clock, scaleTop) {
    this.clock = clock;
    this.frames = frames;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
    this.sharp = Math.min(devicePixelRatio, 2);
    this.renderer.setPixelRatio(this.sharp);
    this.scene = new Scene();
    this.scene.background = new Color();
    this.scene.fog = new Fog(0, 70, 160);
    this.ground = ground();
    this.dress();
    this.camera = new PerspectiveCamera(36, 2, 0.3, 400);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = 0.495 * Math.PI;
    this.controls.minDistance = 3;
    this.controls.maxDistance = 120;
    this.controls.addEventListener('change', () => this.ask());

    this.rocks = new Rocks(head, frames, scaleTop, SPEED);
    let offset = 0;
    this.walls = head.walls.map((wall) => {
      const made = new Wall(wall, frames, offset);
      offset += wall.fields.length * made.triangles;
      return made;
    });
    this.dipper = this.walls.find((wall) => wall.name === 'dipper');
    this.figure = head.figure.bodies.length > 0 ? new Figure(head.figure) : null;
    if (this.figure) this.scene.add(this.figure);
    this.scene.add(this.rocks, ...this.walls, this.ground, ...lights());
    this.plane = new Plane();
    this.cutting = false;
    this.following = false;
    clock.addEventListener('time', () => this.ask());
    clock.addEventListener('state', () => { if (!clock.playing) this.sharpness(1); });
    this.late = 0;
  }

  /// Sky and ground, light or dark.
  dress() {
    const { sky, ground: plain, lines } = isDark() ? DARK : LIGHT;
    this.scene.background.set(sky);
    this.scene.fog.color.set(sky);
    const [plane, grid] = this.ground.children;
    plane.material.color.set(plain);
    grid.material.color.set(lines);
  }

  resize(width, height) {
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.ask();
  }

  /// Draws once before the next picture of the screen, however often it is asked.
  ask() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(() => {
      this.asked = false;
      this.draw();
    });
  }

  /// Draws at lower resolution while the replay is too slow.
  pace() {
    const now = performance.now();
    this.late = this.clock.playing && now - this.drawn > SLOW_ms ? this.late + 1 : 0;
    this.drawn = now;
    const share = this.renderer.getPixelRatio() / this.sharp;
    if (this.late >= 4 && share > 0.35) this.sharpness(0.7 * share);
  }

  sharpness(share) {
    this.late = 0;
    if (this.renderer.getPixelRatio() === share * this.sharp) return;
    this.renderer.setPixelRatio(share * this.sharp);
    this.ask();
  }

  draw() {
    if (!this.frames.ready) return;
    this.pace();
    const { first, second, share } = this.between();
    const before = this.dipper?.position.clone();
    for (const wall of this.walls) wall.at(first, second, share);
    this.figure?.at(first, second, share);
    this.rocks.at(first, second, share);
    if (this.following && this.dipper && before) {
      const moved = this.dipper.position.clone().sub(before);
      this.camera.position.add(moved);
      this.controls.target.add(moved);
      this.camera.lookAt(this.controls.target);
    }
    this.rocks.cut(this.cutting ? this.middlePlane() : null);
    this.renderer.render(this.scene, this.camera);
  }

  /// About all that is drawn, or about the rock where there is no figure.
  bounds() {
    const rocks = this.rocks.geometry.boundingSphere;
    if (!this.figure) return new Sphere(rocks.center.clone().setZ(3), rocks.radius);
    const box = new Box3().setFromObject(this.figure);
    for (const way of [-1, 1]) box.expandByPoint(rocks.center.clone().addScalar(way * 0.4 * rocks.radius));
    return box.getBoundingSphere(new Sphere());
  }

  between() {
    const last = this.frames.ready - 1;
    const first = Math.min(this.clock.index(this.clock.time), last);
    const second = Math.min(first + 1, last);
    const [a, b] = [this.clock.times[first], this.clock.times[second]];
    return { first, second, share: b > a ? Math.min((this.clock.time - a) / (b - a), 1) : 0 };
  }

  /// Through the dipper's middle; its positive side is the camera's.
  middlePlane() {
    if (!this.dipper) return null;
    const lateral = new Vector3(0, 1, 0).applyQuaternion(this.dipper.quaternion);
    if (lateral.dot(this.camera.position.clone().sub(this.dipper.position)) < 0) lateral.negate();
    return this.plane.setFromNormalAndCoplanarPoint(lateral, this.dipper.position);
  }

  /// Looks from `offset` [m] at the dipper, or at a point.
  look(target, offset, follow) {
    this.following = follow;
    this.controls.target.copy(target);
    this.camera.position.copy(target).add(offset);
    this.controls.update();
    this.ask();
  }
}

function ground() {
  const group = new Group();
  const plane = new Mesh(new PlaneGeometry(400, 400), new MeshLambertMaterial());
  plane.position.z = -0.03;
  const grid = new GridHelper(200, 40, 0xffffff, 0xffffff);
  grid.rotation.x = Math.PI / 2;
  group.add(plane, grid);
  return group;
}

function lights() {
  const sun = new DirectionalLight(0xffffff, 1.6);
  sun.position.set(-20, -30, 50);
  const sky = new HemisphereLight(0xffffff, 0xb9b2a5, 1.9);
  sky.position.set(0, 0, 1);
  return [sun, sky];
}
