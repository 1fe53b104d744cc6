// What the page draws, made from metrics.json (docs/metrics.md) and the curves of the record.

export class Model {
  constructor(head) {
    const m = head.metrics ?? {};
    this.title = head.title;
    this.metrics = m;
    this.caseText = head.case_text ?? '';
    this.curves = head.curves;
    this.slices = head.slices;
    this.replay = head.replay;
    this.passes = m.passes ?? [];
    this.coupling = m.coupling;
    this.dem = m.dem;
    this.mbs = m.mbs;
    this.zones = m.zones;
    this.phases = (m.phases ?? []).map((p) => ({ name: p.phase, from: p.t_start_s, to: p.t_end_s }));
    this.run = m.run ?? {};
    this.classNames = (m.classes ?? []).map((c) => c.name ?? c);
  }

  channel(name) {
    return this.curves.channels[name]?.values;
  }
}
