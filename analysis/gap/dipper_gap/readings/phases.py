"""Passes and their phases, as `dipper phases` finds them in the driven signals.

docs/metrics.md has the rules. Only `dipper phases` knows which phases there are and in what order.
"""
import functools
from graphlib import TopologicalSorter
from itertools import pairwise

import numpy as np

from dipper_run.program import ask


def find_phases(time_s, crowd_m, swing_rad, spans):
    """[{phase: (start, end)}] in s of the passes `spans`, ((start, end), ...); times in order, without gaps.

    A phase that does not occur, or takes no time, is left out.
    """
    signals = (np.ascontiguousarray(x, float).tobytes() for x in (time_s, crowd_m, swing_rad))
    return [dict(found) for found in _asked(*signals, tuple((float(a), float(b)) for a, b in spans))]


def find_terms(time_s, hoist_m, crowd_m, swing_rad, spans):
    """(names, (T, K)) of the terms of the motion that a force may follow from, at each reading; what they are:
    analysis/signals/drive_terms.hpp."""
    signals = (np.ascontiguousarray(x, float).tobytes() for x in (time_s, crowd_m, swing_rad, hoist_m))
    return _asked_terms(*signals, tuple((float(a), float(b)) for a, b in spans))


def in_order(passes):
    """The phases of any of the `passes`, in the order of a whole pass; each pass names its own in order."""
    order = TopologicalSorter()
    for phases in map(list, passes):
        for phase in phases:
            order.add(phase)
        for earlier, later in pairwise(phases):
            order.add(later, earlier)
    return list(order.static_order())


def planned_passes(time_s, door_rad):
    """((start, end), ...) in s of the passes of a motion that end with a dump."""
    answer = ask("phases", "-", given={"time_s": time_s.tolist(), "door_rad": door_rad.tolist()})
    return tuple((p["t_start_s"], p["t_end_s"]) for p in answer["passes"])


def _drive_terms(spans, **signals):
    readings = {name: np.frombuffer(x).tolist() for name, x in signals.items()}
    return ask("phases", "-", given={**readings, "passes": [{"t_start_s": a, "t_end_s": b} for a, b in spans]})


@functools.lru_cache(maxsize=64)
def _asked_terms(time_s, crowd_m, swing_rad, hoist_m, spans):
    answer = _drive_terms(spans, time_s=time_s, crowd_m=crowd_m, swing_rad=swing_rad, hoist_m=hoist_m)
    return tuple(answer["terms"]), np.array(answer["values"], float)


@functools.lru_cache(maxsize=64)  # many runs of a case have the same motion
def _asked(time_s, crowd_m, swing_rad, spans):
    answer = _drive_terms(spans, time_s=time_s, crowd_m=crowd_m, swing_rad=swing_rad)
    return [tuple((phase["phase"], (phase["t_start_s"], phase["t_end_s"])) for phase in p["phases"])
            for p in answer["passes"]]
