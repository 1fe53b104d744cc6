"""The unchanged model, run with several seeds: its mean, its own spread, and the instruments' errors.

Where a mine's earlier trucks are given (reference.py), they stand in the place of the model's mean.
"""
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import chdtri

PRIOR_DOF = 14.0   # how many degrees of freedom the spread pooled over passes counts against a pass's own
SHARED = 2.0       # sd of a channel's shared error, at most, that is taken off a difference of mine and model
COLLINEAR = 0.98   # a feature that follows another this closely says nothing of its own
PREFERRED = ("mass", "balance", "mean", "slope", "peak", "work")


@dataclass(frozen=True)
class Baseline:
    """Vectors over `cells`; y - mean, where y is the mean over T trucks, has covariance noise + seed (f/T + 1/R).

    With a reference of T0 trucks y is less what they differ by from the model: noise + f seed (1/T + 1/T0).
    """

    cells: list
    mean: np.ndarray        # (n,)
    values: np.ndarray      # (R, n)
    own: np.ndarray         # (n, n) of one truck's instruments
    common: np.ndarray      # (channels, n): shifts by one common_sigma, alike in all trucks
    more: np.ndarray        # (M, n) deviations of a run's size, of runs with an effect from what it does
    seed: np.ndarray        # (n, n) of one run
    grid: np.ndarray        # (P, F) index into cells, -1 where there is none
    trucks: int = 1         # T
    scatter: float = 1.0    # f: variance of the mine's own runs, in variances of the model's; with a reference (n,)
    reference: object = None  # Reference
    # (n,) what a force of 1 while a channel's own drive stands still adds to a cell (readings/rest.py)
    rest: np.ndarray = None
    altered: np.ndarray = None  # (n,) by what the runs were corrected (readings/fidelity.py)

    def part(self, pass_numbers):
        """The same over some of the passes, and their indices. Covariances stay as all passes give them."""
        at = [i for i, c in enumerate(self.cells) if c.pass_number in pass_numbers]
        block = np.ix_(at, at)
        cells = [self.cells[i] for i in at]
        part = replace(self, cells=cells, mean=self.mean[at], values=self.values[:, at], own=self.own[block],
                       common=self.common[:, at], more=self.more[:, at], seed=self.seed[block],
                       grid=make_grid(cells, pass_numbers), rest=_at(self.rest, at),
                       altered=_at(self.altered, at))
        if self.reference is not None:
            part = replace(part, reference=self.reference.part(at), scatter=self.scatter[at])
        return part, at

    @property
    def seeds(self):
        return len(self.values)

    @property
    def noise(self):
        """Covariance of the instruments' errors in the mean over the trucks, less those of the reference."""
        before = self.reference
        if before is None:
            return self.own / self.trucks + self.common.T @ self.common
        return self.own / self.trucks + before.own / before.trucks + before.drift.T @ before.drift

    @property
    def level(self):
        """(n,) what the mine's instruments read where nothing is amiss."""
        return self.mean if self.reference is None else self.mean + self.reference.shift

    @property
    def chance(self):
        """Covariance by the seeds of y - mean."""
        if self.reference is None:
            return self.seed * self.share(self.seeds)
        return self.mine * (1.0 / self.trucks + 1.0 / self.reference.trucks)

    @property
    def prediction(self):
        """Covariance of y - mean."""
        return self.noise + self.chance

    def against(self, runs):
        """Covariance of y less the mean of so many runs with an effect."""
        if self.reference is None:
            return self.noise + self.seed * self.share(runs)
        return self.prediction + self.seed * (1.0 / self.seeds + 1.0 / runs)

    def share(self, runs):
        """Variance by the seeds of y less the mean of so many runs, in variances of a run; over the cells' median."""
        f = float(np.median(self.scatter))
        if self.reference is None:
            return f / self.trucks + 1.0 / runs
        return f / self.trucks + f / self.reference.trucks

    @property
    def mine(self):
        """Covariance by the seeds of one of the mine's own runs."""
        size = np.sqrt(self.scatter * np.ones(len(self.mean)))
        out = self.seed * np.outer(size, size)
        return out + self.reference.beyond @ self.reference.beyond.T if self.reference else out

    @property
    def unlike(self):
        """(n,) by which share a mine's earlier trucks differ from the model in the cell's phase and channel, beyond
        what chance does, or corrected runs from what they were; 0 where neither is known."""
        if self.reference is not None:
            chance = np.diag(self.reference.own) + np.diag(self.mine)
            variance = chance / self.reference.trucks + np.diag(self.seed) / self.seeds
            off, usual = self._less_shared(self.reference.shift, variance), 1.0
        elif self.altered is not None:
            variance, off, usual = np.diag(self.seed), self.altered, 0.0
        else:
            return np.zeros(len(self.mean))
        out = np.zeros(len(self.mean))
        for block in dict.fromkeys((c.phase, c.channel) for c in self.cells):
            at = np.array([(c.phase, c.channel) == block for c in self.cells]) & (variance > 0)
            size = (self.mean[at] ** 2 / variance[at]).sum()
            beyond = (off[at] ** 2 / variance[at] - usual).sum()
            out[at] = np.sqrt(max(beyond, 0.0) / size) if size > 0 else 0.0
        return out

    def _less_shared(self, shift, variance):
        """The reference's shift (n,) less what an error that all its readings of a channel share, as large as it may
        be, makes of it."""
        common = self.reference.common
        shared = common.T[variance > 0] / np.sqrt(variance[variance > 0])[:, None]
        white = shift[variance > 0] / np.sqrt(variance[variance > 0])
        sizes = np.linalg.solve(shared.T @ shared + np.eye(len(common)), shared.T @ white)
        return shift - np.clip(sizes, -SHARED, SHARED) @ common

    def with_deviations(self, more):
        """The same with the seeds' covariance known from (M, n) further deviations too."""
        return replace(self, more=more, seed=seed_covariance(self.values, self.grid, more))

    def told_by(self, values, seed):
        """The same with the mean of other runs (R, n), whose covariance is `seed`."""
        return replace(self, mean=values.mean(axis=0), values=values, seed=seed)

    def inflated(self, factor):
        """The same with the seeds' covariance, and what the mine's runs scatter by besides, times `factor`."""
        return replace(self, seed=self.seed * factor, reference=self.reference and self.reference.scattered(factor))

    def scattered(self, factor):
        """The same with the covariance of the mine's own runs times `factor`."""
        return replace(self, scatter=self.scatter * factor, reference=self.reference.scattered(factor))

    @property
    def sd(self):
        return np.sqrt(np.diag(self.prediction))


