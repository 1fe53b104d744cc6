"""A mine that the synthetic model misses at all times: other forces and loads, and instruments that have drifted.

What it was like before and what it is like now are two folders, read by the same instruments.
"""
from dataclasses import replace

import numpy as np

import synthetic
from trucks import in_a_row

DRIFT = 0.3   # of the shared errors, from the one folder to the other
LATER_S = 1e5


def unlike(m):
    """What no effect of a catalogue makes of a run: a sixth less push, an eighth more lift, 7 % less in the truck."""
    signals = dict(m.signals)
    signals["hoist_force_kN"] = 1.12 * signals["hoist_force_kN"] + 40
    signals["crowd_force_kN"] = 0.85 * signals["crowd_force_kN"] - 60 + 30 * np.sin(m.time_s / 9)
    return replace(m, signals=signals, passes=tuple(replace(p, truck_mass_t=0.93 * p.truck_mass_t) for p in m.passes))


def periods(before, now, seed, drift_known=True, spread=1.0):
    """(measured folder, reference folder); `before`, `now`: the effects {name: strength} of each truck."""
    rng = np.random.default_rng([seed, 4])
    channels = synthetic.CHANNELS
    shared = {n: c.common_sigma * rng.standard_normal() for n, c in channels.items()}
    moved = {n: shared[n] + DRIFT * c.common_sigma * rng.standard_normal() for n, c in channels.items()}
    both = {n: replace(c, drift_sigma=DRIFT * c.common_sigma if drift_known else None) for n, c in channels.items()}
    first = 1000 * seed + 50_000
    runs, late_runs = ([unlike(synthetic.run(e, start + k, spread=spread)) for k, e in enumerate(effects)]
                       for start, effects in ((first, before), (first + 500, now)))
    then, late = _folder(runs, shared, both, rng), _folder(late_runs, moved, both, rng)
    passes = tuple(replace(p, t_start_s=p.t_start_s + LATER_S, t_end_s=p.t_end_s + LATER_S) for p in late.passes)
    return replace(late, passes=passes, time_s=late.time_s + LATER_S), then


def _folder(runs, shared, channels, rng):
    out = []
    for m in runs:
        signals = {n: v + (shared[n] + channels[n].sigma * rng.standard_normal(len(v))
                           if channels[n].role == "response" else 0.0) for n, v in m.signals.items()}
        passes = tuple(replace(p, truck_mass_t=p.truck_mass_t + shared["truck_mass_t"]
                               + channels["truck_mass_t"].sigma * rng.standard_normal()) for p in m.passes)
        out.append(replace(m, signals=signals, passes=passes))
    return replace(in_a_row(out), channels=channels)
