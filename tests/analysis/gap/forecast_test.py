"""What 2, 4 and 8 trucks would show, from runs alone."""
import json
from dataclasses import replace

import pytest

import fake_mine
from dipper_gap.forecast import WAYS, as_lines, forecast, write_forecast
from dipper_gap.readings.channels import read_channels
from other_mine import periods

pytestmark = pytest.mark.usefixtures("few_draws")
SMALL = {n: fake_mine.CATALOGUE[n] for n in ("fines", "crowd_friction", "scale_gain", "density")}


@pytest.fixture(scope="module")
def forecasts(few_draws):
    said = []
    out = forecast(read_channels(), fake_mine.FakeSimulator(), SMALL, 1, said.append)
    return out, said


def test_more_trucks_show_less_and_a_reference_shows_the_scale(forecasts, tmp_path):
    out, said = forecasts
    assert set(out.limits) == set(SMALL) - {"density"} and out.runs == 16 + 3 * 3 and "25 runs" in said[0]
    for name, ways in out.limits.items():
        for way in WAYS:
            found, named = ([x if x is not None else float("inf") for x in kind[way]] for kind in (ways, ways["named"]))
            assert found[0] >= found[1] >= found[2], (name, way)
            assert all(a <= 1.001 * b for a, b in zip(found, named)), (name, way)
    friction, gain = out.limits["crowd_friction"], out.limits["scale_gain"]
    assert 10 < friction["model"][1] < 150
    # The scale's shared tonne hides its gain; of one scale half a tonne at most has changed.
    assert gain["reference"][2] < gain["model"][2]
    write_forecast(out, SMALL, tmp_path / "plan.json")
    kept = json.loads((tmp_path / "plan.json").read_text())
    assert kept["trucks"] == [2, 4, 8] and kept["effects"]["fines"]["reference"] == out.limits["fines"]["reference"]
    lines = as_lines(out, SMALL)
    assert len(lines) == 1 + 3 and "+ 8 before" in lines[0] and len({len(line) for line in lines}) == 1


def test_a_reference_that_is_there_counts_as_it_is(forecasts):
    """Its mine is one that the model misses, so what an effect does to it is known less well."""
    _, before = periods([{}] * 6, [{}] * 2, 3)
    out = forecast(before.channels, fake_mine.FakeSimulator(), SMALL, 1, [].append, before)
    assert out.reference == 6 and "4 + 6 before" in as_lines(out, SMALL)[0]
    here, assumed = (x.limits["crowd_friction"]["reference"] for x in (out, forecasts[0]))
    assert here[0] > here[1] > here[2] > 0.9 * assumed[2] and here[1] != assumed[1]
    # How far the scale may have moved since, the instruments of now say.
    steady = {n: replace(c, drift_sigma=0.0) for n, c in before.channels.items()}
    surer = forecast(steady, fake_mine.FakeSimulator(), SMALL, 1, [].append, before)
    assert surer.limits["scale_gain"]["reference"][1] < 0.9 * out.limits["scale_gain"]["reference"][1]


def test_a_scan_of_the_face_shows_what_forces_and_masses_do_not():
    """The height of a pile that the teeth leave below its crest, and where the shovel stands."""
    few = {n: fake_mine.CATALOGUE[n] for n in ("pile_height", "standoff", "scale_gain")}
    said = []
    out = forecast(read_channels(), fake_mine.FakeSimulator(faces=True), few, 1, said.append)
    assert "face_m" in out.channels
    for name in ("pile_height", "standoff"):
        with_face, without = out.limits[name]["model"][1], out.faceless[name]["model"][1]
        assert with_face and (without is None or with_face < 0.75 * without), (name, with_face, without)
    lines = as_lines(out, few)
    assert lines[0] == "without the face:" and len(lines) == 2 * (2 + 3) + 1


def test_assumed_instruments_are_a_channels_file():
    assert read_channels()["hoist_force_kN"].drift_sigma == 7.5
