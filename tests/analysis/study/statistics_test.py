"""Mean, interval and paired comparison against known values."""
from types import SimpleNamespace

import numpy as np
import pytest

from dipper_study.report import _trends, comparisons
from dipper_study.statistics import compare, summary
from dipper_study.study_file import Parameter, Value


def test_a_summary_is_students():
    s = summary([1.0, 2.0, 3.0, float("nan")])
    assert (s.n, s.mean, s.sd) == (3, 2, 1)
    assert s.high - s.mean == pytest.approx(2.919986 / np.sqrt(3), rel=1e-6)  # t of 2 degrees at 95 %
    assert summary([4.0]).mean == 4 and np.isnan(summary([4.0]).low) and np.isnan(summary([]).mean)


def test_intervals_cover_as_often_as_they_say():
    rng = np.random.default_rng(1)
    hit = sum(s.low < 5 < s.high for s in (summary(5 + rng.standard_normal(4)) for _ in range(2000)))
    assert 0.88 < hit / 2000 < 0.92


def test_no_difference_is_claimed_more_often_than_the_level():
    rng = np.random.default_rng(2)
    draw = lambda: dict(enumerate(rng.standard_normal(5)))
    assert np.mean([compare(draw(), draw()).shown for _ in range(1000)]) < 0.13


def test_pairs_cancel_what_the_seeds_share():
    rng = np.random.default_rng(3)
    shared = 10 * rng.standard_normal(6)
    a = {s: x + 0.1 * rng.standard_normal() for s, x in enumerate(shared)}
    b = {s: x + 1 + 0.1 * rng.standard_normal() for s, x in enumerate(shared) if s > 0} | {9: 100.0}
    c = compare(a, b)
    assert c.difference.n == 5 and c.shown and c.difference.mean == pytest.approx(1, abs=0.2) and c.confidence > 0.99
    same = compare({1: 2.0, 2: 3.0}, {1: 2.0, 2: 3.0})
    assert not same.shown and same.confidence == 0.5


RAKE = Parameter("rake", tuple(Value(str(v), (), float(v)) for v in (58, 60, 62)))
STUDIES, SEEDS = 300, 4


def study_rows(rng, names, slope=0.0):
    """Rows of a study in which each seed has its own payload at each rake, and `names` of the other parameter change
    nothing."""
    payload = {(s, v.name): rng.normal(60, 5) + slope * v.number for s in range(SEEDS) for v in RAKE.values}
    return [{"seed": s, "rake": v.name, "other": n, "payload_t": payload[s, v.name]}
            for s in range(SEEDS) for v in RAKE.values for n in names]


@pytest.mark.parametrize("names", [("a",), ("a", "b", "c", "d", "e")])
def test_runs_of_one_seed_do_not_count_as_several(names):
    rng, shown, rises = np.random.default_rng(4), 0, 0
    for _ in range(STUDIES):
        rows = study_rows(rng, names)
        shown += next(comparisons(RAKE, ["rake", "other"], rows, ["payload_t"]))["shown"]
        trend, = _trends(RAKE, SimpleNamespace(names=["rake", "other"]), rows, ["payload_t"])
        rises += trend["low"] > 0 or trend["high"] < 0
        assert trend["n"] == SEEDS
    assert shown / STUDIES < 0.14 and rises / STUDIES < 0.14  # 0.10 is meant


def test_a_seed_is_compared_where_both_values_have_a_run():
    rows = study_rows(np.random.default_rng(5), ("a", "b"), slope=10.0)
    rows = [r for r in rows if (r["seed"], r["rake"], r["other"]) != (0, "60", "b")]
    rows.append({"seed": 9, "rake": "60", "other": "a", "payload_t": 1000.0})
    whole, part = (next(comparisons(RAKE, ["rake", "other"], some, ["payload_t"]))
                   for some in ([r for r in rows if r["other"] == "a" and r["seed"] < 9], rows))
    assert part["n"] == SEEDS and part["mean"] == pytest.approx(whole["mean"]) and part["shown"]


@pytest.mark.parametrize("payload_t", [0.7, 2.5, 20.1])
def test_a_figure_that_stays_has_no_trend(payload_t):
    rows = [{**r, "payload_t": payload_t} for r in study_rows(np.random.default_rng(6), ("a", "b"))]
    trend, = _trends(RAKE, SimpleNamespace(names=["rake", "other"]), rows, ["payload_t"])
    assert (trend["low"], trend["mean"], trend["high"]) == (0.0, 0.0, 0.0)


def test_equal_values_have_no_spread():
    s = summary([0.7, 0.7, 0.7])
    assert (s.mean, s.sd, s.low, s.high) == (0.7, 0.0, 0.7, 0.7)


def test_a_trend_is_the_slope_of_the_straight_line():
    rows = study_rows(np.random.default_rng(7), ("a",), slope=10.0)
    trend, = _trends(RAKE, SimpleNamespace(names=["rake", "other"]), rows, ["payload_t"])
    fits = [np.polyfit([v.number for v in RAKE.values], [r["payload_t"] for r in rows if r["seed"] == s], 1)[0]
            for s in range(SEEDS)]
    assert trend["mean"] == pytest.approx(np.mean(fits))
