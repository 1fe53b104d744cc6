// What the page draws, made from metrics.json (docs/metrics.md) and the curves of the record.

const FLOW_FASTER = 0.1; // m/s against the dipper; docs/metrics.md
const DIGS = ['penetrate', 'fill', 'breakout'];

export class Model {
  constructor(head) {
    const m = head.metrics ?? {};
    this.title = head.title;
    this.metrics = m;
    this.caseText = head.case_text ?? '';
    this.curves = head.curves;
    this.slices = head.slices;
    this.replay = head.replay;
    this.passes = (m.passes ?? []).map((p) => ({ ...p, phases: (m.phases ?? []).filter((row) => row.pass === p.pass) }));
    this.drives = m.drives; // of limited drives alone
    this.coupling = m.coupling;
    this.dem = m.dem;
    this.mbs = m.mbs;
    const { frames, dipper } = m;
    this.zones = frames?.flow_kg && frames.time_s.length > 1 && { // of the start alone there is no curve
      threshold_m_s: FLOW_FASTER,
      region: dipper?.load_region ?? dipper?.cavity,
      time_s: frames.time_s,
      all_t: frames.in_dipper_kg.map((kg) => kg / 1e3),
      bulk_t: frames.bulk_kg.map((kg) => kg / 1e3),
    };
    this.phases = (m.phases ?? []).map((p) => ({ name: p.phase, from: p.t_start_s, to: p.t_end_s }));
    this.run = m.run ?? {};
    this.program = typeof this.run.operator === 'string' ? this.run.operator : null; // the command of one that drives
    this.classes = new Map((m.sizes ?? []).map((c) => [c.class, c])); // by a sphere's type
  }

  /// The size of the rock that each sphere of the replay is of [m]: of a clump its class's, else what its spheres
  /// would make as one.
  rockSizes() {
    const { radius_m: radii = [], rock: rocks = [], type: types = [] } = this.replay;
    const cubes = new Map();
    rocks.forEach((rock, i) => { if (rock >= 0) cubes.set(rock, (cubes.get(rock) ?? 0) + (2 * radii[i]) ** 3); });
    return radii.map((r, i) => (rocks[i] < 0 ? 2 * r : this.classes.get(types[i])?.size_m ?? Math.cbrt(cubes.get(rocks[i]))));
  }

  channel(name) {
    return this.curves.channels[name]?.values;
  }
  /// √(hoist² + crowd²) where the dipper digs, from first contact. Anywhere else it is what dipper and load weigh: null.
  digForce() {
    const contact = (t) => this.passes.find((p) => p.t_start_s <= t && t < p.t_end_s)?.t_dig_s ?? t;
    const digs = this.phases.filter(({ name }) => DIGS.includes(name)).map(({ from, to }) => ({ from: Math.max(from, contact(from)), to }));
    if (!digs.length) return undefined;
    const time = this.curves.time_s;
    return this.channel('dig_force')?.map((force, k) => (digs.some((p) => p.from <= time[k] && time[k] <= p.to) ? force : null));
  }
}
