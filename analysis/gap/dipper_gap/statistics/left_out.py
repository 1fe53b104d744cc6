"""Do the mine's trucks lie as far from one another as the prediction says?"""
import numpy as np

from .baseline import seed_covariance
from .null import besides, make_runs, phase_labels, root
from .reference import with_scatter

DRAWS = 60  # sets of trucks with which the left-out ones are compared


def left_out_trucks(now, before, baseline, tails, seed=2):
    """Factor, 1 or more, by which the mine's trucks lie farther from one another than `baseline` says.

    Each truck is predicted from the others of its period; the mean T2 is compared with that of trucks drawn from the
    baseline's own covariance, which is estimated anew from each set. So a mine whose features move together
    otherwise than the model's is distinguished from one whose do not.
    """
    periods = [k for k, rows in enumerate((now, before)) if len(rows) > 1]
    if not periods:
        return 1.0
    rng, counts = np.random.default_rng(seed), (len(now), len(before))
    roots = root(baseline.seed), root(baseline.own), root(baseline.reference.own)
    seen = _left_out((now, before), baseline, periods)
    made = [_left_out(*_drawn(baseline, roots, counts, tails, rng), periods) for _ in range(DRAWS)]
    return max(1.0, float(seen / np.median(made)))


def _left_out(rows, baseline, periods):
    owns, total, count = (baseline.own, baseline.reference.own), 0.0, 0
    for k in periods:
        trucks = len(rows[k])
        covariance = (owns[k] + baseline.mine) * trucks / (trucks - 1.0)
        off = (rows[k] - rows[k].mean(axis=0)) * trucks / (trucks - 1.0)
        total += (off * np.linalg.solve(covariance, off.T).T).sum()
        count += trucks
    return total / count


def _drawn(baseline, roots, trucks, tails, rng):
    """Trucks of two periods, and the baseline as their own set of runs tells it; `roots` of the seeds' covariance and
    of the instruments', now and then."""
    runs, more = baseline.seeds, len(baseline.more)
    made = make_runs(roots[0], runs + sum(trucks) + more, tails, phase_labels(baseline.cells), rng)
    mine = made[runs:runs + sum(trucks)] * np.sqrt(baseline.scatter)
    mine = mine + besides(baseline.reference, len(mine), rng)
    rows = tuple(r + rng.standard_normal(r.shape) @ own.T
                 for r, own in zip((mine[:trucks[0]], mine[trucks[0]:]), roots[1:]))
    seed = seed_covariance(made[:runs], baseline.grid, made[len(made) - more:])
    return rows, with_scatter(baseline.told_by(made[:runs], seed), *rows)
