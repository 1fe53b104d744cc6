"""Matching on data with known truth: evidence against quadrature, coverage, and what is said of each truth."""
import functools
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import binom, multivariate_normal, truncnorm

import fake_mine
from dipper_gap.readings.features import number
from dipper_gap.statistics import evidence
from dipper_gap.decision.decide import decide, sure
from dipper_gap.statistics.isolability import isolability
from dipper_gap.statistics.localise import localise
from dipper_gap.statistics.match import Match, gains, interval, match, stability
from dipper_gap.statistics.signatures import BLOCK_ERROR, CELL_ERROR, Signature

LEAST_COVERED = 0.80  # of 90 % intervals, where models of effects err as assumed


def test_evidence_of_one_effect_is_the_integral():
    """Against quadrature over the strength; a fixed signature, so nothing is approximated."""
    rng = np.random.default_rng(1)
    n, e = 6, replace(fake_mine.CATALOGUE["fines"], low=0.0, high=0.5, scale=0.2)
    covariance = np.cov(rng.standard_normal((n, 40)))
    g, r = rng.standard_normal(n) * 4, rng.standard_normal(n)
    for residual in (r, r + 0.3 * g, r - 0.3 * g):
        f = evidence.fit(residual, covariance, [Signature(e, g, np.zeros((n, n)), np.zeros((n, n)))])
        a = np.linspace(e.low, e.high, 4001)
        prior = truncnorm.pdf(a, e.low / e.scale, e.high / e.scale, 0, e.scale)
        like = multivariate_normal.pdf(residual - a[:, None] * g, cov=covariance)
        assert f.log_evidence == pytest.approx(np.log(np.trapz(like * prior, a)), abs=2e-3)
        assert e.low <= f.best[0] <= e.high


def test_evidence_of_two_effects_is_the_integral():
    rng = np.random.default_rng(2)
    n = 5
    effects = [replace(fake_mine.CATALOGUE[k], low=0.0, high=0.8, scale=0.3) for k in ("fines", "cohesion")]
    covariance = np.cov(rng.standard_normal((n, 30)))
    g = rng.standard_normal((2, n)) * 3
    residual = 0.2 * g[0] + 0.1 * g[1] + 0.5 * rng.standard_normal(n)
    exact = np.zeros((n, n))
    f = evidence.fit(residual, covariance, [Signature(e, x, exact, exact) for e, x in zip(effects, g)])
    a = np.linspace(0, 0.8, 401)
    prior = truncnorm.pdf(a, 0, 0.8 / 0.3, 0, 0.3)
    left = residual - a[:, None, None] * g[0] - a[None, :, None] * g[1]
    like = multivariate_normal.pdf(left, cov=covariance)
    total = np.trapz(np.trapz(like * prior[None, :], a, axis=1) * prior, a)
    assert f.log_evidence == pytest.approx(np.log(total), abs=5e-3)


@pytest.mark.parametrize("count", [1, 5, 4000])
def test_few_strengths_are_drawn_as_many_are(count):
    """A set of effects that gets few of an interval's draws is not replaced by its mode."""
    e, n = replace(fake_mine.CATALOGUE["fines"], low=0.0, high=0.5, scale=0.2), 3
    s = Signature(e, np.ones(n), np.zeros((n, n)), np.zeros((n, n)))
    f = evidence.fit(np.full(n, 0.1), 0.03 * np.eye(n), [s])
    drawn = evidence.sample(f, [s], count, np.random.default_rng(1))[:, 0]
    assert drawn.shape == (count,) and (drawn >= e.low).all() and (drawn <= e.high).all()
    assert (drawn != f.best[0]).all()


@pytest.mark.parametrize("a, b, c", [(0.0, 0.0, 0.0), (0.6, 0.3, 0.5), (-0.4, -0.4, 0.9), (0.98, 0.97, 0.98)])
def test_the_share_of_three_in_a_corner_is_the_known_one(a, b, c):
    corr = np.array([[1, a, b], [a, 1, c], [b, c, 1]])
    corner = 1 / 8 + (np.arcsin(a) + np.arcsin(b) + np.arcsin(c)) / (4 * np.pi)
    sd = np.array([1.0, 20.0, 0.3])
    share = evidence._log_box(np.zeros(3), corr * np.outer(sd, sd), np.zeros(3), np.full(3, np.inf))
    assert np.exp(share) == pytest.approx(corner, rel=2e-4)


