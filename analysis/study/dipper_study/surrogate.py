"""A figure as a function of the parameters, from noisy runs: a Gaussian process whose noise is known from the seeds."""
import warnings

import numpy as np
from scipy.stats import norm
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import ConstantKernel, Matern

RESTARTS = 4
# In widths of the ranges: shorter ones would follow the noise, of longer ones a line is left.
LENGTHS = (0.2, 5.0)


class Surrogate:
    """x: (n, d) in the unit cube; y: (n,) means over seeds; variance: of one such mean."""

    def __init__(self, x, y, variance):
        self._mean = float(np.mean(y))
        self._scale = float(np.std(y)) if np.ptp(y) > 0 else 1.0  # equal values can have a std of rounding errors
        kernel = ConstantKernel(1.0, (0.05, 20.0)) * Matern([1.0] * x.shape[1], [LENGTHS] * x.shape[1], nu=2.5)
        noise = max(variance / self._scale**2, 1e-8)
        self._process = GaussianProcessRegressor(kernel, alpha=noise, n_restarts_optimizer=RESTARTS, random_state=0)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)  # a length at its bound says that nothing varies there
            self._process.fit(x, (np.asarray(y) - self._mean) / self._scale)

    def __call__(self, x):
        """Mean and standard deviation of the function itself, without a run's noise."""
        mean, sd = self._process.predict(np.atleast_2d(x), return_std=True)
        return self._mean + self._scale * mean, self._scale * sd


def pooled_variance(groups):
    """Variance of one run about its point, from points with several seeds; paired seeds leave out what all share.

    groups: (points, seeds) values. Each seed's mean over the points is taken off, as it moves no optimum.
    """
    rest = groups - groups.mean(axis=1, keepdims=True) - groups.mean(axis=0, keepdims=True) + groups.mean()
    free = (groups.shape[0] - 1) * (groups.shape[1] - 1)
    return float((rest**2).sum() / free)


def expected_improvement(mean, sd, best):
    """How much more than `best` is to be expected, of a figure to be made large."""
    sd = np.maximum(sd, 1e-12)
    z = (mean - best) / sd
    return (mean - best) * norm.cdf(z) + sd * norm.pdf(z)


def probability_inside(mean, sd):
    """That a margin with this mean and standard deviation is positive."""
    return norm.cdf(mean / np.maximum(sd, 1e-12))
