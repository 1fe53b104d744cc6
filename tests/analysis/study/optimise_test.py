"""The search for the best setting, on functions with noise whose optimum is known; the simulator is a stand-in."""
import json
import random

import numpy as np
import pytest

from dipper_run.program import ProgramFailed
from dipper_study.optimise import search
from dipper_study.study_file import read_study
from dipper_study.surrogate import Surrogate, expected_improvement, pooled_variance
from world import World

STUDY = """case: case
seeds: [1, 2, 3]
optimise:
  maximise: payload_t / dig_work_MJ
  parameters:
    machine.rake_angle_deg: {low: 58, high: 70}
    pile.toe_x_m: {low: -2, high: 3}
  start: 6
  points: 16
  batch: 2
  confirm_seeds: [11, 12, 13, 14, 15, 16]
"""


class Session:
    """Over a function of (rake, toe, seed) in place of runs; its own planner."""

    def __init__(self, study, function):
        self.study, self.function, self.planner, self.made, self.runs = study, function, Planner(), 0, {}

    def make(self, runs):
        self.made += len(runs)
        return [{"seed": s, "dig_work_MJ": 1.0, **self.function(*(v.number for v in p.values), s)} for p, s in runs]


class Planner:
    def check(self, points):
        pass

    def faults(self, points):
        return {}

    def checked(self, point):
        return {"values": {"machine.rake_angle_deg": 60, "pile.toe_x_m": 0}}

    def runs(self, points, seeds):
        return [(p, s) for p in points for s in seeds]


def searched(tmp_path, function, study=STUDY):
    (tmp_path / "case").mkdir(exist_ok=True)
    (tmp_path / "case/case.yaml").write_text("seed: 1\n")
    (tmp_path / "study.yaml").write_text(study)
    session = Session(read_study(tmp_path / "study.yaml"), function)
    return search(session, lambda text: None), session


def noise(kind, sigma, *key):
    return random.Random(f"{kind} {key}").gauss(0, sigma)


def hill(rake, toe, seed):
    """Best at rake 64, toe 1: 70, where the base has 60; a run scatters by 1.5, and by 3 that its seed gives to all."""
    payload = 70 - 0.5 * (rake - 64) ** 2 - 2 * (toe - 1) ** 2
    return {"payload_t": payload + noise("seed", 3, seed) + noise("own", 1.5, rake, toe, seed),
            "dig_force_peak_MN": 8 + 0.5 * (rake - 60) + noise("peak", 0.1, rake, toe, seed)}


def test_the_known_optimum_is_found_and_confirmed(tmp_path):
    answer, session = searched(tmp_path, hill)
    assert session.made == 16 * 3 + 2 * 6
    assert answer["improved"] and answer["confidence"] > 0.95
    assert answer["best"][0] == pytest.approx(64, abs=1.5) and answer["best"][1] == pytest.approx(1, abs=0.8)
    assert answer["difference"]["low"] < 10 < answer["difference"]["high"] + 2


def test_a_constraint_is_held(tmp_path):
    bound = STUDY.replace("  start", "  constraints: {dig_force_peak_MN: {at_most: 9}}\n  start")
    answer, _ = searched(tmp_path, hill, bound)  # rake up to 62
    assert answer["improved"] and answer["constraints"][0]["held"]
    assert 60.5 < answer["best"][0] < 62.4


def test_a_minimum_is_a_maximum_turned_over(tmp_path):
    study = STUDY.replace("maximise: payload_t / dig_work_MJ", "minimise: dig_force_peak_MN")
    answer, _ = searched(tmp_path, hill, study)
    assert answer["improved"] and answer["best"][0] < 59 and answer["difference"]["mean"] < -0.4
    assert all(a <= m <= b for s in answer["slices"] for a, m, b in zip(s["low"], s["mean"], s["high"]))


def test_where_the_case_itself_is_best_it_alone_is_run_again(tmp_path):
    def top(rake, toe, seed):
        return {"payload_t": 70 - (rake - 60) ** 2 - 4 * toe**2 + noise("own", 0.1, rake, toe, seed)}

    answer, session = searched(tmp_path, top, STUDY.replace("points: 16", "points: 6"))
    assert not answer["improved"] and answer["best"] == answer["base_at"] == [60, 0]
    assert answer["says"].startswith("no better than the base: of 6 points the case itself is called best")
    assert session.made == 6 * 3 + 6