class Case:
    """A world with what every decision in it needs."""

    def __init__(self, number):
        self.w = fake_mine.world(number)
        self.directions, self.null = self.w.directions, self.w.null
        self.table = isolability(self.w.signatures, self.w.covariance)
        self.limits = {n: x for n, x in zip(self.table.names, self.table.limits) if np.isfinite(x)}

    def decide(self, residual, largest=2):
        w = self.w
        p = localise(residual, w.baseline, self.null, self.directions).omnibus_p
        m = match(residual, w.covariance, w.signatures, w.baseline, largest=largest)
        return decide(p, m, w.signatures, w.covariance, w.plain, residual, w.baseline, self.null)


case_of = functools.lru_cache(None)(Case)


@pytest.fixture
def case():
    return case_of(0)


@pytest.mark.parametrize("multiple, least_right", [(1, 0.75), (2, 0.90)])
def test_effects_are_named_at_their_limit_and_twice_it(multiple, least_right):
    """In three worlds, each mine with seeds and noise of its own."""
    verdicts = []
    for world in range(3):
        case = case_of(world)
        for k, (n, x) in enumerate(case.limits.items()):
            if multiple * x <= fake_mine.CATALOGUE[n].reference() * 1.5:
                verdicts.append((n, case.decide(case.w.residual({n: multiple * x}, 100 * multiple + k))))
    right = sum(v.verdict == "named" and v.effect == n for n, v in verdicts)
    wrong = [(n, v.effect) for n, v in verdicts if v.verdict == "named" and v.effect != n]
    print(f"at {multiple} x limit: {right} of {len(verdicts)} right, wrong {wrong}")
    assert len(verdicts) >= 27
    assert len(wrong) <= 0.05 * len(verdicts)
    assert right >= least_right * len(verdicts) - 1


def test_weak_effects_are_not_named_wrongly(case):
    for n, x in list(case.limits.items())[::2]:
        v = case.decide(case.w.residual({n: 0.3 * x}, 60))
        assert v.verdict in ("no-gap", "unknown", "class") or v.effect == n


def test_the_same_residual_judged_twice_is_the_same_and_no_probability_is_above_1(case):
    w = case.w
    s = next(s for s in w.signatures if s.name == "fines")
    once, twice = (match(0.3 * s.g, w.covariance, w.signatures[:6] + [s] * (s not in w.signatures[:6]), w.baseline)
                   for _ in range(2))
    assert once.probability == twice.probability and max(map(len, once.fits)) == 3
    assert sum(once.probability.values()) == pytest.approx(1, abs=1e-12) and once.presence("fines") <= 1


def test_rounding_makes_no_probability_above_1():
    m = Match({}, {(n,): 0.1 for n in "abcdefghij"} | {("a", "b"): 1e-15}, {})
    assert m.any_of("abcdefghij") == 1 and m.presence("a") == pytest.approx(0.1)


def test_nothing_hidden_nothing_named(case):
    assert all(case.decide(case.w.residual({}, 70 + k), largest=1).verdict != "named" for k in range(8))


@pytest.mark.parametrize("size", [1.0, 2.0, 4.0])
def test_an_effect_outside_the_catalogue_has_no_name(case, size):
    assert case.decide(case.w.residual({"outside": size}, 80)).verdict in ("unknown", "no-gap")


@pytest.mark.parametrize("growing", [0, 1])
def test_a_load_cell_that_reads_too_much_has_no_name(case, growing):
    """By a tenth in all passes, or by a quarter in the last: no effect of the catalogue."""
    v = case.decide(case.w.residual({}, 85) + (0.1, 0.25)[growing] * gains(case.w.baseline)[:, growing])
    assert v.verdict == "unknown"


def test_a_gain_that_the_catalogue_has_is_not_unknown(case):
    """Of a drifting cell with a name, nothing is left for a nameless gain to explain as well."""
    world = case.w
    v = gains(world.baseline)[:, 0]
    effect = fake_mine.effect("cell_drift", "1", 0.4, 0.08, "observation", "both")
    drift = Signature(effect, v, 0 * world.covariance, np.diag((0.05 * v) ** 2))
    size = 9.0 / np.sqrt(v @ np.linalg.solve(world.covariance, v))
    assert 0.01 < size < 0.2
    alone = match(size * v, world.covariance, world.signatures[1:], world.baseline, 1)
    known = match(size * v, world.covariance, [*world.signatures[1:], drift], world.baseline, 1)
    assert alone.probability["unknown"] > 0.9
    assert known.presence("cell_drift") > 0.95 and known.probability["unknown"] < 0.02


