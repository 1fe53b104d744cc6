"""Mean, spread and interval over seeds; two settings compared with paired seeds."""
from dataclasses import dataclass

import numpy as np
from scipy.special import stdtr, stdtrit

LEVEL = 0.9  # of every interval


@dataclass(frozen=True)
class Summary:
    """Of n values: mean, standard deviation, the 90 % interval of the mean (Student's t); nan where n is too small."""

    n: int
    mean: float
    sd: float
    low: float
    high: float


def summary(values):
    x = np.asarray([v for v in values if np.isfinite(v)], float)
    n = len(x)
    if n < 2:
        return Summary(n, float(x[0]) if n else np.nan, np.nan, np.nan, np.nan)
    off = x - x[0]  # equal values then have no spread, not even by rounding
    mean, sd = x[0] + off.mean(), off.std(ddof=1)
    half = stdtrit(n - 1, 0.5 + LEVEL / 2) * sd / np.sqrt(n)
    return Summary(n, float(mean), float(sd), float(mean - half), float(mean + half))


@dataclass(frozen=True)
class Comparison:
    """b less a, over the seeds both have. confidence: that the true difference has this sign."""

    difference: Summary
    confidence: float

    @property
    def shown(self):
        """Whether the 90 % interval leaves out zero."""
        return bool(self.difference.low > 0 or self.difference.high < 0)


def compare(a, b):
    """a and b: {seed: value}."""
    both = sorted(set(a) & set(b))
    d = summary([b[s] - a[s] for s in both])
    if d.n < 2:
        return Comparison(d, np.nan)
    error = d.sd / np.sqrt(d.n)
    # Without any spread the sign is known, and of no difference nothing is.
    confidence = stdtr(d.n - 1, abs(d.mean) / error) if error else 1.0 if d.mean else 0.5
    return Comparison(d, float(confidence))
