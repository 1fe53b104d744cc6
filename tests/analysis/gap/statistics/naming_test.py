"""From which strength on an effect gets a name: where others look like it, and what a name at the limit is worth."""
from dataclasses import replace

import numpy as np

import fake_mine
from dipper_gap.statistics.isolability import isolability
from dipper_gap.statistics.match import match
from dipper_gap.statistics.naming import naming_limits

FEW = ("fines", "crowd_friction", "hoist_loss", "logger_offset", "truck_spillage")


def limits(signatures, w):
    found = isolability(signatures, w.covariance, only="").limits
    return found, naming_limits(signatures, w.covariance, w.baseline, found)


def test_a_name_needs_as_much_as_it_takes_to_stand_out_and_a_twin_leaves_none():
    w = fake_mine.world(0)
    some = [s for s in w.signatures if s.name in FEW]
    found, named = limits(some, w)
    assert np.isfinite(named).all() and (named >= found).all()
    one = some[0]
    twin = replace(one, effect=replace(one.effect, name="twin"))
    assert np.isinf(limits([*some, twin], w)[1][[0, -1]]).all()
    # What only takes away looks like nothing that adds, and like what goes to both sides.
    lesser = replace(twin, effect=replace(twin.effect, low=-one.effect.high, high=0.0))
    assert limits([*some, lesser], w)[1][0] < 1.2 * named[0]
    both = replace(one, effect=replace(one.effect, low=-one.effect.high))
    assert np.isinf(limits([both, *some[1:], lesser], w)[1][0])


def test_three_of_four_mines_at_the_limit_give_the_name():
    w = fake_mine.world(1)
    some = [s for s in w.signatures if s.name in FEW]
    rng, lower, right, trials = np.random.default_rng(5), np.linalg.cholesky(w.covariance), 0, 0
    for s, strength in zip(some, limits(some, w)[1]):
        for _ in range(12):
            y = strength * s.g + lower @ rng.standard_normal(len(s.g))
            right += match(y, w.covariance, some, w.baseline).presence(s.name) >= 0.9
            trials += 1
    print(f"{right} of {trials} are as probable as a name must be")
    assert right >= 0.75 * trials
