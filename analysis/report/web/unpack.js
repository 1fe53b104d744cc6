// Reads the page's data: base64 of gzip, in <script type="text/plain"> elements.

async function gunzip(text) {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/// The numbers: metrics, curves, slices, what describes the replay.
export async function readHead() {
  const element = document.querySelector('script[data-head]');
  const bytes = await gunzip(element.textContent);
  element.remove();
  return JSON.parse(new TextDecoder().decode(bytes));
}

/// Frames of the replay, decoded in the background. The format is that of replay_encoder.hpp.
export class Frames {
  constructor(head) {
    this.spheres = head.spheres;
    this.times = head.times_s;
    this.wallBytes = 0;
    for (const wall of head.walls) this.wallBytes += wall.fields.length * wall.triangles_m.length / 9;
    this.ready = 0;
    this.steps = [];   // a Uint16Array a frame: x, y, z of each sphere, in steps of the box
    this.speeds = [];  // a Uint8Array a frame: 254 sqrt(v / v_max); 255: not in this frame
    this.values = [];  // a Uint8Array a frame: the walls' fields, one wall after the other
  }

  /// Calls progress() after each block; gives way to the page in between.
  async load(progress) {
    let last = new Uint16Array(3 * this.spheres);
    if (this.spheres === 0 && this.wallBytes === 0) { // nothing but poses
      this.steps = this.times.map(() => last);
      this.speeds = this.values = this.times.map(() => new Uint8Array(0));
      this.ready = this.times.length;
      progress();
      return;
    }
    for (const element of document.querySelectorAll('script[data-frames]')) {
      const bytes = await gunzip(element.textContent);
      element.remove();
      const n = this.spheres;
      const size = 7 * n + this.wallBytes;
      for (let at = 0; at < bytes.length; at += size) {
        last = decodeFrame(bytes.subarray(at, at + 7 * n), last, n);
        this.steps.push(last);
        this.speeds.push(bytes.slice(at + 6 * n, at + 7 * n));
        this.values.push(bytes.slice(at + 7 * n, at + size));
      }
      this.ready = this.steps.length;
      progress();
      await new Promise((resolve) => setTimeout(resolve));
    }
  }
}

export function decodeFrame(planes, last, n) {
  const now = new Uint16Array(last);
  for (let axis = 0; axis < 3; ++axis) {
    const low = 2 * axis * n;
    const high = low + n;
    for (let i = 0; i < n; ++i) {
      const change = planes[low + i] | (planes[high + i] << 8);
      if (change) now[3 * i + axis] += (change >> 1) ^ -(change & 1);
    }
  }
  return now;
}
