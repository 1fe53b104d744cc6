"""Is there a disagreement at all, and if so, in which pass, phase and channel?"""
from dataclasses import dataclass

import numpy as np

from .null import statistics


@dataclass(frozen=True)
class Disagreement:
    omnibus_p: float
    z: np.ndarray           # (n,)
    p_adjusted: np.ndarray  # (n,), family-wise over all cells


def step_down(z, null_z):
    """p of each cell by the step-down max-T of Westfall and Young (1993), family-wise.

    The largest |z| is compared with the null's largest; the next with the null's largest of what is left.
    """
    size = np.abs(z)
    order = np.argsort(-size)
    null = np.abs(null_z)[:, order]
    left = np.maximum.accumulate(null[:, ::-1], axis=1)[:, ::-1]
    p = (1 + (left >= size[order]).sum(axis=0)) / (1.0 + len(null))
    out = np.empty_like(p)
    out[order] = np.maximum.accumulate(p)
    return out


def localise(residual, baseline, null, directions=None):
    """Omnibus test and cells of a residual y - mean."""
    stats = statistics(residual, baseline.prediction, baseline.grid, directions)
    z = residual / baseline.sd
    return Disagreement(float(null.omnibus_p(stats)), z, step_down(z, null.z))
