"""Runs by a program that stands in for `dipper`: kept, found again, gone on with."""
import stat
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

import pytest

from dipper_gap.__main__ import usable
from dipper_gap.simulation.effects import read_catalogue
from dipper_gap.simulation.simulator import EMPTY, DipperSimulator, RunFailed, request
from effect_files import FINES, FRICTION, GAIN

# Writes an observed folder whose truck masses show what was asked; fails for a seed of 13.
PROGRAM = '''#!/usr/bin/python3
import hashlib, json, pathlib, sys
words = sys.argv[1:]
here = pathlib.Path(__file__).parent
if words[0] == "check":
    if words[1] == "--json":
        case = pathlib.Path(words[2])
        said = (case / "case.yaml").read_bytes() + (case.parent / "rock.stl").read_bytes()
        print(json.dumps({"case_hash": hashlib.sha256(said).hexdigest(), "source_hash": (here / "sources").read_text(),
                          "cost": {"settle_cpu_s": 1, "dig_cpu_s": 4},
                          "values": {"machine.drives": "limited" if b"limited" in said else "prescribed"}}))
    if "effects.fines=0.15" in words: print("too many fines"); sys.exit(2)
    sys.exit(0)
log = here / "calls"
with open(log, "a") as f: f.write(" ".join(words) + "\\n")
out = pathlib.Path(words[words.index("--out") + 1])
seed = int(words[words.index("--seed") + 1]) if "--seed" in words else 0
if seed == 13: print("no rock"); sys.exit(3)
sets = dict(words[i + 1].split("=") for i, w in enumerate(words) if w == "--set")
folder = out / "observed" if words[0] == "run" else out
folder.mkdir(parents=True)
(out / "dumps").mkdir(exist_ok=True)
mass = 80 + seed + 10 * float(sets.get("effects.fines", 0)) + 100 * float(sets.get("observation.scale_gain", 0))
mass += float(sets.get("effects.crowd_friction", 0))
(folder / "channels.yaml").write_text("truck_mass_t: {unit: t, role: response, sigma: 0, common_sigma: 0}\\n")
(folder / "passes.csv").write_text(f"pass,t_start_s,t_end_s,truck_mass_t\\n1,0,10,{mass}\\n")
'''


@pytest.fixture
def world(tmp_path):
    program = tmp_path / "dipper"
    program.write_text(PROGRAM)
    (tmp_path / "sources").write_text("as they are")
    program.chmod(program.stat().st_mode | stat.S_IXUSR)
    case = tmp_path / "cases" / "one"
    case.mkdir(parents=True)
    (tmp_path / "cases" / "rock.stl").write_text("solid")
    (case / "case.yaml").write_text("# a comment\nseed: 1\nrock:\n  mesh: ../rock.stl  # kept\n")
    effects = tmp_path / "own" / "effects"
    effects.mkdir(parents=True)
    (tmp_path / "own" / "case.yaml").write_text("")
    (effects / "fines.yaml").write_text(FINES)
    (effects / "scale_gain.yaml").write_text(GAIN)
    (effects / "crowd_friction.yaml").write_text(FRICTION)
    catalogue = {n: e for n, e in read_catalogue(tmp_path / "own").items() if (effects / f"{n}.yaml").exists()}

    def simulator():
        return DipperSimulator(case, catalogue, program, tmp_path / "cache")

    return simulator, catalogue, case, tmp_path


def masses(results):
    return [m.passes[0].truck_mass_t for m in results]


def calls(folder):
    file = folder / "calls"
    return file.read_text().splitlines() if file.exists() else []


def test_runs_are_made_once_and_observations_reuse_them(world):
    simulator, catalogue, _, folder = world
    asked = [request({}, 1, catalogue), request({"fines": 0.2}, 1, catalogue),
             request({"scale_gain": 0.1}, 1, catalogue), request({}, 2, catalogue),
             request({"crowd_friction": 0.25}, 1, catalogue)]
    assert [r.how for r in asked] == ["run", "run", "observe", "run", "replay"]
    assert simulator().plan(asked)[:2] == (3, 0)
    said = []
    assert masses(simulator().run(asked, said.append)) == [81, 83, 90, 82, 80.25]
    assert len(said) == 3 and "of 3" in said[0]
    assert sum(c.startswith("run ") for c in calls(folder)) == 3
    assert sum(c.startswith("observe ") for c in calls(folder)) == 1
    assert sum(c.startswith("replay ") and "--side mbs" in c for c in calls(folder)) == 1
    before = len(calls(folder))
    assert masses(simulator().run(asked, said.append)) == [81, 83, 90, 82, 80.25]
    assert len(calls(folder)) == before
    todo, kept, each = simulator().plan(asked)
    assert (todo, kept) == (0, 3) and each > 0


def test_another_machine_needs_a_run_where_the_drives_are_limited(world):
    simulator, catalogue, case, folder = world
    (case / "case.yaml").write_text("machine: {drives: limited}\n")
    asked = [request({"crowd_friction": 0.25}, 1, catalogue), request({"scale_gain": 0.1}, 1, catalogue)]
    assert simulator().plan(asked)[:2] == (2, 0) and len(simulator().needed(asked)) == 2
    assert masses(simulator().run(asked, str)) == [81.25, 90]
    assert not [c for c in calls(folder) if c.startswith("replay ")]


