"""How long a drive stands still in each phase, as a force shows that acts against its motion.

Friction at rest is whatever holds the drive, between its size one way and the other: a Coulomb law with no memory says
0, a pre-sliding one keeps what the last motion left (Dahl 1968). So in the phases where a drive stands still such an
effect is known to be bounded, and no more.
"""
import numpy as np

from .features import DRIVE
from .phases import find_phases

STILL = 0.1  # of the speed that a drive has in the fastest tenth of its readings


def at_rest(m, cells):
    """(n,) what 1 kN while the channel's own drive stands still adds to each of the cells, at most, from one run."""
    out, share = np.zeros(len(cells)), _shares(m)
    for k, c in enumerate(cells):
        rest, length = share.get((c.pass_number, c.phase, c.channel), (0.0, 1.0))
        out[k] = {"mean": rest, "peak": rest, "slope": 2.0 * rest / length}.get(c.feature, 0.0)
    return out


def _shares(m):
    """{(pass, phase, channel): (share of the phase in which its drive stands still, its length in s)}."""
    if not m.signals:
        return {}
    out, t = {}, m.time_s
    spans = [(p.t_start_s, p.t_end_s) for p in m.passes]
    for channel in (n for n in m.responses() if n in DRIVE):
        speed = np.abs(np.gradient(m.signals[DRIVE[channel][0]], t))
        still = speed < STILL * np.quantile(speed, 0.9)
        for p, phases in zip(m.passes, find_phases(t, m.signals["crowd_m"], m.signals["swing_rad"], spans)):
            for phase, (start, end) in phases.items():
                at = (t >= start) & (t < end)
                if at.any():
                    out[p.number, phase, channel] = float(still[at].mean()), end - start
    return out
