"""`dipper study` as a command: what it writes, makes once, reports, and what ends it. The simulator is a stand-in."""
import signal
import time

import h5py
import numpy as np
import pytest

from dipper_study.goal import COLUMNS
from dipper_study.report import page
from dipper_study.study_file import read_study
from world import STUDY, World

NAMED = """case: case
seeds: [1, 2, 3, 4]
parameters:
  bucket:
    plain: {}
    wide: {bodies.dipper: wide.stl}
"""


@pytest.fixture
def world(tmp_path):
    return World(tmp_path)


def test_a_study_leaves_a_table_a_page_and_its_runs(world):
    said = world.study()
    assert "3 points x 3 seeds" in said and "9 runs, 0 of them kept" in said and "1 rank each" in said
    assert "keep record: about 54 MB of disk" in said and " free" in said and "9 of 9 runs done, 0 failed" in said
    rows = world.rows()
    asked = [(r["machine.rake_angle_deg"], r["seed"]) for r in rows]
    assert asked == [(rake, seed) for rake in ("60", "62", "64") for seed in "123"]
    assert all(r["status"] == "complete" and float(r["payload_t"]) > 50 for r in rows)
    assert {(r["cpu_s"], r["wall_s"]) for r in rows} == {("6", "7")}  # of the summary, which has all starts of a run
    with h5py.File(world.out / "study.h5") as f:
        assert f["payload_t"].attrs["unit"] == "t" and f.attrs["study"] == STUDY
        np.testing.assert_array_equal(f["parameters/machine.rake_angle_deg"], np.repeat([60, 62, 64], 3))
        np.testing.assert_allclose(f["payload_t"], [float(r["payload_t"]) for r in rows], rtol=1e-5)
    run = world.out / "runs" / rows[0]["run"]
    assert (run / "record.h5").exists() and (run / "report/report.html").exists() and not (run / "dumps").exists()
    assert (world.out / "report.html").stat().st_size > 100_000


def test_nothing_is_run_twice(world):
    world.study()
    before = world.calls()
    assert len(before) == 9 and "9 of them kept" in world.study()
    world.study(STUDY.replace("[1, 2, 3]", "[2, 3, 4]").replace("64]", "64, 66]"))
    assert len(world.calls()) == 9 + 4 + 2
    world.study(STUDY.replace("rake_angle_deg: [60, 62, 64]", "rake_angle_deg: [62.0]"))
    assert len(world.calls()) == 15 + 3  # 62.0 is said otherwise; the stand-in's hash sees it


def test_nothing_of_an_earlier_study_stays_in_its_folder(world):
    world.study(STUDY.replace("[1, 2, 3]", "[1, 2]"))
    (world.out / "optimum.json").write_text("{}")
    (world.out / "runs/notes.txt").write_text("mine")
    before = (world.out / "runs/60_s1").readlink()
    world.study(STUDY.replace("[1, 2, 3]", "[1]").replace("[60, 62, 64]", "[60, 66]"))
    assert sorted(f.name for f in (world.out / "runs").iterdir()) == ["60_s1", "66_s1", "notes.txt"]
    assert (world.out / "runs/60_s1").readlink() == before and not (world.out / "optimum.json").exists()


def test_what_is_kept_is_a_setting_and_more_is_made_again(world):
    study = STUDY.replace("[60, 62, 64]", "[60]")
    world.study("keep: summary\n" + study)
    run = world.out / "runs" / world.rows()[0]["run"]
    assert not (run / "record.h5").exists() and (run / "report/metrics.json").exists()
    world.study("keep: summary\n" + study)
    assert len(world.calls()) == 3
    world.study("keep: all\n" + study)
    assert len(world.calls()) == 6 and (run / "dumps").exists() and "dump_every_s" not in world.calls()[-1]
    world.study(study)
    assert len(world.calls()) == 6


def test_failures_are_kept_apart_and_reported_at_the_end(world):
    world.say("fail", "2")
    said = world.study(status=3)
    assert said.count("status 3; see") == 3 and "6 of 9 runs done, 3 failed" in said
    assert [r["status"] for r in world.rows()] == ["complete", "failed", "complete"] * 3
    world.say("fail", "")
    world.study()
    assert len(world.calls()) == 12 and all(r["status"] == "complete" for r in world.rows())