def test_instruments_and_forces_together_need_no_run(world):
    simulator, catalogue, _, folder = world
    both = request({"scale_gain": 0.1, "crowd_friction": 0.25}, 1, catalogue)
    assert both.how == "replay" and request({"scale_gain": 0.1, "fines": 0.2}, 1, catalogue).how == "run"
    simulator().run([both], lambda text: None)
    again = [c for c in calls(folder) if c.startswith("replay ")]
    assert len(again) == 1 and "effects.scale_gain=0.1" in again[0] and "effects.crowd_friction=0.25" in again[0]


def test_two_analyses_at_once_make_a_run_once(world):
    simulator, catalogue, _, folder = world
    asked = [request({}, s, catalogue) for s in (1, 2, 3)] + [request({"scale_gain": 0.1}, 1, catalogue)]
    with ThreadPoolExecutor(3) as pool:
        results = list(pool.map(lambda s: s.run(asked, lambda text: None), [simulator() for _ in range(3)]))
    assert [masses(r) for r in results] == [[81, 82, 83, 90]] * 3
    assert sorted(c.split()[0] for c in calls(folder)) == ["observe", "run", "run", "run"]


def test_the_empty_cycle_is_run_once_and_observed_after(world):
    simulator, _, _, folder = world
    for _ in range(2):
        simulator().run([EMPTY], lambda text: None)
    made = calls(folder)
    assert [c.split()[0] for c in made] == ["run", "observe"] and "--no-rock" in made[0]


def test_how_long_is_guessed_from_the_size_before_the_first_run(world):
    simulator, catalogue, _, _ = world
    s = simulator()
    assert s.plan([request({}, 1, catalogue)]) == (1, 0, pytest.approx(5.0))


def test_an_effect_the_case_cannot_take_is_left_out(world):
    simulator, catalogue, _, _ = world
    kept, left_out = usable(catalogue, simulator())
    assert list(kept) == ["crowd_friction", "scale_gain"] and "fines" in left_out[0]


def test_effects_are_checked_together_unless_they_change_the_same_key(world, monkeypatch):
    simulator, catalogue, _, _ = world
    asked = []
    monkeypatch.setattr("dipper_gap.__main__.check", lambda program, case, some: asked.append(some) or "")
    alike = replace(catalogue["fines"], name="more_fines")
    kept, left_out = usable({**catalogue, "more_fines": alike}, simulator())
    assert len(kept) == 4 and not left_out
    assert len(asked) == 4 and sum(map(len, asked)) == 8  # two strengths of fines and of more of them, one a set
    for some in asked:
        keys = [key for n, _ in some for key, *_ in (alike if n == "more_fines" else catalogue[n]).overlay]
        assert len(set(keys)) == len(keys)


def test_what_a_case_cannot_take_is_found_among_many_by_halves(world, monkeypatch):
    simulator, catalogue, _, _ = world
    many = {f"e{k}": replace(catalogue["fines"], name=f"e{k}", overlay=((f"rock.key{k}", "add", 1.0),))
            for k in range(24)}
    asked = []

    def check(program, case, some):
        asked.append(some)
        return "no such rock" if "e13" in dict(some) else ""

    monkeypatch.setattr("dipper_gap.__main__.check", check)
    kept, left_out = usable(many, simulator())
    assert set(many) - set(kept) == {"e13"} and "no such rock" in left_out[0] and len(left_out) == 1
    assert len(asked) <= 12  # 48 when asked one by one


def test_a_changed_mesh_is_another_case(world):
    simulator, catalogue, _, folder = world
    simulator().run([request({}, 1, catalogue)], str)
    (folder / "cases" / "rock.stl").write_text("another")
    assert simulator().plan([request({}, 1, catalogue)])[:2] == (1, 0)


def test_a_program_of_other_sources_makes_its_own_runs(world):
    simulator, catalogue, _, folder = world
    simulator().run([request({}, 1, catalogue)], str)
    assert simulator().plan([request({}, 1, catalogue)])[:2] == (0, 1)
    (folder / "sources").write_text("edited")
    assert simulator().plan([request({}, 1, catalogue)])[:2] == (1, 0)


@pytest.mark.parametrize("damaged", ["run/observed/passes.csv", "manifest.json"])
def test_a_damaged_run_is_never_used(world, capsys, damaged):
    simulator, catalogue, _, folder = world
    asked = [request({}, 1, catalogue), request({"scale_gain": 0.1}, 1, catalogue)]
    assert masses(simulator().run(asked, str)) == [81, 90]
    file = simulator().folder(asked[0]) / damaged
    file.write_bytes(file.read_bytes().replace(b"8", b"9", 1)[:-3])
    assert simulator().plan(asked)[:2] == (1, 0)
    assert f"{file} has changed since it was written; moved to" in capsys.readouterr().err
    assert masses(simulator().run(asked, str)) == [81, 90]
    assert len(list((folder / "cache").glob("*.damaged-1"))) == 1


def test_a_damaged_observation_is_never_used(world, capsys):
    simulator, catalogue, _, folder = world
    asked = [request({"scale_gain": 0.1}, 1, catalogue)]
    assert masses(simulator().run(asked, str)) == [90]
    file = simulator().folder(asked[0]) / "observed" / "passes.csv"
    file.write_text(file.read_text().replace("90", "91"))
    assert masses(simulator().run(asked, str)) == [90]
    assert "made again" in capsys.readouterr().err
    assert [c.split()[0] for c in calls(folder)] == ["run", "observe", "observe"]


def test_a_failed_run_is_named_and_the_others_are_kept(world):
    simulator, catalogue, _, _ = world
    asked = [request({}, s, catalogue) for s in (1, 13)]
    with pytest.raises(RunFailed, match="seed 13.*status 3"):
        simulator().run(asked, str)
    assert simulator().plan(asked)[:2] == (1, 1)