def test_one_training_pass_has_no_growing_gain(case):
    one, _ = case.w.baseline.part((1,))
    assert gains(one).shape[1] == 2 and np.abs(gains(one)).sum(axis=0).min() > 0


def test_companions_are_sure_or_left_out():
    def matched(both, alone):
        sets = {("a",): alone, ("b",): 0.01, ("a", "b"): both, "none": 0.0, "unknown": 1 - both - alone - 0.01}
        return Match({k: None for k in sets if isinstance(k, tuple)}, sets, {})
    assert sure(matched(0.93, 0.05), "a") == ("a", "b")
    assert sure(matched(0.60, 0.38), "a") == ("a",)


def test_effects_that_look_alike_are_a_class(case):
    """A copy of an effect under another name, a few per cent off, cannot be distinguished from it."""
    w = case.w
    one = next(s for s in w.signatures if s.name == "fines")
    rng = np.random.default_rng(3)
    twin = Signature(replace(one.effect, name="twin"), one.g * (1 + 0.03 * rng.standard_normal(len(one.g))),
                     one.noise, one.wrong)
    signatures = w.signatures + [twin]
    residual = w.residual({"fines": 1.5 * case.limits["fines"]}, 90)
    p = localise(residual, w.baseline, case.null, case.directions).omnibus_p
    m = match(residual, w.covariance, signatures, w.baseline, largest=1)
    v = decide(p, m, signatures, w.covariance, w.plain, residual, w.baseline, case.null)
    assert v.verdict == "class" and {"fines", "twin"} <= set(v.members)
    assert v.probability >= 0.9
    assert "twin" in isolability(signatures, w.covariance).classmates("fines")


def test_intervals_cover(case):
    """90 % intervals over effects, strengths and mines of two worlds."""
    covered = []
    for c in (case, case_of(1)):
        for n, limit in c.limits.items():
            for k, multiple in enumerate((1.0, 1.5, 2.0)):
                truth = multiple * limit
                m = match(c.w.residual({n: truth}, 100 + k), c.w.covariance, c.w.signatures, c.w.baseline,
                          largest=1)
                low, high = interval(m, n, c.w.signatures)
                covered.append(low <= truth <= high)
    rate, count = np.mean(covered), len(covered)
    print(f"coverage {rate:.3f} of {count}")
    assert count >= 60
    assert 0.80 <= rate and rate >= 0.90 - 3 * binom.std(count, 0.9) / count


def test_intervals_cover_what_the_models_of_effects_get_wrong(case):
    """Mines in which each block of an effect errs by itself, as assumed: part of that is in the strength."""
    w, covered = case.w, []
    block = number([(c.phase, c.channel) for c in w.baseline.cells])
    lower = np.linalg.cholesky(w.covariance)
    for s in w.signatures:
        truth = 1.5 * case.limits.get(s.name, np.inf)
        rng = np.random.default_rng(4)
        for _ in range(12 if truth < s.effect.high else 0):
            wrong = BLOCK_ERROR * rng.standard_normal(block.max() + 1)[block]
            wrong += CELL_ERROR * rng.standard_normal(len(s.g))
            y = truth * s.g * (1 + wrong) + lower @ rng.standard_normal(len(s.g))
            low, high = interval(match(y, w.covariance, [s], w.baseline, largest=1), s.name, [s])
            covered.append(low <= truth <= high)
    print(f"coverage with wrong blocks {np.mean(covered):.3f} of {len(covered)}")
    assert len(covered) >= 120 and np.mean(covered) > LEAST_COVERED


def test_each_effect_of_a_pair_leads_again(case):
    """At twice its limit each is led by none but itself, the other taken off; a tenth of its limit by chance."""
    w = case.w
    pair = [next(s for s in w.signatures if s.name == n) for n in ("crowd_friction", "truck_spillage")]
    assert all(2 * case.limits[s.name] < s.effect.high for s in pair)  # beyond its bounds a strength is unknown
    residual = sum(2 * case.limits[s.name] * s.g for s in pair)
    m = match(residual, w.covariance, w.signatures, w.baseline, largest=2)
    assert m.best_with(pair[0].name) == m.best_with(pair[1].name)
    assert all(stability(m, s.name, w.covariance, w.signatures) > 0.9 for s in pair)
    weak = match(0.1 / 2 * residual, w.covariance, w.signatures, w.baseline, largest=2)
    assert stability(weak, pair[0].name, w.covariance, w.signatures) < 0.6
