"""What the mine's instruments do to the features: spread, shared error, and the lift of a noisy peak."""
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from .features import TIME, FeatureMap, number
from .channels import FACE, MASS, MOTION
from .phases import find_phases

REPLICAS = 64
MOVED_S = 0.07  # by which an end of a phase is moved to see what that does to the features


@dataclass(frozen=True)
class NoisyFeatures:
    """Features as the mine would see them: `mean` over many noisy copies, `own` the copies less it."""

    cells: list
    mean: np.ndarray      # (n,)
    own: np.ndarray       # (B, n)
    durations: list


def noisy_features(measured, channels, pass_numbers, replicas=REPLICAS):
    """Features of a noise-free folder under the noise of `channels`.

    The same draws are used for every folder, so that differences between folders are not blurred by them.
    """
    fmap = FeatureMap(measured, pass_numbers)
    rng = np.random.default_rng(0)
    clean = {n: measured.signals[n] for n in fmap.responses}
    masses = fmap.masses()
    copies = {n: v + channels[n].sigma * rng.standard_normal((replicas, len(v))) for n, v in clean.items()}
    faces = {at: (x, z + channels[FACE].sigma * rng.standard_normal((replicas, len(z))))
             for at, (x, z) in fmap.faces.items()}
    # A force's work is over the measured way: a drive's own error is in it too.
    driven = {n: v + channels[n].sigma * rng.standard_normal((replicas, len(v)))
              for n, v in measured.signals.items() if n in MOTION}
    rows = fmap(copies, np.tile(masses, (replicas, 1)), faces, driven)
    if fmap.phases:
        rows = rows + _moved_ends(fmap, driven)
    mean = rows.mean(axis=0)
    return NoisyFeatures(fmap.cells, mean, rows - mean, fmap.durations)


def _moved_ends(fmap, driven):
    """(B, n) what the features change by as the drives' noise moves the ends of phases, to first order."""
    m, passes = fmap.measured, fmap.passes
    copies = len(driven["crowd_m"])
    length = m.time_s[-1] - m.time_s[0] + np.median(np.diff(m.time_s))
    starts = length * np.arange(copies)
    found = find_phases(np.concatenate([m.time_s + s for s in starts]), driven["crowd_m"].ravel(),
                        driven["swing_rad"].ravel(),
                        [(p.t_start_s + s, p.t_end_s + s) for s in starts for p in passes])
    index = {p.number: i for i, p in enumerate(passes)}
    names = [list(phases) for phases in fmap.phases]
    nowhere = (np.nan, np.nan)
    off = [{phase: np.array([copy.get(phase, nowhere)[1] for copy in found[i::len(passes)]]) - starts - end
            for phase, (_, end) in phases.items()} for i, phases in enumerate(fmap.phases)]
    out = np.zeros((copies, len(fmap.cells)))
    for first in (0, 1):  # every second end at once: no phase then has both of its ends moved
        less, more = (FeatureMap(m, list(index), [_with_ends(p, first, by) for p in fmap.phases]).own
                      for by in (-MOVED_S, MOVED_S))
        for k, c in enumerate(fmap.cells):
            i = index[c.pass_number]
            if c.phase not in names[i] or c.channel == TIME or not (c in less and c in more):
                continue
            at = names[i].index(c.phase)
            moved = at - (at - first) % 2  # its own end, or its start: the end of the one before
            if moved >= 0:
                out[:, k] += np.nan_to_num(off[i][names[i][moved]]) * (more[c] - less[c]) / (2 * MOVED_S)
    return out


def _with_ends(phases, first, by):
    """The phases of a pass with every second end moved, from the `first` on, where both phases are long enough."""
    out = dict(phases)
    for a, b in list(pairwise(phases))[first::2]:
        (start, end), (begins, stop) = phases[a], phases[b]
        if min(end - start, stop - begins) > 2 * abs(by):
            out[a], out[b] = (start, end + by), (begins + by, stop)
    return out


def common_errors(folders, channels, pass_numbers):
    """(channels, n): how one common_sigma of each response, then of the scale, then of a survey's heights, shifts the
    features, on the mean over noise-free `folders` of the same case.
    """
    shifts = []
    for measured in folders:
        fmap = FeatureMap(measured, pass_numbers)
        clean = {n: measured.signals[n][None] for n in fmap.responses}
        masses = fmap.masses()[None]
        moved = [({**clean, n: v + channels[n].common_sigma}, masses) for n, v in clean.items()]
        if MASS in measured.channels:
            moved.append((clean, masses + channels[MASS].common_sigma))
        if FACE in measured.channels:
            moved.append((clean, masses, {at: (x, z + channels[FACE].common_sigma)
                                          for at, (x, z) in fmap.faces.items()}))
        zero = np.array(list(fmap.own.values()))
        shifts.append([fmap(*m)[0] - zero for m in moved])
    return np.mean(shifts, axis=0)


def measured_features(measured, pass_numbers):
    """Features of the mine's own folder, as they are."""
    fmap = FeatureMap(measured, pass_numbers)
    return fmap.cells, np.array(list(fmap.own.values())), fmap.durations


def noise_covariance(runs, channels):
    """Covariance (n, n) of the instruments' own errors in one truck's features, learnt from `runs` of the same
    case.

    Own errors of different passes, phases and channels are independent: those entries are exactly 0.
    """
    cells = runs[0].cells
    own = np.concatenate([r.own for r in runs])
    cov = own.T @ own / (len(own) - len(runs))
    block = number([(c.pass_number, c.phase, c.channel) for c in cells])
    cov *= block[:, None] == block
    for i, c in enumerate(cells):
        if c.channel == MASS:
            cov[i, i] += channels[MASS].sigma ** 2
    return cov
