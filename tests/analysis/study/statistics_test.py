"""Mean, interval and paired comparison against known values."""
import numpy as np
import pytest

from dipper_study.statistics import compare, summary


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
