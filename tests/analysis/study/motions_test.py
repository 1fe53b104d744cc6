"""plan.KEY: the case's motion, planned anew for a point of a study."""
import json
import os
import signal
import time

import pytest

from world import World

PLAN = "passes:\n  - heading_deg: 0\n    cut: {face: face_1.csv, depth_m: 1.0}\n"
STUDY = """case: case
seeds: [1, 2]
parameters:
  plan.passes.0.cut.depth_m: [1, 2]
"""


@pytest.fixture
def world(tmp_path):
    world = World(tmp_path)
    (world.folder / "case/plan.yaml").write_text(PLAN)
    return world


def made(world):
    return [json.loads(line) for line in (world.folder / "motions").read_text().splitlines()]


def test_each_value_has_a_motion_of_its_own(world):
    world.study(STUDY)
    deep = {(row["plan.passes.0.cut.depth_m"], row["seed"]): float(row["payload_t"]) for row in world.rows()}
    for seed in ("1", "2"):
        assert deep["2", seed] - deep["1", seed] == pytest.approx(1, abs=1e-3)  # of study.csv's digits
    assert [cut["depth_m"] for cut in made(world)] == [1, 2]


def test_a_face_beside_the_plan_is_still_found(world):
    world.study(STUDY)
    assert made(world)[0]["face"] == str(world.folder / "case/face_1.csv")


def test_a_motion_is_made_once(world):
    world.study(STUDY)
    world.study(STUDY)
    assert len(made(world)) == 2


def test_another_case_has_other_motions(world):
    world.study(STUDY)
    (world.folder / "case/case.yaml").write_text("seed: 1\n# a machine of another reach\n")
    world.study(STUDY)
    assert len(made(world)) == 4


def test_another_face_has_other_motions(world):
    face = world.folder / "case/face_1.csv"
    for rows in ("x_m,z_m\n0,0\n", "x_m,z_m\n0,1\n"):
        face.write_text(rows)
        world.study(STUDY)
    assert len(made(world)) == 4


def test_an_operator_who_plans_goes_by_the_changed_plan(world):
    (world.folder / "case/digs.yaml").write_text(PLAN.replace("1.0", "1.5"))
    by_plan = "set: {machine.operator: plan, machine.plan: digs.yaml}\n"
    world.study(STUDY + by_plan)
    deep = {(row["plan.passes.0.cut.depth_m"], row["seed"]): float(row["payload_t"]) for row in world.rows()}
    for seed in ("1", "2"):
        assert deep["2", seed] - deep["1", seed] == pytest.approx(1, abs=1e-3)
    world.study(SEARCH + by_plan)
    assert json.loads((world.out / "optimum.json").read_text())["base_at"] == [1.5]


@pytest.mark.parametrize("values, said", [
    ("plan.passes.0.cut.depth_m: [1, 9]", "under the ground"),
    ("plan.passes.0.cut.depth_m: [1, -1]", "case.yaml:1: domain.max_m: the dipper leaves the domain"),
    ("plan.passes.1.cut.depth_m: [1]", "no such key"),
    ("plan.passes.0.cut.face: [1]", "is no number"),
    ("plan.passes.0.cut.depth_m: [deep]", "is deep; a number"),
])
def test_what_cannot_be_planned_is_reported_with_its_line(world, values, said):
    printed = world.study(f"case: case\nseeds: [1]\nparameters:\n  {values}\n", status=2)
    assert f"study.yaml:4: {values.split(':')[0]}" in printed and said in printed
    assert world.calls() == []


@pytest.mark.parametrize("plan, said", [
    ("passes: [", "plan.yaml:1: YAML: "), ("[]", "plan.yaml:1: YAML: not a map; a plan"),
    ("{[a]: 1}", "plan.yaml: YAML: "), ("passes: 3", "has no such key"), ("passes: [{cut: 1}]", "has no such key"),
])
def test_a_plan_that_is_none(world, plan, said):
    (world.folder / "case/plan.yaml").write_text(plan)
    printed = world.study(STUDY, status=2)
    assert said in printed and "Traceback" not in printed and world.calls() == []


def test_a_case_without_a_plan(world):
    (world.folder / "case/plan.yaml").unlink()
    assert "has no plan.yaml" in world.study(STUDY, status=2)


SEARCH = """case: case
seeds: [1, 2]
optimise:
  maximise: payload_t
  parameters:
    plan.passes.0.cut.depth_m: {low: 0.5, high: 4}
  start: 3
  points: 4
  confirm_seeds: [11, 12]
"""


def test_the_search_begins_at_the_depth_of_the_plan(world):
    world.study(SEARCH)
    answer = json.loads((world.out / "optimum.json").read_text())
    assert answer["base_at"] == [1.0] and answer["best"][0] > 2


@pytest.mark.parametrize("study, hold", [(STUDY, "check 0"), (STUDY, "motion 0"), (SEARCH, "check 0"),
                                         (SEARCH, "motion 0"), (SEARCH, "motion 3")])  # 3: those of the ranges
def test_an_interrupt_before_the_first_run_is_one_too(world, study, hold):
    world.say("hold", hold)
    began = world.start(study)
    until = time.monotonic() + 60
    while not (world.folder / "held").exists():
        assert began.poll() is None and time.monotonic() < until
        time.sleep(0.02)
    os.killpg(began.pid, signal.SIGINT)  # as a terminal's Ctrl-C
    _, err = began.communicate(timeout=30)
    assert began.returncode == 4 and "study: interrupted; the same command continues" in err, err
    assert "dipper_study" not in err and world.calls() == [] and not world.out.exists()
