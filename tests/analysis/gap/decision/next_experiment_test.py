"""The experiment that distinguishes the effects of a class."""
import pytest

from dipper_gap.decision.next_experiment import propose


def test_experiments_split_a_class():
    best = propose({"liners": 0.5, "carry_back": 0.5})
    assert best[0].name == "tare" and best[0].bits == pytest.approx(1.0)
    assert propose({"liners": 1.0}) == []
