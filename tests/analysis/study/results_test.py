"""The figures of a run in a study's table."""
import h5py
import numpy as np
import pytest

from dipper_study.results import FIGURES, operator_figures, warned, write_hdf5

PLANNED = {"passes": 3, "stopped": "the truck is full", "cycles_s": [50.0, 54.0], "truck_kg": 2.1e5,
           "truck_s": 150.0, "tonnes_per_hour": 5040.0, "energy_J_per_kg": 310.0}


def test_an_operators_are_in_the_table():
    assert operator_figures(PLANNED) == {"cycle_s": 52.0, "tonnes_per_hour": 5040.0, "energy_J_per_kg": 310.0}
    assert set(operator_figures(PLANNED)) <= set(FIGURES)


@pytest.mark.parametrize("operator",
                         [None, "python3 patient.py", {"passes": 1, "cycles_s": [], "tonnes_per_hour": None}])
def test_there_are_none_of_another_operator_or_a_single_pass(operator):
    assert all(np.isnan(v) for v in operator_figures(operator).values())


def test_units_are_those_of_the_names(tmp_path):
    row = {"run": "a", "status": "complete", "seed": 1, "payload_t": 70.0, **operator_figures(PLANNED)}
    write_hdf5([row], [], tmp_path / "study.h5", "a study")
    with h5py.File(tmp_path / "study.h5") as f:
        units = {name: f[name].attrs["unit"] for name in ("payload_t", "cycle_s", "tonnes_per_hour", "energy_J_per_kg",
                                                          "truck_load_fraction")}
        assert f["cycle_s"][0] == 52
    assert units == {"payload_t": "t", "cycle_s": "s", "tonnes_per_hour": "t/h", "energy_J_per_kg": "J/kg",
                     "truck_load_fraction": "1"}


def test_warnings_that_differ_in_their_numbers_alone_are_one_with_the_ranges():
    crowd = "pass 1: the crowd takes more force than the machine has in {} % of the dig"
    texts = [[crowd.format(44)], [crowd.format(9), "the door is 1.5 m3 of x-1.stl"], [crowd.format(49)], []]
    assert warned(texts) == [(crowd.format("9 to 49"), 3), ("the door is 1.5 m3 of x-1.stl", 1)]
    assert warned([["pass 1: slack", "pass 2: slack"], ["pass 1: -0.5 m"], ["pass 1: 2.5e-3 m"]]) == [
        ("pass 1: -0.5 to 2.5e-3 m", 2), ("pass 1 to 2: slack", 1)]