def test_points_that_are_the_same_case_share_a_run_and_each_has_its_rows(world):
    said = world.study(NAMED.replace("[1, 2, 3, 4]", "[1, 2]").replace("plain: {}", "plain: {}\n    as_it_is: {}"))
    assert len(world.calls()) == 4 and "4 runs (points that are the same case share 2), 0 of them kept" in said
    assert "4 of 4 runs done" in said
    rows = world.rows()
    asked = [(name, seed) for name in ("plain", "as_it_is", "wide") for seed in "12"]
    assert [(r["bucket"], r["seed"]) for r in rows] == asked
    assert [r["payload_t"] for r in rows[:2]] == [r["payload_t"] for r in rows[2:4]]
    assert all((world.out / "runs" / r["run"] / "record.h5").exists() for r in rows)


def test_a_shared_run_that_fails_is_reported_for_each_of_its_points(world):
    world.say("fail", "2")
    said = world.study(NAMED.replace("wide: {bodies.dipper: wide.stl}", "as_it_is: {}"), status=3)
    assert len(world.calls()) == 4
    assert "study: plain, seed 2: run failed" in said and "study: as_it_is, seed 2: run failed" in said
    assert [r["seed"] for r in world.rows() if r["status"] == "failed"] == ["2", "2"]


def test_one_number_written_twice_has_no_slope(world):
    said = world.study(STUDY.replace("[60, 62, 64]", "[60, 60.0]"))
    assert "Warning" not in said and len(world.rows()) == 6
    rows = [{k: float(v) if k in COLUMNS else v for k, v in r.items()} for r in world.rows()]
    data = page(read_study(world.folder / "study.yaml"), rows)
    assert data["trends"] == [] and data["charts"][0]["numbers"] is None


def test_a_long_value_has_a_run_with_a_short_name(world):
    values = [f"[{classes}]" for classes in (", ".join(["{share: 0.2, size_m: 0.5}"] * 12), "ä" * 200, "ä" * 201)]
    world.study(NAMED.replace("  bucket:\n    plain: {}\n    wide: {bodies.dipper: wide.stl}",
                              f"  bodies.dipper: [{', '.join(values)}]"))
    runs = {r["run"] for r in world.rows()}
    assert len(runs) == 12 and all(len(name.encode()) < 120 and (world.out / "runs" / name).exists() for name in runs)


def test_values_that_differ_only_where_a_file_name_cannot_have_links_of_their_own(world):
    world.study(NAMED.replace("[1, 2, 3, 4]", "[1]")
                .replace("  bucket:\n    plain: {}\n    wide: {bodies.dipper: wide.stl}",
                         "  bodies.dipper: ['a b.stl', 'a  b.stl', a-b.stl, a, a_b]\n"
                         "  step: {c: {}, b_c: {machine.rake_angle_deg: 62}}"))
    links = {r["run"]: (world.out / "runs" / r["run"]).resolve() for r in world.rows()}
    assert len(links) == len(set(links.values())) == len(world.rows())


def test_every_point_is_checked_before_anything_starts(world):
    said = world.study(STUDY.replace("64]", "640]") + "  pile.toe_y_m: [1, 2]\n", status=2)
    assert "study.yaml:4: machine.rake_angle_deg: 640 is out of range" in said
    assert "study.yaml:5: pile.toe_y_m: unknown key" in said and "2 errors" in said
    assert not world.calls() and not world.out.exists()


def test_an_out_that_is_a_file_starts_nothing(world):
    file = world.out.with_name("file")
    file.write_text("in the way")
    said = world.study(STUDY, "--out", str(file), status=2)
    assert f"{file}: cannot be written" in said and "choose another --out" in said
    assert not world.calls()


def test_a_file_where_the_links_to_the_runs_go_is_reported(world):
    world.out.mkdir()
    (world.out / "runs").write_text("notes")
    printed = world.study(status=2)
    assert f"{world.out / 'runs'}: File exists" in printed and "Traceback" not in printed


