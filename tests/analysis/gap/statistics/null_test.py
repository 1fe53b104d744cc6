"""False alarms at their nominal rate, on more than a thousand data sets in which nothing is hidden."""
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binom

from dipper_gap.statistics.baseline import make_baseline, scatter
from dipper_gap.readings.features import Cell
from dipper_gap.statistics.localise import localise, step_down
from dipper_gap.statistics.null import Null, find_tails, left_out_inflation, simulate_null

RUNS, PASSES, DRAWS = 8, 3, 150
WORLDS, MINES = 84, 12  # 1008 nulls


def cells():
    return [Cell(p, phase, channel, feature) for p in range(1, PASSES + 1) for phase in ("fill", "swing")
            for channel in ("hoist_force_kN", "crowd_force_kN") for feature in ("mean", "slope", "peak")]


def truth(rng):
    """A seed covariance the method does not know: correlated features, correlated passes, uneven sizes."""
    n = len(cells()) // PASSES
    root = rng.standard_normal((n, 3)) @ rng.standard_normal((3, n)) * 0.6 + np.eye(n)
    between = 0.3 ** np.abs(np.subtract.outer(range(PASSES), range(PASSES)))
    size = np.exp(rng.normal(0, 1, n))
    return np.kron(between, (root @ root.T) * np.outer(size, size))


def world(number, tails=None, trucks=1, more=0):
    """A baseline of RUNS runs and `more` deviations, and mines without any gap, (MINES, trucks, n)."""
    rng = np.random.default_rng(number)
    cov = truth(rng)
    n = len(cov)
    own, common = np.diag(0.3 * np.diag(cov)), np.sqrt(0.1 * np.diag(cov))[None]
    lower = np.linalg.cholesky(cov)
    rows = rng.standard_normal((RUNS + MINES * trucks, n)) @ lower.T
    if tails:  # Student's t instead of a Gaussian, same covariance
        rows *= np.sqrt((tails - 2) / rng.chisquare(tails, (len(rows), 1)))
    baseline, keep = make_baseline(cells(), rows[:RUNS], own, common, range(1, PASSES + 1), trucks)
    seen = rows[RUNS:].reshape(MINES, trucks, n)
    seen = seen + rng.standard_normal(seen.shape) * np.sqrt(np.diag(own)) + rng.standard_normal((MINES, 1, 1)) * common
    return baseline.with_deviations((rng.standard_normal((more, n)) @ lower.T)[:, keep]), seen[:, :, keep]


def p_values(count, trucks=1, more=0):
    omnibus, cell = [], []
    for number in range(count):
        baseline, mines = world(number, None, trucks, more)
        tails, nulls, found = find_tails(baseline), {}, []
        for rows in mines:  # each mine's own scatter, as the workflow takes it
            own = scatter(rows, np.diag(baseline.own), np.diag(baseline.seed))
            baseline = replace(baseline, scatter=own)
            if own not in nulls:
                nulls[own] = simulate_null(baseline, draws=DRAWS, seed=number, tails=tails)
            found.append(localise(rows.mean(axis=0) - baseline.mean, baseline, nulls[own]))
        omnibus.append([f.omnibus_p for f in found])
        cell.append([f.p_adjusted.min() for f in found])
    return np.array(omnibus), np.array(cell)


@pytest.fixture(scope="module")
def nulls():
    return p_values(WORLDS)


def bounds(hits):
    """Rate, and three standard errors of it that allow for mines sharing a baseline."""
    rate = hits.mean()
    binomial = binom.std(hits.size, rate) / hits.size
    clustered = hits.mean(axis=1).std(ddof=1) / np.sqrt(len(hits))
    return rate, 3 * max(binomial, clustered)


@pytest.mark.parametrize("alpha", [0.05, 0.20])
def test_omnibus_false_alarms_are_nominal(nulls, alpha):
    rate, margin = bounds(nulls[0] <= alpha)
    print(f"omnibus: {nulls[0].size} nulls, {rate:.4f} at {alpha}")
    assert nulls[0].size >= 1000
    assert abs(rate - alpha) < margin


def test_omnibus_at_the_level_that_decides(nulls):
    rate, margin = bounds(nulls[0] < 0.01)
    assert rate < 0.01 + margin and rate < 0.02


def test_omnibus_of_several_trucks_is_nominal():
    rate, margin = bounds(p_values(20, trucks=4, more=26)[0] <= 0.2)
    print(f"omnibus, four trucks: {rate:.4f} at 0.2")
    assert abs(rate - 0.2) < margin


def test_cells_false_alarms_are_family_wise(nulls):
    rate, margin = bounds(nulls[1] <= 0.05)
    print(f"cells: {rate:.4f} at 0.05")
    assert 0.02 < rate < 0.05 + margin  # tails estimated from eight runs err to the heavy side


def test_gaussian_seeds_need_no_inflation():
    assert np.mean([left_out_inflation(b, simulate_null(b, draws=100))
                    for b in (world(k)[0] for k in range(6))]) < 1.15


def test_heavy_tails_are_seen():
    """Most Gaussian baselines are taken as such, most t(3) ones are not."""
    gaussian = [find_tails(world(k)[0]) for k in range(15)]
    heavy = [find_tails(world(k, 3)[0]) for k in range(15)]
    assert np.mean([np.isinf(t.whole) for t in gaussian]) >= 0.6
    assert np.mean([np.isfinite(t.whole) for t in heavy]) >= 0.6


def test_an_effect_is_found_where_it_is():
    baseline, mines = world(3)
    null = simulate_null(baseline, draws=DRAWS)
    at = next(i for i, c in enumerate(baseline.cells) if c.pass_number == 2)
    there = 12 * baseline.sd[at] * np.eye(len(baseline.mean))[at]
    found = localise(mines[0].mean(axis=0) - baseline.mean + there, baseline, null)
    assert found.omnibus_p < 0.01
    assert np.argmin(found.p_adjusted) == at and found.p_adjusted[at] < 0.01
    assert np.median(found.p_adjusted) > 0.2


def test_step_down_against_a_hand_worked_case():
    null_z = np.array([[1.0, 3.0], [2.0, 0.5], [0.1, 0.2]])
    # |z| 2.5 against the larger of each row (3, 2, .2): 1 of 3; |z| 1 then against the first column.
    assert step_down(np.array([1.0, 2.5]), null_z) == pytest.approx([3 / 4, 2 / 4])


def test_min_p_combines_against_its_own_null():
    null = Null(np.column_stack([np.arange(100.0), np.arange(100.0)[::-1]]), np.zeros((100, 1)))
    assert null.omnibus_p(np.array([1000.0, 0.0])) == pytest.approx(1 / 101)
    # 97.5 is beaten by two draws (p 3/101); two draws in either column have a smaller p.
    assert null.omnibus_p(np.array([97.5, 0.0])) == pytest.approx(5 / 101)
