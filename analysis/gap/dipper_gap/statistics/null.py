"""What the test statistics look like when nothing is missing: the whole procedure on simulated data.

Each draw makes R baseline runs and one more a truck as the mine would see it, from the baseline's own covariance
and as heavy-tailed as its runs are, then estimates everything from those R runs anew. So the null knows
how little R runs tell.
"""
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular

from ..readings.features import number
from .baseline import seed_covariance, to_grid
from .reference import with_scatter

DRAWS = 1000
# Degrees of freedom of Student's t that runs, or a phase of a pass, may have instead of a Gaussian: a rock
# caught under the lip gives a force no other seed has.
DOF = (np.inf, 12.0, 6.0, 4.0, 3.0)
TAIL_DRAWS = 60
CLEARLY = 4.0    # squared sd by which heavier tails must look more like the runs
FACTORS = (1.0, 1.5, 2.2, 3.3, 5.0, 7.5)  # tried on the seeds' covariance


@dataclass(frozen=True)
class Tails:
    """Degrees of freedom of a run's scale as a whole, and of each phase of each pass by itself."""

    whole: float = np.inf
    block: float = np.inf


@dataclass(frozen=True)
class Null:
    stats: np.ndarray   # (draws, statistics)
    z: np.ndarray       # (draws, n)
    # (draws, FACTORS, K): squared scores of the catalogue's effects, the seeds' covariance times each factor; the
    # largest at 1 is the last statistic
    fits: np.ndarray = None

    def plain(self):
        """The same without that statistic."""
        return Null(self.stats[:, :-1], self.z) if self.fits is not None else self

    def inflation(self, effects):
        """Factor on the seeds' covariance with which a fit along the first so many directions, the catalogue's
        effects, varies as promised.

        Whitening by a covariance known from a few runs promises too much; a squared score should be 1.
        """
        if self.fits is None or not effects:
            return 1.0
        size = self.fits[:, :, :effects].mean(axis=(0, 2))  # falls as the factor grows
        return float(np.exp(np.interp(0.0, -np.log(size), np.log(FACTORS))))

    def single_p(self, stats):
        """p of each statistic by itself, one-sided (large is bad)."""
        return (1 + (self.stats >= stats).sum(axis=0)) / (1.0 + len(self.stats))

    def omnibus_p(self, stats):
        """One p for all statistics: the smallest single p, against its own null (min-P)."""
        n = len(self.stats)
        ranks = n - np.argsort(np.argsort(self.stats, axis=0), axis=0)  # 1: the largest
        smallest = ranks.min(axis=1) / n  # each draw among all
        return (1 + (smallest <= self.single_p(stats).min()).sum()) / (1.0 + n)


def scores(residual, covariance, directions):
    """(K,) squared strength, in its own sd, at which each of `directions` (n, K) fits by itself."""
    weighted = np.linalg.solve(covariance, directions)
    return (weighted.T @ residual) ** 2 / np.maximum((weighted * directions).sum(axis=0), 1e-300)


def statistics(residual, covariance, grid, directions=None):
    """What the omnibus test looks at; each grows with disagreement.

    T2 over all cells; T2 of the mean over passes (an effect that is always there); the largest |z|; and,
    with `directions` (n, K), the largest squared score of an effect of the catalogue.
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
        out.append(scores(residual, covariance, directions).max())
    return np.array(out)


def _averaging(grid):
    """(F, n) matrix that takes each feature's mean over the passes that have it."""
    has = (grid[:, :, None] == np.arange(grid.max() + 1)).any(axis=0)
    return has / has.sum(axis=1, keepdims=True)


def root(covariance):
    """A factor L with L L' = covariance, which may be singular."""
    values, vectors = np.linalg.eigh(covariance)
    return vectors * np.sqrt(np.maximum(values, 0.0))


def make_runs(covariance_root, count, tails, labels, rng):
    """Runs (count, n) of this covariance; `labels` (n,) number the phases of the passes from 0."""
    rows = rng.standard_normal((count, len(covariance_root))) @ covariance_root.T
    if np.isfinite(tails.whole):
        rows *= _scale(tails.whole, (count, 1), rng)
    if np.isfinite(tails.block):
        rows *= _scale(tails.block, (count, labels.max() + 1), rng)[:, labels]
    return rows


def besides(reference, count, rng):
    """(count, n) what runs of the mine scatter by along the reference's directions."""
    beyond = reference.beyond
    return rng.standard_normal((count, beyond.shape[1])) @ beyond.T


def _scale(dof, shape, rng):
    return np.sqrt((dof - 2) / rng.chisquare(dof, shape))


def phase_labels(cells):
    return number([(c.pass_number, c.phase) for c in cells])


