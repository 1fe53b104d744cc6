"""Gaussian evidence of a set of effects, their strengths within bounds and of one sign.

    residual = sum a_k g_k + e,  e ~ N(0, C + sum a_k^2 V_k),  a_k ~ N(0, scale^2) cut to [low, high]

C holds instruments, seeds and nuisances; V_k is the signature's own uncertainty, taken at the best
strengths. What remains is linear and Gaussian, so the integral over the box is exact.
"""
import functools
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import lsq_linear
from scipy.special import log_ndtr
from scipy.stats import multivariate_normal

ABSOLUTE, RELATIVE = 1e-6, 1e-4       # error of a share of the box
ORDERS = 16, 32, 64, 128, 256, 512    # of Gauss and Legendre's rule, until the next differs by less
FAR = 8.5                             # sd: beyond is 1e-17
TINY = 1e-12                          # variance of one effect given another, at least
LEAST_SAMPLE = 20                     # of strengths within the bounds: with fewer the mode stands for them

leggauss = functools.lru_cache(maxsize=None)(np.polynomial.legendre.leggauss)


@dataclass(frozen=True)
class Fit:
    names: tuple
    log_evidence: float
    best: np.ndarray         # (m,) most probable strengths within the bounds
    mean: np.ndarray         # (m,) of the Gaussian before the bounds cut it
    covariance: np.ndarray   # (m, m)
    explained: np.ndarray    # (n,) sum a_k g_k at the best strengths


def prepare(covariance):
    return cho_factor(covariance, lower=True, check_finite=False)


def log_gaussian(residual, factor):
    quadratic = residual @ cho_solve(factor, residual, check_finite=False)
    return -0.5 * (quadratic + len(residual) * np.log(2 * np.pi)) - np.log(np.diag(factor[0])).sum()


def fit(residual, covariance, signatures, factor=None):
    """Fit of one set of effects (1 to 3). `factor` is prepare(covariance), when at hand."""
    g = np.array([s.g for s in signatures]).T
    factor = factor or prepare(covariance)
    best = _posterior(residual, factor, g, signatures)[2]
    inflated = covariance + sum(a * a * s.spread for a, s in zip(best, signatures))
    factor = prepare(inflated)
    mean, cov, best = _posterior(residual, factor, g, signatures)
    prior_sd = np.array([s.effect.scale for s in signatures])
    # At the unconstrained mode, likelihood x prior x sqrt(2 pi)^m |cov|^1/2; then the share in the box.
    log_e = log_gaussian(residual - g @ mean, factor)
    log_e += -0.5 * ((mean / prior_sd) ** 2).sum() - np.log(prior_sd).sum()
    log_e += 0.5 * np.linalg.slogdet(cov)[1]
    low, high = _bounds(signatures)
    log_e += _log_box(mean, cov, low, high)
    log_e -= sum(_log_box(np.zeros(1), prior_sd[k:k + 1, None] ** 2, low[k:k + 1], high[k:k + 1])
                 for k in range(len(prior_sd)))
    return Fit(tuple(s.name for s in signatures), float(log_e), best, mean, cov, g @ best)


def _bounds(signatures):
    return (np.array([s.effect.low for s in signatures], float),
            np.array([s.effect.high for s in signatures], float))


def _posterior(residual, factor, g, signatures):
    """Mean and covariance without bounds, and the mode within them."""
    precision = np.diag([1 / s.effect.scale**2 for s in signatures])
    weighted = cho_solve(factor, g, check_finite=False)
    a = g.T @ weighted + precision
    b = weighted.T @ residual
    cov = np.linalg.inv(a)
    mean = cov @ b
    low, high = _bounds(signatures)
    if (mean >= low).all() and (mean <= high).all():
        return mean, cov, mean
    scale = 1 / np.sqrt(np.diag(a))
    upper = np.linalg.cholesky(a * np.outer(scale, scale)).T
    best = lsq_linear(upper, np.linalg.solve(upper.T, b * scale), (low / scale, high / scale), method="bvls").x * scale
    return mean, cov, best


def _log_box(mean, cov, low, high):
    """log of the Gaussian's share within the box."""
    if len(mean) == 1:
        sd = np.sqrt(cov[0, 0])
        u, v = (low[0] - mean[0]) / sd, (high[0] - mean[0]) / sd
        if u > 0:  # the far tail, mirrored: log_ndtr is exact on the left
            u, v = -v, -u
        return float(log_ndtr(v) + np.log1p(-np.exp(min(log_ndtr(u) - log_ndtr(v), -1e-16))))
    sd = np.sqrt(np.diag(cov))
    share = (_share_of_three if len(mean) == 3 else _share_of_two)((low - mean) / sd, (high - mean) / sd,
                                                                   cov / np.outer(sd, sd))
    return float(np.log(max(share, 1e-300)))


def _share_of_two(low, high, corr):
    """Share of a unit Gaussian of two within boxes (..., 2)."""
    low, high = np.clip([low, high], -FAR, FAR)
    return multivariate_normal.cdf(high, cov=corr, lower_limit=low, allow_singular=True)


def _share_of_three(low, high, corr):
    """Likewise of three: over the one that is least like the others, of the exact share of those two given it.

    scipy's own is Monte Carlo in three dimensions, with a state that cannot be set: another answer at each call.
    """
    k = int(np.abs(corr - np.eye(3)).max(axis=0).argmin())
    two = [j for j in range(3) if j != k]
    slope = corr[two, k]
    left = corr[np.ix_(two, two)] - np.outer(slope, slope)
    sd = np.sqrt(np.maximum(np.diag(left), TINY))
    left = np.clip(left / np.outer(sd, sd), -1, 1)
    start, end = np.clip([low[k], high[k]], -FAR, FAR)
    last = np.inf
    for points in ORDERS:
        x, weight = leggauss(points)
        x = (start + end) / 2 + (end - start) / 2 * x
        given = _share_of_two(*((limit[two] - x[:, None] * slope) / sd for limit in (low, high)), left)
        share = (end - start) / 2 * np.sum(weight * np.exp(-x * x / 2) * given) / np.sqrt(2 * np.pi)
        if abs(share - last) < max(ABSOLUTE, RELATIVE * share):
            break
        last = share
    return share


def sample(f, signatures, count, rng):
    """Strengths (count, m) from the posterior within the bounds, by rejection; falls back to the mode."""
    low, high = _bounds(signatures)
    draws = rng.multivariate_normal(f.mean, f.covariance, size=20 * max(count, LEAST_SAMPLE), method="eigh")
    kept = draws[((draws >= low) & (draws <= high)).all(axis=1)]
    if len(kept) < LEAST_SAMPLE:
        return np.tile(f.best, (count, 1))
    return kept[rng.integers(len(kept), size=count)]
