"""Puts the package and this folder on the path, however pytest is started; a null of few draws."""
import functools
import pathlib
import sys

import pytest

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[2] / "analysis/gap"), str(HERE.parents[2] / "analysis/runs")]

FEW_DRAWS = 200  # of the null: enough for p below 0.01, in a fifth of the time


@pytest.fixture(scope="module")
def few_draws():
    from dipper_gap import model
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(model, "simulate_null", functools.partial(model.simulate_null, draws=FEW_DRAWS))
        yield