def _shapes(values, grid):
    """(B, 2): what tells the tails of B sets of R runs, (B, R, n), of any covariance: the log of a feature's kurtosis
    over runs and passes, mean over features; the sd over runs of the log of a run's mean square deviation."""
    deviation = values - values.mean(axis=1, keepdims=True)
    square = deviation**2
    x = to_grid(square, grid)
    second, fourth = np.nanmean(x, axis=(1, 2)), np.nanmean(x**2, axis=(1, 2))
    moves = second > 1e-12 * second.max(axis=1, keepdims=True)
    kurtosis = np.where(moves, fourth / np.where(moves, second, 1.0) ** 2, 0.0).sum(axis=1) / moves.sum(axis=1)
    own = square.mean(axis=1, keepdims=True)
    size = (square / np.where(own > 0, own, 1.0)).sum(axis=2) / (own > 0).sum(axis=2)
    return np.column_stack([np.log(kurtosis), np.log(size).std(axis=1)])


def find_tails(baseline, seed=0):
    """The tails whose runs look most like the baseline's; a Gaussian unless others are clearly more like them."""
    rng = np.random.default_rng(seed)
    seed_root, seen = root(baseline.seed), _shapes(baseline.values[None], baseline.grid)[0]
    labels = phase_labels(baseline.cells)
    best, least = Tails(), np.inf
    for whole in DOF:
        for block in DOF:
            tails = Tails(whole, block)
            rows = make_runs(seed_root, TAIL_DRAWS * baseline.seeds, tails, labels, rng)
            made = _shapes(rows.reshape(TAIL_DRAWS, baseline.seeds, -1), baseline.grid)
            off = (((seen - np.median(made, axis=0)) / made.std(axis=0)) ** 2).sum()
            off += CLEARLY * (np.isfinite(whole) + np.isfinite(block))
            if off < least:
                best, least = tails, off
    return best


def simulate_null(baseline, directions=None, draws=DRAWS, seed=0, passes=None, tails=None):
    """Null of the statistics over `passes` (default: all); the seeds' covariance is estimated from all of them.

    `tails` are find_tails(baseline), when at hand.
    """
    part, at = baseline.part(passes) if passes else (baseline, list(range(len(baseline.mean))))
    block = np.ix_(at, at)
    rng = np.random.default_rng(seed)
    runs, trucks, more, reference = baseline.seeds, baseline.trucks, len(baseline.more), baseline.reference
    seed_root, own_root, size = root(baseline.seed), root(baseline.own), np.sqrt(baseline.scatter)
    tails, labels = tails or find_tails(baseline), phase_labels(baseline.cells)
    before = reference.trucks if reference else 0
    before_root = root(reference.own) if reference else None
    errors = reference.drift if reference else baseline.common
    stats, fits, z = [], [], np.empty((draws, len(at)))
    asked = directions is not None and directions.size > 0
    for d in range(draws):
        made = make_runs(seed_root, runs + trucks + before + more, tails, labels, rng)
        mine = size * made[runs:runs + trucks] + rng.standard_normal((trucks, len(own_root))) @ own_root.T
        shared = rng.standard_normal(len(errors)) @ errors
        then, usual = None, made[:runs].mean(axis=0)
        if reference:
            then = (size * made[runs + trucks:runs + trucks + before]
                    + rng.standard_normal((before, len(own_root))) @ before_root.T)
            mine, then = (x + besides(reference, len(x), rng) for x in (mine, then))
            usual, then = then.mean(axis=0), then[:, at]
        residual = (mine.mean(axis=0) + shared - usual)[at]
        one = seed_covariance(made[:runs], baseline.grid, made[runs + trucks + before:])[block]
        seeds = with_scatter(part.told_by(made[:runs, at], one), mine[:, at], then).chance
        covariance = part.noise + seeds
        stats.append(statistics(residual, covariance, part.grid))
        if asked:
            fits.append([scores(residual, covariance + (f - 1) * seeds, directions) for f in FACTORS])
        z[d] = residual / np.sqrt(np.diag(covariance))
    if not asked:
        return Null(np.array(stats), z)
    fits = np.array(fits)
    return Null(np.column_stack([stats, fits[:, 0].max(axis=1)]), z, fits)


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
        covariance = baseline.noise + seed_covariance(others, baseline.grid, baseline.more) * (1 + 1 / len(others))
        noise = rng.standard_normal((copies, len(baseline.mean))) @ noise_root.T
        residual = baseline.values[k] - others.mean(axis=0) + noise
        seen += list((residual * np.linalg.solve(covariance, residual.T).T).sum(axis=1))
    return max(1.0, float(np.median(seen) / np.median(null.stats[:, 0])))