def _at(values, at):
    return None if values is None else values[at]


def to_grid(values, grid):
    """(..., n) -> (..., P, F), nan where a pass has no such cell."""
    padded = np.concatenate([values, np.full(values.shape[:-1] + (1,), np.nan)], axis=-1)
    return padded[..., grid]


def seed_covariance(values, grid, more):
    """Covariance over cells of one run, from R runs, (R, n), and `more` deviations of a run's size, (M, n).

    Few runs, many cells: the covariance is taken as (between passes) x (between features), each shrunk
    after Ledoit and Wolf (2004), about variances of each pass shrunk to those pooled over passes
    (Smyth 2004). Pooling the passes gives (R + M) x P samples for the features' correlations; the variances
    are those of the R runs.
    """
    runs = len(values)
    deviation = to_grid(values - values.mean(axis=0), grid) * np.sqrt(runs / (runs - 1.0))
    own = (deviation**2).mean(axis=0)  # nan where a pass has no such cell: the same in every run
    pooled = np.nanmean(own, axis=0)
    sd = np.sqrt((PRIOR_DOF * pooled + (runs - 1.0) * own) / (PRIOR_DOF + runs - 1.0))
    deviation = np.concatenate([deviation, to_grid(more, grid)])
    unit = np.where(np.isfinite(deviation) & (sd > 0), deviation / np.where(sd > 0, sd, 1.0), 0.0)
    n_passes, n_keys = grid.shape
    between_keys = _correlation(ledoit_wolf(unit.reshape(-1, n_keys)))
    if n_passes > 1:
        values_, vectors = np.linalg.eigh(between_keys)
        root = vectors / np.sqrt(np.maximum(values_, 1e-9))
        white = unit @ root
        between_passes = _correlation(ledoit_wolf(white.transpose(0, 2, 1).reshape(-1, n_passes)))
    else:
        between_passes = np.ones((1, 1))
    in_order = np.argsort(grid, axis=None)[(grid < 0).sum():]
    passes, keys = np.unravel_index(in_order, grid.shape)  # of each cell
    scale = sd[passes, keys]
    return between_passes[np.ix_(passes, passes)] * between_keys[np.ix_(keys, keys)] * np.outer(scale, scale)


