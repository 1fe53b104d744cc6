"""Several runs as one measured folder."""
from dataclasses import replace

import numpy as np

CHANGE_S = 60.0  # from one truck to the next, nothing logged


def in_a_row(runs):
    """Runs one after the other, a truck each."""
    passes, times, start = [], [], 0.0
    for truck, m in enumerate(runs, 1):
        passes += [replace(p, t_start_s=p.t_start_s + start, t_end_s=p.t_end_s + start, truck=truck) for p in m.passes]
        times.append(m.time_s + start)
        start += m.time_s[-1] + CHANGE_S
    signals = {n: np.concatenate([m.signals[n] for m in runs]) for n in runs[0].signals}
    before, left = ({(truck, number): face for truck, m in enumerate(runs, 1) for (_, number), face in kept(m).items()}
                    for kept in (lambda m: m.profiles, lambda m: m.left))
    return replace(runs[0], passes=tuple(passes), time_s=np.concatenate(times), signals=signals, profiles=before,
                   left=left)
