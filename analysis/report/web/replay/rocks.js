// The rocks: each sphere a square that faces the camera, on which the shader draws a lit sphere
// with its true depth. So 20,000 cost 40,000 triangles, and clumps look like one stone.
import {
  BufferAttribute, DataTexture, DynamicDrawUsage, InstancedBufferAttribute, InstancedBufferGeometry, LinearFilter,
  Mesh, RGBAFormat, ShaderMaterial, Sphere, SRGBColorSpace, Uint16BufferAttribute, Vector3, Vector4,
} from 'three';
import { ramp } from '../palette.js';

const vertexShader = /* glsl */ `
  uniform vec3 origin, size;
  uniform float between, speedMax, scaleTop;
  uniform bool bySpeed;
  uniform vec4 cut;
  attribute vec3 from, to;
  attribute float radius, speedFrom, speedTo;
  attribute vec3 tint;
  varying vec3 colour, middle;
  varying vec2 corner;
  varying float r;
  uniform sampler2D scale;

  void main() {
    bool absent = speedFrom > 0.999 || speedTo > 0.999;
    vec3 p = origin + size * mix(from, to, between);
    if (absent || dot(cut.xyz, p) + cut.w > 0.0) {
      gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
      return;
    }
    float s = mix(speedFrom, speedTo, between) * (255.0 / 254.0);
    colour = bySpeed ? texture2D(scale, vec2(clamp(s * s * speedMax / scaleTop, 0.002, 0.998), 0.5)).rgb : tint;
    middle = (modelViewMatrix * vec4(p, 1.0)).xyz;
    r = radius;
    corner = position.xy;
    vec3 right = normalize(cross(middle, vec3(0.0, 1.0, 0.0)));
    vec3 up = normalize(cross(right, middle));
    gl_Position = projectionMatrix * vec4(middle + r * (corner.x * right + corner.y * up), 1.0);
  }
`;

const fragmentShader = /* glsl */ `
  uniform mat4 projectionMatrix;
  varying vec3 colour, middle;
  varying vec2 corner;
  varying float r;

  void main() {
    float q = dot(corner, corner);
    if (q > 1.0) discard;
    vec3 towards = -normalize(middle);
    vec3 right = normalize(cross(middle, vec3(0.0, 1.0, 0.0)));
    vec3 up = normalize(cross(right, middle));
    vec3 n = normalize(corner.x * right + corner.y * up + sqrt(1.0 - q) * towards);
    vec4 clip = projectionMatrix * vec4(middle + r * n, 1.0);
    gl_FragDepth = 0.5 * clip.z / clip.w + 0.5;
    float sun = max(dot(n, normalize(vec3(-0.35, 0.8, 0.5))), 0.0);
    float rim = smoothstep(0.0, 0.45, dot(n, towards));
    gl_FragColor = vec4(colour * (0.46 + 0.6 * sun) * mix(0.62, 1.0, rim), 1.0);
    #include <colorspace_fragment>
  }
`;

export class Rocks extends Mesh {
  constructor(head, frames, scaleTop, scale) {
    const n = head.spheres;
    const square = new InstancedBufferGeometry();
    square.instanceCount = n;
    square.setIndex(new Uint16BufferAttribute([0, 1, 2, 2, 1, 3], 1));
    square.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 1, -1, 0, -1, 1, 0, 1, 1, 0]), 3));
    const per = (name, array, width, normalised) => {
      const attribute = new InstancedBufferAttribute(array, width, normalised);
      attribute.setUsage(DynamicDrawUsage);
      square.setAttribute(name, attribute);
    };
    per('from', new Uint16Array(3 * n), 3, true);
    per('to', new Uint16Array(3 * n), 3, true);
    per('speedFrom', new Uint8Array(n), 1, true);
    per('speedTo', new Uint8Array(n), 1, true);
    per('radius', new Float32Array(head.radius_m ?? []), 1);
    per('tint', new Uint8Array(3 * n), 3, true);
    const size = head.step_m.map((step) => step * 65535);
    square.boundingSphere = new Sphere(new Vector3(...head.origin_m).add(new Vector3(...size).divideScalar(2)),
      new Vector3(...size).length() / 2 + 2);
    super(square, new ShaderMaterial({
      vertexShader,
      fragmentShader,
      uniforms: {
        origin: { value: new Vector3(...head.origin_m) },
        size: { value: new Vector3(...size) },
        between: { value: 0 },
        speedMax: { value: head.speed_max_m_s },
        scaleTop: { value: scaleTop },
        scale: { value: scaleTexture(scale) },
        bySpeed: { value: true },
        cut: { value: new Vector4(0, 0, 0, -1) },
      },
    }));
    this.frames = frames;
    this.shown = [-1, -1];
  }

  /// Between two frames; `share` 0 is the first.
  at(first, second, share) {
    const { attributes } = this.geometry;
    const put = (name, data) => {
      attributes[name].array = data;
      attributes[name].needsUpdate = true;
    };
    if (this.shown[0] !== first) {
      put('from', this.frames.steps[first]);
      put('speedFrom', this.frames.speeds[first]);
    }
    if (this.shown[1] !== second) {
      put('to', this.frames.steps[second]);
      put('speedTo', this.frames.speeds[second]);
    }
    this.shown = [first, second];
    this.material.uniforms.between.value = share;
  }

  /// One colour a sphere, [r, g, b] to 255; without, the colours are by speed.
  tint(colourOf) {
    this.material.uniforms.bySpeed.value = !colourOf;
    if (!colourOf) return;
    const { tint } = this.geometry.attributes;
    for (let i = 0; i < tint.count; ++i) tint.array.set(linear(colourOf(i)), 3 * i);
    tint.needsUpdate = true;
  }

  /// Hides what lies on the positive side of a plane; null: nothing.
  cut(plane) {
    if (plane) this.material.uniforms.cut.value.set(plane.normal.x, plane.normal.y, plane.normal.z, plane.constant);
    else this.material.uniforms.cut.value.set(0, 0, 0, -1);
  }
}

// Light adds up in linear colour; the screen's is not.
function linear(rgb) {
  return rgb.map((v) => Math.round(255 * (v / 255 <= 0.04045 ? v / 255 / 12.92 : ((v / 255 + 0.055) / 1.055) ** 2.4)));
}

function scaleTexture(stops) {
  const data = new Uint8Array(4 * 256);
  for (let i = 0; i < 256; ++i) data.set([...ramp(stops, i / 255), 255], 4 * i);
  const texture = new DataTexture(data, 256, 1, RGBAFormat);
  texture.colorSpace = SRGBColorSpace;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.needsUpdate = true;
  return texture;
}
