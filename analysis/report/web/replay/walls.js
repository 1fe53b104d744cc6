// The walls: see-through sheets with their edges, or solid; moved by their recorded poses.
import {
  BufferGeometry, DoubleSide, EdgesGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Mesh,
  MeshLambertMaterial, Quaternion, Vector3,
} from 'three';

const COLOURS = { dipper: 0x54677a, door: 0x8a6d3b, truck: 0x8e98a1 };

export class Wall extends Group {
  constructor({ name, triangles_m, poses }) {
    super();
    this.name = name;
    this.poses = poses;
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(triangles_m, 3));
    geometry.computeVertexNormals();
    this.sheet = new Mesh(geometry, new MeshLambertMaterial({
      color: COLOURS[name] ?? 0x7c8792, side: DoubleSide, transparent: true, depthWrite: false,
    }));
    this.edges = new LineSegments(new EdgesGeometry(geometry, 20), new LineBasicMaterial({ color: 0x222b33 }));
    this.add(this.sheet, this.edges);
    this.seeThrough(true);
  }

  seeThrough(on) {
    const { material } = this.sheet;
    material.transparent = on;
    material.opacity = on ? 0.22 : 1;
    material.depthWrite = !on;
    material.needsUpdate = true;
    this.sheet.renderOrder = on ? 2 : 0;
  }

  at(first, second, share) {
    const [a, b] = [this.poses[first], this.poses[second]];
    this.position.set(a[0], a[1], a[2]).lerp(new Vector3(b[0], b[1], b[2]), share);
    this.quaternion.set(a[4], a[5], a[6], a[3]).slerp(new Quaternion(b[4], b[5], b[6], b[3]), share);
    this.quaternion.normalize();
  }
}