def test_an_output_that_nobody_reads_ends_it_without_a_word(world):
    study = world.start()
    study.stdout.close()
    study.stdout = None
    assert study.communicate(timeout=60)[1] == "" and study.returncode == 128 + signal.SIGPIPE


def test_bad_usage_is_2(world):
    world.study("case: case\n", status=2)
    world.study(STUDY, "--outt", status=2)
    assert "for executor: slurm" in world.study(STUDY, "--detach", status=2)


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_an_end_from_outside_leaves_no_run_and_the_same_command_goes_on(world, number):
    world.say("slow", "0.4")
    study = world.start()
    until = time.monotonic() + 60
    while len(world.calls()) < 3:
        assert study.poll() is None and time.monotonic() < until
        time.sleep(0.02)
    study.send_signal(number)
    out, err = study.communicate(timeout=30)
    until = time.monotonic() + 20
    while world.left():
        assert time.monotonic() < until
        time.sleep(0.1)
    if number != signal.SIGKILL:
        assert study.returncode == 4 and "continues from the finished runs" in err
        assert {r["status"] for r in world.rows()} == {"complete", "not made"}
    begun = len(world.calls())
    assert begun < 9
    world.say("slow", "0")
    world.study()
    assert 9 <= len(world.calls()) <= 9 + 2 and len(world.rows()) == 9


@pytest.mark.parametrize("edit", [lambda file: file.write_text("a new one\n"), lambda file: file.unlink()])
def test_the_text_kept_with_the_answer_is_that_of_what_was_run(world, edit):
    world.say("slow", "0.4")
    study = world.start()
    until = time.monotonic() + 60
    while not world.calls():
        assert study.poll() is None and time.monotonic() < until
        time.sleep(0.02)
    edit(world.folder / "study.yaml")
    _, err = study.communicate(timeout=60)
    assert study.returncode == 0, err
    with h5py.File(world.out / "study.h5") as f:
        assert f.attrs["study"] == STUDY


def test_two_settings_are_compared_seed_by_seed(world):
    world.study(NAMED)
    rows = [{k: float(v) if k in COLUMNS else v for k, v in r.items()} for r in world.rows()]
    data = page(read_study(world.folder / "study.yaml"), rows)
    payload = next(c for c in data["comparisons"] if c["column"] == "payload_t")
    # The seeds scatter by 3 t, their pairs by 0.7 t.
    assert payload["shown"] and payload["low"] < 5 < payload["high"] and payload["sd"] < 1.5
    assert payload["confidence"] > 0.99
    force = next(c for c in data["comparisons"] if c["column"] == "dig_force_mean_MN")
    assert not force["shown"] and force["confidence"] == 0.5


def test_runs_that_end_before_the_door_opens_are_unfinished_and_warnings_are_reported(world):
    world.say("short", "2")
    world.say("warnings", "pass 1: the ropes are slack in SEED % of the dig\n")
    said = world.study()
    assert "study: warning: 3 of 9 runs are unfinished: they end before the load is dumped" in said
    assert "study: warning: in 9 of 9 runs: pass 1: the ropes are slack in 1 to 3 % of the dig\n" in said
    rows = world.rows()
    assert [r["status"] for r in rows] == ["complete", "unfinished", "complete"] * 3
    assert {r["warnings"] for r in rows} == {"1"}
    assert (world.out / "runs" / rows[1]["run"]).exists()
    numbers = [{**r, **{c: float(r[c] or "nan") for c in COLUMNS}} for r in rows[:2]]
    data = page(read_study(world.folder / "study.yaml"), numbers, warnings=["a"])
    assert data["warnings"] == ["a"] and (data["counts"]["complete"], data["counts"]["unfinished"]) == (1, 1)
    assert sum(point["figures"]["payload_t"]["n"] for point in data["points"]) == 1


def test_a_cache_that_cannot_be_written_is_reported_before_a_run(world):
    world.environment["XDG_CACHE_HOME"] = "/proc/none"
    assert "set XDG_CACHE_HOME to a folder that can be written" in world.study(status=2)
    assert not world.calls()
