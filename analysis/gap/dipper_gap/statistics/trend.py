"""When did it begin? A step or a ramp in the trucks' strengths, in the order in which they were loaded.

Each truck's residual is projected on the direction of what was found (best linear unbiased estimate of its strength).
Of K trucks in order the strengths are

    a_k = level + size f_k(c) + e_k,    f_k a step after truck c, or a ramp from 0 at truck c to 1 at the last one

with e_k independent from truck to truck, and a shift that all trucks since the reference share (the instruments'
drift). Level and size have flat priors, so the posterior over c is exact (Gaussian, K - 1 steps and K - 2 ramps equally
likely beforehand).
"""
from dataclasses import dataclass

import numpy as np

LEAST_TRUCKS = 4  # of both periods: with fewer nothing can be said of when
INTERVAL = 0.90
SURELY = 0.90     # probability from which the one or the other shape is named


@dataclass(frozen=True)
class Trend:
    began: int            # the change is most likely after so many trucks
    interval90: tuple     # of trucks before it: (fewest, most)
    shape: str            # step | ramp | unclear
    size: float           # of a step at `began`, or of a ramp over all trucks since
    size_sd: float


def weights(directions, covariance):
    """(n,) of the best linear unbiased estimate of the first of `directions` (n, m), the others free."""
    solved = np.linalg.solve(covariance, directions)
    return np.linalg.solve(directions.T @ solved, solved.T)[0]


def find_trend(strength, before, variance, drift):
    """When the strengths (K,) of trucks change, the first `before` of them a reference's; None with too few trucks.

    `variance` (K,) of each truck's strength, `drift` that of what all since the reference share. Where the strengths
    lie farther from the best shape than that, it is scaled up.
    """
    count = len(strength)
    if count < LEAST_TRUCKS:
        return None
    since = (np.arange(count) >= before).astype(float)
    covariance = np.diag(variance) + drift * np.outer(since, since)
    shapes = _shapes(count)
    chi2 = min(_fit(strength, np.linalg.inv(covariance), f)[0] for _, _, f in shapes)
    inverse = np.linalg.inv(covariance * max(1.0, chi2 / (count - 3)))
    fits = [_fit(strength, inverse, f) for _, _, f in shapes]
    # Flat priors of level and size: their integrals leave the sd of the size, and what all shapes have in common.
    log = np.array([-0.5 * left + np.log(sd) for left, _, sd in fits])
    steps = np.array([kind == "step" for kind, _, _ in shapes])
    log -= np.where(steps, np.log(steps.sum()), np.log((~steps).sum()))
    p = np.exp(log - log.max())
    p /= p.sum()
    step = float(p[steps].sum())
    shape = "step" if step >= SURELY else "ramp" if step <= 1 - SURELY else "unclear"
    began = np.bincount([c for _, c, _ in shapes], p)
    allowed = steps == (shape != "ramp")
    best = int(np.argmax(np.where(allowed, p, -1.0)))
    return Trend(shapes[best][1], _interval(began, shapes[best][1]), shape, *fits[best][1:])


def _shapes(count):
    """[(step | ramp, c, (K,))]"""
    order = np.arange(1, count + 1)
    steps = [("step", c, (order > c).astype(float)) for c in range(1, count)]
    ramps = [("ramp", c, np.clip((order - c) / (count - c), 0.0, 1.0)) for c in range(1, count - 1)]
    return steps + ramps


def _fit(y, inverse, shape):
    """What a level and a shape leave, as chi2; the shape's size and its sd."""
    x = np.column_stack([np.ones(len(y)), shape])
    covariance = np.linalg.inv(x.T @ inverse @ x)
    best = covariance @ x.T @ inverse @ y
    left = y - x @ best
    return float(left @ inverse @ left), float(best[1]), float(np.sqrt(covariance[1, 1]))


def _interval(p, best):
    """The shortest run of neighbours about `best` that holds the interval's probability."""
    low = high = best
    while p[low:high + 1].sum() < INTERVAL and (low > 1 or high < len(p) - 1):
        left, right = p[low - 1] if low > 1 else -1.0, p[high + 1] if high < len(p) - 1 else -1.0
        low, high = (low - 1, high) if left >= right else (low, high + 1)
    return low, high
