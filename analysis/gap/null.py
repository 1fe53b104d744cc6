"""What the test statistics look like when nothing is missing: the whole procedure on simulated data.

Each draw makes R baseline runs and one more as the mine would see it, from the baseline's own covariance
and as heavy-tailed as its runs are, then estimates everything from those R runs anew. So the null knows
how little R runs tell.
"""
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from .baseline import seed_covariance, to_grid

DRAWS = 600
# Degrees of freedom of Student's t that runs may have instead of a Gaussian: a rock caught under the lip
# gives a force no other seed has.
TAILS = (np.inf, 12.0, 6.0, 4.0, 3.0)
TAIL_DRAWS = 60


@dataclass(frozen=True)
class Null:
    stats: np.ndarray   # (draws, statistics)
    z: np.ndarray       # (draws, n)
    directions: int = 0  # of the catalogue, when the last statistic is T2 within their space

    def plain(self):
        """The same without that statistic."""
        return Null(self.stats[:, :-1], self.z) if self.directions else self

    def inflation(self):
        """Variance of a fit along the catalogue's directions, in what the estimated covariance promises.

        Whitening by a covariance known from a few runs promises too much; T2 in K directions would be K.
        """
        return max(1.0, float(self.stats[:, -1].mean()) / self.directions) if self.directions else 1.0

    def single_p(self, stats):
        """p of each statistic by itself, one-sided (large is bad)."""
        return (1 + (self.stats >= stats).sum(axis=0)) / (1.0 + len(self.stats))

    def omnibus_p(self, stats):
        """One p for all statistics: the smallest single p, against its own null (min-P)."""
        n = len(self.stats)
        ranks = n - np.argsort(np.argsort(self.stats, axis=0), axis=0)  # 1: the largest
        smallest = ranks.min(axis=1) / n  # each draw among all
        return (1 + (smallest <= self.single_p(stats).min()).sum()) / (1.0 + n)


def statistics(residual, covariance, grid, directions=None):
    """What the omnibus test looks at; each grows with disagreement.

    T2 over all cells; T2 of the mean over passes (an effect that is always there); the largest |z|; and,
    with `directions` (n, K), T2 within the space the catalogue can reach.
    """
    sd = np.sqrt(np.diag(covariance))
    factor = np.linalg.cholesky(covariance)
    white = solve_triangular(factor, residual, lower=True, check_finite=False)
    out = [white @ white]
    if len(grid) > 1:
        average = _averaging(grid)
        mean = average @ residual
        out.append(mean @ np.linalg.solve(average @ covariance @ average.T, mean))
    out.append(np.abs(residual / sd).max())
    if directions is not None and directions.size:
        basis = np.linalg.qr(solve_triangular(factor, directions, lower=True, check_finite=False))[0]
        part = basis.T @ white
        out.append(part @ part)
    return np.array(out)


def _averaging(grid):
    """(F, n) matrix that takes each feature's mean over the passes that have it."""
    n = grid.max() + 1
    out = np.zeros((grid.shape[1], n))
    for j in range(grid.shape[1]):
        at = grid[:, j][grid[:, j] >= 0]
        out[j, at] = 1.0 / len(at)
    return out


def root(covariance):
    """A factor L with L L' = covariance, which may be singular."""
    values, vectors = np.linalg.eigh(covariance)
    return vectors * np.sqrt(np.maximum(values, 0.0))


def make_runs(covariance_root, count, dof, rng):
    """Runs (count, n) of this covariance; with dof, each is as a whole larger or smaller (Student's t)."""
    rows = rng.standard_normal((count, len(covariance_root))) @ covariance_root.T
    if np.isfinite(dof):
        rows *= np.sqrt((dof - 2) / rng.chisquare(dof, (count, 1)))
    return rows


def _kurtosis(values, grid):
    """Of a feature over runs and passes, mean over features."""
    x = to_grid(values - values.mean(axis=0), grid)
    second, fourth = np.nanmean(x**2, axis=(0, 1)), np.nanmean(x**4, axis=(0, 1))
    moves = second > 1e-12 * second.max()
    return float(np.mean(fourth[moves] / second[moves] ** 2))


def tail_dof(baseline, seed=0):
    """The dof whose runs have the kurtosis of the baseline's: inf for a Gaussian."""
    rng = np.random.default_rng(seed)
    seed_root, seen = root(baseline.seed), np.log(_kurtosis(baseline.values, baseline.grid))
    typical = [np.median([np.log(_kurtosis(make_runs(seed_root, baseline.seeds, dof, rng), baseline.grid))
                          for _ in range(TAIL_DRAWS)]) for dof in TAILS]
    return TAILS[int(np.argmin(np.abs(np.array(typical) - seen)))]


def simulate_null(baseline, directions=None, draws=DRAWS, seed=0, passes=None):
    """Null of the statistics over `passes` (default: all); covariances are estimated from all of them."""
    part, at = baseline.part(passes) if passes else (baseline, list(range(len(baseline.mean))))
    block = np.ix_(at, at)
    rng = np.random.default_rng(seed)
    n, runs = len(baseline.mean), baseline.seeds
    seed_root, noise_root, dof = root(baseline.seed), root(baseline.noise), tail_dof(baseline)
    stats, z = [], np.empty((draws, len(at)))
    for d in range(draws):
        made = make_runs(seed_root, runs + 1, dof, rng)
        covariance = baseline.noise + seed_covariance(made[:-1], baseline.grid) * (1 + 1 / runs)
        residual = made[-1] + noise_root @ rng.standard_normal(n) - made[:-1].mean(axis=0)
        residual, covariance = residual[at], covariance[block]
        stats.append(statistics(residual, covariance, part.grid, directions))
        z[d] = residual / np.sqrt(np.diag(covariance))
    count = 0 if directions is None else int(np.linalg.matrix_rank(directions))
    return Null(np.array(stats), z, count)


def left_out_inflation(baseline, null, seed=1, copies=20):
    """How much larger T2 is when a real seed is left out and predicted, than the null says: 1 or more.

    Real seeds need not be Gaussian; the null assumes so. Each seed is predicted from the others, under
    `copies` draws of the instruments' noise; the ratio of medians is what the seeds' covariance lacks.
    """
    rng = np.random.default_rng(seed)
    noise_root = root(baseline.noise)
    seen = []
    for k in range(baseline.seeds):
        others = np.delete(baseline.values, k, axis=0)
        covariance = baseline.noise + seed_covariance(others, baseline.grid) * (1 + 1 / len(others))
        noise = rng.standard_normal((copies, len(baseline.mean))) @ noise_root.T
        residual = baseline.values[k] - others.mean(axis=0) + noise
        seen += list((residual * np.linalg.solve(covariance, residual.T).T).sum(axis=1))
    return max(1.0, float(np.median(seen) / np.median(null.stats[:, 0])))
