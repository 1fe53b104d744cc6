// The machine at work: shapes for display only, moved by the record. Ropes are redrawn at each time.
import {
  BufferAttribute, BufferGeometry, Color, EdgesGeometry, Float32BufferAttribute, Group, LineBasicMaterial,
  LineSegments, Mesh, MeshLambertMaterial, Vector3,
} from 'three';
import { passColour } from '../palette.js';
import { colour } from '../theme.js';
import { place } from './walls.js';

const SIDES = 6; // of a rope
const PLAIN = 0x8d979e;
// Greys and a slate blue: the warm tones are the rock's.
const COLOURS = {
  crawlers: 0x43494e, rollers: 0x5c6369, 'car body': 0x555c62, deck: 0x5c6369, house: 0xc3cacf, counterweight: 0x5d7688,
  cab: 0xd5dadd, 'cab foot': 0x8a949b, window: 0x27323a, gantry: 0x5d7688, pendants: 0x3d4449, boom: 0x6f8798, sheaves: 0x4b5358,
  shafts: 0x4b5358, saddle: 0x5d7688, handle: 0x94a0a8, lugs: 0x5d7688, bail: 0x555f67, lip: 0x4b4f52,
  tyres: 0x33383c, hubs: 0x8a949b, axles: 0x4b5358, 'truck frame': 0x6a7176, 'truck engine': 0x9aa5ac, 'truck cab': 0xd5dadd,
  'truck canopy': 0x9aa5ac,
};

export class Figure extends Group {
  constructor({ bodies, ropes }) {
    super();
    this.bodies = bodies.map(({ name, parts, poses }) => {
      const body = new Group();
      body.name = name;
      body.poses = poses;
      body.add(...parts.flatMap(solid));
      return body;
    });
    this.ropes = ropes.map((rope) => new Rope(rope));
    if (bodies.length) this.add(...this.bodies, ...this.ropes);
  }

  at(first, second, share) {
    for (const body of this.bodies) place(body, body.poses, first, second, share);
    for (const rope of this.ropes) rope.at(first, second, share);
  }
}

function solid({ name, triangles_m }) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(triangles_m, 3));
  geometry.computeVertexNormals();
  const tone = new Color(COLOURS[name] ?? PLAIN);
  const sheet = new Mesh(geometry, new MeshLambertMaterial({ color: tone, flatShading: true }));
  const edges = new LineSegments(new EdgesGeometry(geometry, 35), new LineBasicMaterial({ color: tone.clone().multiplyScalar(0.45) }));
  return [sheet, edges];
}

class Rope extends Mesh {
  constructor({ radius_m, pass, ways }) {
    const rings = ways[0].length / 3;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(3 * SIDES * rings), 3));
    const index = [];
    for (let r = 0; r + 1 < rings; ++r) {
      for (let k = 0; k < SIDES; ++k) {
        const [a, b] = [r * SIDES + k, r * SIDES + (k + 1) % SIDES];
        index.push(a, b, b + SIDES, a, b + SIDES, a + SIDES);
      }
    }
    geometry.setIndex(index);
    super(geometry, new MeshLambertMaterial({ color: pass ? colour(passColour(pass)) : 0x2d3338, flatShading: true }));
    this.frustumCulled = false; // its bounds change with it
    this.radius = radius_m;
    this.ways = ways;
  }

  at(first, second, share) {
    const [a, b] = [this.ways[first], this.ways[second]];
    const points = [];
    for (let k = 0; k < a.length; k += 3) {
      points.push(new Vector3(a[k], a[k + 1], a[k + 2]).lerp(new Vector3(b[k], b[k + 1], b[k + 2]), share));
    }
    const { position } = this.geometry.attributes;
    const [along, across, other] = [new Vector3(), new Vector3(), new Vector3()];
    points.forEach((p, r) => {
      along.subVectors(points[Math.min(r + 1, points.length - 1)], points[Math.max(r - 1, 0)]).normalize();
      across.set(-along.y, along.x, 0);
      if (across.lengthSq() < 1e-6) across.set(1, 0, 0);
      across.normalize();
      other.crossVectors(along, across);
      for (let k = 0; k < SIDES; ++k) {
        const angle = 2 * Math.PI * k / SIDES;
        const [c, s] = [this.radius * Math.cos(angle), this.radius * Math.sin(angle)];
        position.setXYZ(r * SIDES + k, p.x + c * across.x + s * other.x, p.y + c * across.y + s * other.y, p.z + c * across.z + s * other.z);
      }
    });
    position.needsUpdate = true;
  }
}