def test_no_improvement_is_claimed_where_there_is_none(tmp_path):
    """Of searches on a flat function with noise a twentieth may claim one: 90 % intervals, one side."""
    flat = STUDY.replace("points: 16", "points: 8")
    claims = 0
    for k in range(12):
        def function(rake, toe, seed, k=k):
            return {"payload_t": 60 + noise(k, 3, seed) + noise(k, 1.5, rake, toe, seed), "dig_force_peak_MN": 8}

        answer, _ = searched(tmp_path, function, flat)
        claims += answer["improved"]
        assert answer["improved"] or answer["says"].startswith("no better than the base")
    assert claims <= 2


def test_points_that_give_no_figure_are_left_out_and_not_asked_for_again(tmp_path):
    asked = []

    def broken(rake, toe, seed):
        if rake > 62:
            asked.append((rake, toe, seed))
            return {}
        return hill(rake, toe, seed)

    answer, _ = searched(tmp_path, broken)
    assert answer["points"] + len(asked) // 3 == 16 and len(set(asked)) == len(asked)
    assert answer["improved"] and 60.5 < answer["best"][0] <= 62


def test_a_search_with_the_case_alone_is_refused(tmp_path):
    with pytest.raises(ProgramFailed) as e:
        searched(tmp_path, lambda rake, toe, seed: hill(rake, toe, seed) if abs(rake - 60) < 1e-9 else {})
    assert "study.yaml:6: optimise.parameters: of 6 points only the case itself gives a figure; ranges" in str(e.value)


def test_the_noise_is_that_of_the_seeds():
    rng = np.random.default_rng(1)
    groups = rng.normal(0, 5, (1, 6)) + rng.normal(0, 7, (40, 1)) + rng.normal(0, 1.5, (40, 6))
    assert pooled_variance(groups) == pytest.approx(1.5**2, rel=0.15)


def test_the_model_smooths_what_is_noise_and_knows_where_it_has_not_looked():
    rng = np.random.default_rng(2)
    x = np.linspace(0, 0.5, 12)[:, None]
    y = np.sin(3 * x[:, 0]) + rng.normal(0, 0.1, 12)
    mean, sd = Surrogate(x, y, 0.01)([[0.25], [1.0]])
    assert mean[0] == pytest.approx(np.sin(0.75), abs=0.1) and sd[0] < 0.07 < sd[1]


def test_equal_values_give_their_value_and_the_noise():
    x = np.linspace(0, 1, 12)[:, None]
    mean, sd = Surrogate(x, np.full(12, 0.1 + 0.2), 1e-4)([[0.25], [0.5]])
    assert mean == pytest.approx(0.3) and (1e-4 < sd).all() and (sd < 1).all()


def test_expected_improvement_is_that_of_a_gaussian():
    rng = np.random.default_rng(3)
    drawn = np.maximum(rng.normal(1.0, 0.5, 400_000) - 1.2, 0).mean()
    assert expected_improvement(1.0, 0.5, 1.2) == pytest.approx(drawn, rel=0.02)


def test_the_command_searches_goes_on_and_says_what_it_found(tmp_path):
    world = World(tmp_path)
    study = STUDY.replace("points: 16", "points: 8").replace("start: 6", "start: 5")
    world.study(study)
    made = len(world.calls())
    assert made == 8 * 3 + 2 * 6
    answer = json.loads((world.out / "optimum.json").read_text())
    assert answer["points"] == 8 and answer["base_at"] == [60, 0] and len(world.rows()) == made
    run = [[r["machine.rake_angle_deg"], r["pile.toe_x_m"]] for r in world.rows()]
    assert [f"{x:.6g}" for x in answer["best"]] in run and '"mean": NaN' not in (world.out / "optimum.json").read_text()
    world.study(study)
    assert len(world.calls()) == made and json.loads((world.out / "optimum.json").read_text()) == answer
    said = world.study(study.replace("low: 58, high: 70", "low: 62, high: 70"), status=2)
    assert "study.yaml:6: machine.rake_angle_deg: the case has 60; a range that holds it" in said


def test_what_was_run_is_written_where_the_search_cannot_go_on(tmp_path):
    world = World(tmp_path)
    world.say("fail", "2")
    said = world.study(STUDY, status=3)
    assert "the case itself gives no figure to hold others against" in said
    assert [r["status"] for r in world.rows()] == ["complete", "failed", "complete"] * 6
    assert (world.out / "report.html").exists() and not (world.out / "optimum.json").exists()


def test_a_point_that_is_no_sound_case_is_left_out(tmp_path):
    world = World(tmp_path)
    world.say("steep", "64")
    said = world.study(STUDY.replace("points: 16", "points: 8"))
    assert "is not a valid case, left out: " in said and "study.yaml:7: pile.toe_x_m: the dipper is in the pile" in said
    answer = json.loads((world.out / "optimum.json").read_text())
    assert answer["points"] < 8 and answer["runs"] == len(world.rows())
