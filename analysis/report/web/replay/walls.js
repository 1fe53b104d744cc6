// The walls: see-through sheets with their edges, or solid, or coloured by a field of their dumps;
// moved by their recorded poses.
import {
  BufferGeometry, Color, DoubleSide, EdgesGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Mesh,
  MeshLambertMaterial, Quaternion, Vector3,
} from 'three';
import { PRESSED, css, ramp } from '../palette.js';

const COLOURS = { dipper: 0x54677a, door: 0x8a6d3b, truck: 0x8e98a1, bench: 0xb7a98f };
const BARE = new Color(0xb9bfc4);

// [r, g, b] of each byte that a triangle can have; 0: nothing to speak of.
const TONES = Array.from({ length: 256 }, (_, byte) => (byte ? new Color(css(ramp(PRESSED, (byte - 1) / 254)).replaceAll(' ', ',')) : BARE));

export class Wall extends Group {
  /// Its values are at `offset` in each of frames.values, field by field.
  constructor({ name, triangles_m, poses, fields }, frames, offset) {
    super();
    this.name = name;
    this.poses = poses;
    this.fields = fields;
    this.frames = frames;
    this.offset = offset;
    this.triangles = triangles_m.length / 9;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(triangles_m, 3));
    geometry.setAttribute('color', new Float32BufferAttribute(new Float32Array(triangles_m.length), 3));
    geometry.computeVertexNormals();
    this.plain = new Color(COLOURS[name] ?? 0x7c8792);
    this.sheet = new Mesh(geometry, new MeshLambertMaterial({ color: this.plain, side: DoubleSide }));
    this.edges = new LineSegments(new EdgesGeometry(geometry, 20), new LineBasicMaterial({ color: 0x222b33 }));
    this.add(this.sheet, this.edges);
    this.field = -1;
    this.clear = true;
    this.dress();
  }

  seeThrough(on) {
    this.clear = on;
    this.dress();
  }

  /// Shows the field of that name on it, if it has it; such a wall is solid.
  colourBy(field) {
    this.field = this.fields.indexOf(field);
    this.painted = -1;
    this.dress();
  }

  dress() {
    const { material } = this.sheet;
    const clear = this.clear && this.field < 0;
    material.transparent = clear;
    material.opacity = clear ? 0.22 : 1;
    material.depthWrite = !clear;
    material.vertexColors = this.field >= 0;
    material.color = this.field >= 0 ? new Color(0xffffff) : this.plain;
    material.needsUpdate = true;
    this.sheet.renderOrder = clear ? 2 : 0;
  }

  /// The bytes of the field that is shown, one a triangle.
  values(frame) {
    const begin = this.offset + this.field * this.triangles;
    return this.frames.values[frame].subarray(begin, begin + this.triangles);
  }

  paint(frame) {
    if (this.field < 0 || this.painted === frame) return;
    this.painted = frame;
    const { color } = this.sheet.geometry.attributes;
    this.values(frame).forEach((byte, k) => {
      for (let corner = 3 * k; corner < 3 * k + 3; ++corner) TONES[byte].toArray(color.array, 3 * corner);
    });
    color.needsUpdate = true;
  }

  at(first, second, share) {
    this.paint(share < 0.5 ? first : second);
    place(this, this.poses, first, second, share);
  }
}

/// Puts an object between two of its poses; one that never moves has one.
export function place(object, poses, first, second, share) {
  const [a, b] = [poses[Math.min(first, poses.length - 1)], poses[Math.min(second, poses.length - 1)]];
  object.position.set(a[0], a[1], a[2]).lerp(new Vector3(b[0], b[1], b[2]), share);
  object.quaternion.set(a[4], a[5], a[6], a[3]).slerp(new Quaternion(b[4], b[5], b[6], b[3]), share);
  object.quaternion.normalize();
}
