"""Is there a disagreement at all, and if so, in which pass, phase and channel?"""
from dataclasses import dataclass

import numpy as np
from scipy.stats import t as student

from .null import statistics

TAIL_QUANTILE = 0.98
DOF = (np.inf, 12.0, 6.0, 4.0, 3.0, 2.5)


@dataclass(frozen=True)
class Disagreement:
    omnibus_p: float
    z: np.ndarray           # (n,)
    p_adjusted: np.ndarray  # (n,), family-wise over all cells


def surprise(z, null_z):
    """-log p of each cell by Student's t as heavy as the cell's own null, for `z` and for the null's draws.

    A force in the dig has tails that one on the return does not: by |z| alone the first would hide the second.
    Whether t fits is of no matter to the family-wise rate, as the null is judged by the same measure.
    """
    size, null = np.abs(z), np.abs(null_z)
    scale = np.maximum(np.median(null, axis=0), 1e-300)
    reach = np.quantile(null, TAIL_QUANTILE, axis=0) / scale
    known = np.array([student.isf((1 - TAIL_QUANTILE) / 2, d) / student.isf(0.25, d) for d in DOF])
    dof = np.array(DOF)[np.abs(reach[:, None] - known).argmin(axis=1)]
    unit = scale / student.isf(0.25, dof)
    return -student.logsf(size / unit, dof), -student.logsf(null / unit, dof)


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
    return Disagreement(float(null.omnibus_p(stats)), z, step_down(*surprise(z, null.z)))
