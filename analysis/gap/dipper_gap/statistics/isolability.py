"""Which effects these data can tell apart, before looking at what was measured.

In the space where the errors are white - instruments, seeds, nuisances as large as their priors allow, and
what is not known of the signatures themselves - an effect of strength a is a vector. d is its length; d'_ij
what is left of effect i after the best-fitting strength of effect j, within its bounds, is taken away.
"""
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

CONFUSABLE = 3.3   # d' below which two effects form one class: a 5 % chance of the wrong one at best
DETECTION_D = 7.0  # d from which an effect is found, about (docs/gap_evidence.md)


@dataclass(frozen=True)
class Isolability:
    names: list
    strengths: np.ndarray  # (K,) at which the table holds
    d: np.ndarray          # (K,)
    d_prime: np.ndarray    # (K, K); row i: effect i at its strength against any strength of effect j
    limits: np.ndarray     # (K,) strength at which d = DETECTION_D

    def classmates(self, name):
        """Effects that could be taken for `name` at its strength, itself first."""
        i = self.names.index(name)
        return [name] + [n for j, n in enumerate(self.names) if j != i and self.d_prime[i, j] < CONFUSABLE]


def with_nuisances(covariance, nuisances):
    """Prediction covariance that also holds the nuisances, each as large as its prior lets it be."""
    out = covariance.copy()
    for s in nuisances:
        out += s.effect.scale**2 * (np.outer(s.g, s.g) + s.spread)
    return out


def isolability(signatures, covariance, strengths=None, only=None):
    """The table for effects at `strengths` (default: their reference), or the row of one effect `only`.

    `covariance` holds the nuisances.
    """
    names = [s.name for s in signatures]
    at = np.array([s.effect.reference() for s in signatures] if strengths is None else strengths, float)
    d = np.array([_length(s, a, covariance) for s, a in zip(signatures, at)])
    limits = np.array([_limit(s, covariance) for s in signatures])
    table = np.zeros((len(at), len(at)))
    for i, first in enumerate(signatures):
        own = covariance + at[i] ** 2 * first.spread
        plain = np.linalg.inv(own) if only in (None, first.name) else None
        for j, second in enumerate(signatures):
            if i != j and only in (None, first.name):
                table[i, j] = _apart(at[i] * first.g, own, plain, second)
    return Isolability(names, at, d, table, limits)


def _length(signature, strength, covariance):
    vector = strength * signature.g
    return float(np.sqrt(vector @ np.linalg.solve(covariance + strength**2 * signature.spread, vector)))


def _limit(signature, covariance):
    """Strength at which d = DETECTION_D; inf if it never is within the effect's bounds.

    The signature's own uncertainty grows with the strength, so d levels off: too few signature runs can
    leave an effect undetectable at any strength.
    """
    e = signature.effect
    top = e.high if e.high > 0 else e.low
    if _length(signature, top, covariance) < DETECTION_D:
        return np.inf
    return abs(brentq(lambda s: _length(signature, s, covariance) - DETECTION_D, 0.0, top, rtol=1e-3))


def _apart(vector, covariance, inverse, other):
    """Length of what is left of `vector` after the best allowed strength of `other`; `inverse` of the covariance."""
    strength = 0.0
    for _ in range(2):  # the second signature's own uncertainty grows with its strength
        if strength != 0:
            inverse = np.linalg.inv(covariance + strength**2 * other.spread)
        strength = float(other.g @ inverse @ vector / max(other.g @ inverse @ other.g, 1e-300))
        strength = min(max(strength, other.effect.low), other.effect.high)
    left = vector - strength * other.g
    return float(np.sqrt(left @ inverse @ left))
