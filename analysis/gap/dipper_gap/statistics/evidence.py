"""Gaussian evidence of a set of effects, their strengths within bounds and of one sign.

    residual = sum a_k g_k + e,  e ~ N(0, C + sum a_k^2 V_k),  a_k ~ N(prior) cut to [low, high]

C holds instruments, seeds and nuisances; V_k is the signature's own uncertainty, taken at the best
strengths. What remains is linear and Gaussian, so the integral over the box is exact.
"""
from dataclasses import dataclass

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.optimize import lsq_linear
from scipy.special import log_ndtr
from scipy.stats import multivariate_normal


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
    prior_mean = np.array([s.effect.prior_mean for s in signatures])
    prior_sd = np.array([s.effect.prior_scale for s in signatures])
    # At the unconstrained mode, likelihood x prior x sqrt(2 pi)^m |cov|^1/2; then the share in the box.
    log_e = log_gaussian(residual - g @ mean, factor)
    log_e += -0.5 * (((mean - prior_mean) / prior_sd) ** 2).sum() - np.log(prior_sd).sum()
    log_e += 0.5 * np.linalg.slogdet(cov)[1]
    low, high = _bounds(signatures)
    log_e += _log_box(mean, cov, low, high)
    log_e -= sum(_log_box(prior_mean[k:k + 1], prior_sd[k:k + 1, None] ** 2, low[k:k + 1], high[k:k + 1])
                 for k in range(len(prior_mean)))
    return Fit(tuple(s.name for s in signatures), float(log_e), best, mean, cov, g @ best)


def _bounds(signatures):
    return (np.array([s.effect.low for s in signatures], float),
            np.array([s.effect.high for s in signatures], float))


def _posterior(residual, factor, g, signatures):
    """Mean and covariance without bounds, and the mode within them."""
    precision = np.diag([1 / s.effect.prior_scale**2 for s in signatures])
    weighted = cho_solve(factor, g, check_finite=False)
    a = g.T @ weighted + precision
    b = weighted.T @ residual + precision @ [s.effect.prior_mean for s in signatures]
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
    corr = cov / np.outer(sd, sd)
    share = multivariate_normal.cdf((high - mean) / sd, cov=corr, lower_limit=(low - mean) / sd,
                                    allow_singular=True, abseps=1e-6, releps=1e-4)
    return float(np.log(max(share, 1e-300)))


def sample(f, signatures, count, rng):
    """Strengths (count, m) from the posterior within the bounds, by rejection; falls back to the mode."""
    low, high = _bounds(signatures)
    draws = rng.multivariate_normal(f.mean, f.covariance, size=20 * count, method="eigh")
    kept = draws[((draws >= low) & (draws <= high)).all(axis=1)][:count]
    if len(kept) < 20:
        return np.tile(f.best, (count, 1))
    return kept[rng.integers(len(kept), size=count)]
