"""Trucks and seeds in the prediction, and the trucks' own scatter, against samples of known covariance."""
import numpy as np
import pytest

from dipper_gap.statistics.baseline import make_baseline, scatter
from dipper_gap.readings.features import Cell

CELLS = [Cell(p, phase, "hoist_force_kN", f) for p in (1, 2, 3) for phase in ("fill", "swing")
         for f in ("mean", "slope", "peak")]
RUNS, OWN, COMMON = 60, 0.3, 0.5


def baseline(trucks, seed=0):
    """Unit variance from seed to seed; each truck's instruments err by OWN, all together by COMMON."""
    rng = np.random.default_rng(seed)
    n = len(CELLS)
    own, common = np.eye(n) * OWN**2, np.full((1, n), COMMON)
    return make_baseline(CELLS, rng.standard_normal((RUNS, n)), own, common, (1, 2, 3), trucks)[0]


@pytest.mark.parametrize("trucks", [1, 4, 9])
def test_prediction_is_the_variance_of_the_trucks_mean(trucks):
    """Against mines made from what it assumes."""
    b, rng, n = baseline(trucks), np.random.default_rng(1), len(CELLS)
    rows = rng.standard_normal((4000, trucks, n)) + OWN * rng.standard_normal((4000, trucks, n))
    y = rows.mean(axis=1) + COMMON * rng.standard_normal((4000, 1))
    made = np.diag(b.noise + b.seed / trucks).mean()  # about the true mean: without the seeds' own error
    assert y.var(axis=0).mean() == pytest.approx(made, rel=0.1)
    assert np.allclose(np.diag(b.prediction), np.diag(b.noise) + np.diag(b.seed) * (1 / trucks + 1 / RUNS))


@pytest.mark.parametrize("larger", [1.0, 2.0])
def test_scatter_of_the_trucks_is_seen(larger):
    """Trucks whose passes vary `larger` times as much as the model's."""
    b, n, found = baseline(6), len(CELLS), []
    for k in range(40):
        rng = np.random.default_rng([5, k])
        rows = larger * rng.standard_normal((6, n)) + OWN * rng.standard_normal((6, n))
        found.append(scatter(rows + COMMON * rng.standard_normal(), np.diag(b.own), np.diag(b.seed)))
    assert np.median(found) == pytest.approx(larger**2, rel=0.2)
    assert min(found) >= 1.0


def test_one_truck_shows_no_scatter():
    assert scatter(np.ones((1, len(CELLS))), np.ones(len(CELLS)), np.ones(len(CELLS))) == 1.0
