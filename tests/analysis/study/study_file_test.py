"""STUDY.yaml: what it may say, and every error of it at once with file, line, key and what would be right."""
import pytest

from dipper_run.findings import BadInput
from dipper_study.study_file import read_study


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "case").mkdir()
    (tmp_path / "case/case.yaml").write_text("seed: 1\n")
    return tmp_path


def read(folder, text):
    (folder / "s.yaml").write_text(text)
    return read_study(folder / "s.yaml")


def faults(folder, text):
    with pytest.raises(BadInput) as e:
        read(folder, text)
    return [f.replace(str(folder / "s.yaml"), "") for f in e.value.findings]


def test_points_are_all_combinations(folder):
    study = read(folder, """case: case
seeds: [4, 2]
set: {end_s: 13, domain.max_m: [32, 28, 24]}
parameters:
  machine.rake_angle_deg: [60, 62]
  bucket:
    plain: {}
    wide: {bodies.dipper: ../wide.stl, bodies.door: ../door.stl}
""")
    points = study.points()
    assert [str(p) for p in points] == ["60, plain", "60, wide", "62, plain", "62, wide"]
    assert [str(s) for s in points[3].settings] == [
        "end_s=13", "domain.max_m=[32, 28, 24]", "machine.rake_angle_deg=62", "bodies.dipper=../wide.stl",
        "bodies.door=../door.stl"]
    assert study.seeds == (4, 2) and (study.ranks, study.jobs) == (1, None)
    assert (study.keep, study.executor) == ("record", "local")
    assert [v.number for p in study.parameters for v in p.values] == [60, 62, None, None]


def test_a_case_behind_a_link_is_the_one_that_the_system_finds(tmp_path):
    """The study's folder is a link, or the case's path leads through one: ".." is beside what it points to."""
    for name in ("mine", "here"):
        (tmp_path / name / "case").mkdir(parents=True)
        (tmp_path / name / "case/case.yaml").write_text("seed: 1\n")
    (tmp_path / "mine/studies").mkdir()
    (tmp_path / "here/studies").symlink_to(tmp_path / "mine/studies")
    for file, case in (("here/studies", "../case"), ("here", "studies/../case")):
        assert read(tmp_path / file, f"case: {case}\nseeds: [1]\nparameters: {{end_s: [1]}}\n").case.samefile(
            tmp_path / "mine/case")
    plain = read(tmp_path / "mine/studies", "case: ../case\nseeds: [1]\nparameters: {end_s: [1]}\n").case
    assert plain == tmp_path / "mine/case"  # without a link as it reads


def test_every_error_is_reported_at_once_with_its_line(folder):
    found = faults(folder, """case: nowhere
seeds: [1, 1, x]
parametres: {}
parameters:
  machine.rake_angle_deg: [60, 60]
  seed: [3]
  pile.toe_x_m: 3
set: {machine.rake_angle_deg: 3}
ranks: 0
keep: dumps
executor: pbs
slurm: {queue: long}
""")
    for start in (":1: case: ", ":2: seeds: has 1 twice", ":2: seeds: has x",
                  ":3: parametres: unknown key; parameters, perhaps? one of case",
                  ":5: machine.rake_angle_deg: is set by set too", ":6: seed: is the study's own; seeds",
                  ":5: parameters.machine.rake_angle_deg: has 60 twice", ":7: parameters.pile.toe_x_m: is 3; a list",
                  ":9: ranks: is 0; a number, 1", ":10: keep: is dumps; one of summary, record, all",
                  ":11: executor: is pbs; one of local, slurm", ":12: slurm.queue: unknown key; one of at_once"):
        assert any(f.startswith(start) for f in found), (start, found)
    assert len(found) == 12


@pytest.mark.parametrize("text, fault", [
    ("[]", "not a map"), ("case: case\nseeds: [1]\n", "parameters: missing"), ("case: [", "YAML"),
    ("case: case\nseeds: []\nparameters: {a: [1]}\n", ":2: seeds: is an empty list"),
    ("case: case\nseeds: [1]\nseeds: [2]\nparameters: {a: [1]}\n", ":3: seeds: given twice"),
    ("case: case\nseeds: [1.5]\nparameters: {a: [1]}\n", "whole numbers"),
    ("case: case\nseeds: [1]\nparameters: {a: [1]}\nset:\n  b:\n    - 1\n", "in flow style"),
    ("case: case\nseeds: [1]\nparameters: {}\n", ":3: parameters: is an empty map; a case key with a list"),
    ("case: case\nseeds: [1]\nparameters: {a: {}}\n", ":3: parameters.a: is an empty map; named values"),
    ("case: case\nseeds: [1]\nparameters:\n  a:\n", ":4: parameters.a: is empty; a list of values"),
    ("case: case\nseeds: [1]\nparameters: {[a, b]: [1]}\n", ":3: parameters.key: is a list; a word"),
    ("case: case\nseeds: [1]\nparameters: {seed: {a: {}}}\n", ":3: parameters.seed: cannot name a column"),
    ("case: case\nseeds: [1]\nparameters: {a/b: {a: {}}}\n", ":3: parameters.a/b: cannot name a column"),
    ("case: case\nseeds: [1]\nparameters: {'': {a: {}}}\n", ":3: parameters.: cannot name a column"),
])
def test_faults(folder, text, fault):
    assert any(fault in f for f in faults(folder, text))


OPTIMISE = """case: case
seeds: [1, 2]
optimise:
  maximise: payload_t / dig_work_MJ
  constraints: {dig_force_peak_MN: {at_most: 10}}
  parameters: {machine.rake_angle_deg: {low: 58, high: 66}}
  confirm_seeds: [11, 12]
"""


def test_an_optimisation(folder):
    o = read(folder, OPTIMISE).optimise
    assert o.objective.value_in({"payload_t": 60.0, "dig_work_MJ": 20.0}) == 3 and o.maximise
    assert o.constraints[0].margin(9) == 1 and str(o.constraints[0]) == "dig_force_peak_MN at most 10"
    assert (o.start, o.points, o.batch, o.confirm_seeds) == (4, 12, 2, (11, 12))


@pytest.mark.parametrize("more", ["keep: all\n", "set: {output.dump_every_s: 0.5}\n"])
def test_an_optimisation_of_what_dumps_show(folder, more):
    assert read(folder, OPTIMISE.replace("dig_force_peak_MN", "fill_factor_load") + more).optimise


@pytest.mark.parametrize("old, new, fault", [
    ("payload_t /", "paylode /", ":4: optimise.maximise: paylode is no column; of payload_t"),
    ("maximise", "best", "both or none of maximise and minimise"), ("low: 58", "low: 68", "68 is not below 66"),
    ("at_most: 10", "under: 10", "unknown key; one of at_least, at_most"), ("[11, 12]", "[2, 12]", "fresh ones"),
    ("[1, 2]", "[1]", "two or more with optimise"),
    ("dig_force_peak_MN", "fill_factor_load", "keep: is record; all, or set: {output.dump_every_s: 0.5}"),
    ("{machine.rake_angle_deg: {low: 58, high: 66}}", "{}", ":6: optimise.parameters: is an empty map; a case key"),
])
def test_faults_of_an_optimisation(folder, old, new, fault):
    assert any(fault in f for f in faults(folder, OPTIMISE.replace(old, new)))