def ledoit_wolf(x):
    """(p, p) covariance of samples (N, p) about 0, shrunk towards a multiple of the unit matrix by as much as the
    samples' own scatter asks (Ledoit and Wolf 2004, J. Multivariate Anal. 88, 365, Eq. 14 and section 3.2).
    """
    samples, features = x.shape
    squares, product = x**2, x.T @ x
    if features == 1:
        return np.atleast_2d(squares.mean())
    covariance = product / samples
    variances = squares.sum(axis=0) / samples
    mean = variances.sum() / features
    size = (product**2).sum() / samples**2
    error = 1.0 / (features * samples) * ((squares.T @ squares).sum() / samples - size)
    off = (size - 2.0 * mean * variances.sum() + features * mean**2) / features
    shrinkage = min(error, off) / off if min(error, off) != 0 else 0.0
    return (1.0 - shrinkage) * covariance + shrinkage * (np.trace(covariance) / features) * np.eye(features)


def _correlation(covariance):
    scale = np.sqrt(np.maximum(np.diag(covariance), 1e-300))
    return covariance / np.outer(scale, scale)


def make_grid(cells, pass_numbers):
    keys = list(dict.fromkeys(c.key for c in cells))
    place = {(c.pass_number, *c.key): i for i, c in enumerate(cells)}
    return np.array([[place.get((p, *k), -1) for k in keys] for p in pass_numbers])


def scatter(rows, own, seed):
    """Variance of the mine's passes from truck to truck, (T, n), in variances of the model's runs; 1 at least.

    `own`, `seed` (n,): variances of one truck's instruments and of one run. The median over cells, as a single
    rock under the lip makes some of them large.
    """
    if len(rows) < 2:
        return 1.0
    usual = chdtri(len(rows) - 1, 0.5) / (len(rows) - 1)  # median of a variance, in what it estimates
    moves = seed > own
    ratio = (rows.var(axis=0, ddof=1) / usual - own)[moves] / seed[moves]
    return max(1.0, float(np.median(ratio))) if moves.any() else 1.0


def telling_cells(cells, values, share, noise):
    """Indices of the cells that vary at all and do not merely repeat another, pass by pass alike.

    A prediction errs by `share` times the covariance of the runs (R, n), and by `noise` (n, n).
    """
    total = np.sqrt(share * values.var(axis=0, ddof=1) + np.diag(noise))
    alive = total > 1e-9 * (1.0 + np.abs(values).mean(axis=0))
    keys = list(dict.fromkeys(c.key for c, a in zip(cells, alive) if a))
    keys.sort(key=lambda k: PREFERRED.index(k[2]) if k[2] in PREFERRED else len(PREFERRED))
    kept = []
    for key in keys:
        if not any(_follows(cells, values, share, noise, key, other) for other in kept if other[1] == key[1]):
            kept.append(key)
    return [i for i, c in enumerate(cells) if alive[i] and c.key in set(kept)]


def _follows(cells, values, share, noise, key, other):
    """Do two features move together in all passes, in the seeds and in the noise?"""
    rho = []
    place = {(c.pass_number, *c.key): i for i, c in enumerate(cells)}
    for number in dict.fromkeys(c.pass_number for c in cells):
        i, j = place.get((number, *key)), place.get((number, *other))
        if i is None or j is None:
            continue
        cov = share * np.cov(values[:, [i, j]].T) + noise[np.ix_([i, j], [i, j])]
        if cov[0, 0] > 0 and cov[1, 1] > 0:
            rho.append(cov[0, 1] / np.sqrt(cov[0, 0] * cov[1, 1]))
    return bool(rho) and min(abs(r) for r in rho) > COLLINEAR


def make_baseline(cells, values, own, common, pass_numbers, trucks=1):
    """Baseline of R runs, (R, n), over the cells worth keeping; the kept indices beside it."""
    if len(values) < 2:
        raise ValueError("a baseline needs two runs or more")
    keep = telling_cells(cells, values, 1 / trucks + 1 / len(values), own / trucks + common.T @ common)
    kept = [cells[i] for i in keep]
    grid = make_grid(kept, pass_numbers)
    values = values[:, keep]
    return Baseline(kept, values.mean(axis=0), values, own[np.ix_(keep, keep)], common[:, keep],
                    np.zeros((0, len(kept))), seed_covariance(values, grid, np.zeros((0, len(kept)))), grid,
                    trucks), keep
