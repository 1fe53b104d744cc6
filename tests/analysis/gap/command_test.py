"""`dipper gap` as a command: what ends it, and how. The simulator is a script that would run for a minute."""
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import synthetic
from dipper_gap.readings.measured import write_measured
from dipper_run.program import program

ANALYSIS = Path(__file__).resolve().parents[3] / "analysis"
SLOW = """#!/usr/bin/python3
import os, pathlib, sys, time
if sys.argv[1] in ("check", "effects", "phases") and "--set" not in sys.argv: os.execv("REAL", sys.argv)
if sys.argv[1] == "run":
    folder = pathlib.Path(__file__).parent / "started"
    folder.mkdir(exist_ok=True)
    (folder / str(time.monotonic_ns())).write_text(sys.argv[sys.argv.index("--seed") + 1])
    try: time.sleep(60)
    except KeyboardInterrupt: sys.exit(4)
"""
CASE = f"""format: 1
title: the mine
include: {ANALYSIS.parent}/cases/screening/case.yaml
machine: {{motion: motion.csv}}
"""


@pytest.fixture
def words(tmp_path):
    slow = tmp_path / "dipper"
    slow.write_text(SLOW.replace("REAL", program()))
    slow.chmod(0o755)
    (tmp_path / "case").mkdir()
    (tmp_path / "case" / "case.yaml").write_text(CASE)
    shutil.copy(synthetic.MOTION, tmp_path / "case/motion.csv")
    write_measured(synthetic.with_noise(synthetic.run({}, seed=1), 1), tmp_path / "mine")
    return [sys.executable, "-B", "-m", "dipper_gap", str(tmp_path / "case"), "--measured", str(tmp_path / "mine"),
            "--out", str(tmp_path / "out")]


def start(words, folder):
    environment = {**os.environ, "PYTHONPATH": f"{ANALYSIS}/gap:{ANALYSIS}/runs", "DIPPER": str(folder / "dipper"),
                   "XDG_CACHE_HOME": str(folder / "cache")}
    return subprocess.Popen(words, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def left(folder):
    """Simulators of this test that still run."""
    found = subprocess.run(["pgrep", "-f", str(folder / "dipper")], capture_output=True, text=True)
    return found.stdout.split()


def wait_for_runs(gap, folder, number):
    """Until the analysis has started so many."""
    until = time.monotonic() + 60
    while sum(f.stat().st_size > 0 for f in folder.glob("started/*")) < number:  # each with its seed in it
        assert gap.poll() is None and time.monotonic() < until
        time.sleep(0.05)


def test_an_interrupt_ends_it_within_seconds_and_leaves_nothing(words, tmp_path):
    gap = start(words, tmp_path)
    wait_for_runs(gap, tmp_path, 2)
    asked = time.monotonic()
    gap.send_signal(signal.SIGINT)
    out, err = gap.communicate(timeout=20)
    assert gap.returncode == 4 and time.monotonic() - asked < 10
    assert "continues from the finished runs" in err
    assert "runs, 0 of them kept" in out
    assert not left(tmp_path) and not (tmp_path / "out").exists()


def test_a_kill_leaves_no_run(words, tmp_path):
    gap = start(words, tmp_path)
    wait_for_runs(gap, tmp_path, 2)
    gap.kill()
    gap.communicate()
    until = time.monotonic() + 20
    while left(tmp_path):
        assert time.monotonic() < until
        time.sleep(0.05)


def test_a_case_with_another_number_of_passes_starts_nothing(words, tmp_path):
    rows = (tmp_path / "case" / "motion.csv").read_text().splitlines()
    (tmp_path / "case" / "motion.csv").write_text("\n".join(rows[:3 + 2 * 50]) + "\n")
    gap = start(words, tmp_path)
    _, err = gap.communicate(timeout=60)
    assert gap.returncode == 2 and "3 measured, and the case's motion digs 1" in err
    assert not (tmp_path / "started").exists()


def test_a_sigma_of_0_and_another_motion_are_questioned_before_the_first_run(words, tmp_path):
    channels, motion = tmp_path / "mine" / "channels.yaml", tmp_path / "case" / "motion.csv"
    channels.write_text(channels.read_text().replace("sigma: 25,", "sigma: 0,", 1))
    rows = [line.split(",") for line in motion.read_text().splitlines()]
    motion.write_text("\n".join(",".join(r[:3] + [str(float(r[3]) + 20)] + r[4:] if r[0][0].isdigit() else r)
                                for r in rows) + "\n")
    gap = start(words, tmp_path)
    wait_for_runs(gap, tmp_path, 1)
    gap.send_signal(signal.SIGINT)
    out, _ = gap.communicate(timeout=20)
    before = out[:out.index("runs, 0 of them kept")]
    assert "hoist_force_kN: sigma is 0" in before
    assert "swing_rad is 0.35 rad (rms) off" in before and "hoist_m is" not in before


def test_a_case_that_is_no_utf8_is_reported_with_its_line(words, tmp_path):
    case = tmp_path / "case" / "case.yaml"
    case.write_bytes(case.read_bytes() + b"title: caf\xe9\n")
    gap = start(words, tmp_path)
    _, err = gap.communicate(timeout=60)
    assert gap.returncode == 2 and f"{case}:5: holds a byte that is not UTF-8" in err and "Traceback" not in err


def test_an_out_that_is_a_file_starts_nothing(words, tmp_path):
    (tmp_path / "file").write_text("in the way")
    gap = start([*words, "--out", str(tmp_path / "file")], tmp_path)
    _, err = gap.communicate(timeout=60)
    assert gap.returncode == 2 and f"{tmp_path / 'file'}: cannot be written" in err and "--out" in err
    assert not (tmp_path / "started").exists() and (tmp_path / "file").read_text() == "in the way"


def test_an_out_that_holds_the_case_starts_nothing(words, tmp_path):
    before = (tmp_path / "case/case.yaml").read_text()
    gap = start([*words, "--out", str(tmp_path)], tmp_path)
    _, err = gap.communicate(timeout=60)
    assert gap.returncode == 2 and f"--out: {tmp_path / 'case/case.yaml'} is the case; choose another --out" in err
    assert not (tmp_path / "started").exists() and (tmp_path / "case/case.yaml").read_text() == before


def test_bad_measurements_start_nothing(words, tmp_path):
    passes = tmp_path / "mine" / "passes.csv"
    passes.write_text(passes.read_text().replace("\n2,", "\n2,-"))
    gap = start(words, tmp_path)
    _, err = gap.communicate(timeout=30)
    assert gap.returncode == 2 and f"{passes}:3: t_start_s" in err and err.strip().endswith("error")
    assert not (tmp_path / "started").exists()


def test_a_reference_without_the_channels_starts_nothing(words, tmp_path):
    before = synthetic.with_noise(synthetic.run({}, seed=2), 2)
    write_measured(before.seen_by([n for n in before.channels if n != "crowd_force_kN"]), tmp_path / "then")
    gap = start([*words, "--reference", str(tmp_path / "then")], tmp_path)
    _, err = gap.communicate(timeout=60)
    assert gap.returncode == 2 and f"{tmp_path / 'then/channels.yaml'}: crowd_force_kN: not there" in err
    gap = start([*words, "--plan", "--reference", str(tmp_path / "then")], tmp_path)
    _, err = gap.communicate(timeout=60)
    assert gap.returncode == 2 and f"{tmp_path / 'then/channels.yaml'}: crowd_force_kN: not there" in err
    assert not (tmp_path / "started").exists()


def test_a_plan_needs_no_measurements_and_an_analysis_does(words, tmp_path):
    alone = [w for w in words if w not in ("--measured", str(tmp_path / "mine"))]
    gap = start(alone, tmp_path)
    _, err = gap.communicate(timeout=60)
    assert gap.returncode == 2 and "--measured: not given" in err and not (tmp_path / "started").exists()
    gap = start([*alone, "--plan", "--jobs", "1"], tmp_path)
    wait_for_runs(gap, tmp_path, 1)
    gap.send_signal(signal.SIGINT)
    out, _ = gap.communicate(timeout=60)
    assert gap.returncode == 4 and "instruments are assumed" in out and "1 at a time" in out
    assert len(list(tmp_path.glob("started/*"))) == 1


def test_masses_alone_are_refused_before_a_run_unless_asked_for(words, tmp_path):
    mine = tmp_path / "mine"
    (mine / "signals.csv").unlink()
    channels = (mine / "channels.yaml").read_text().splitlines()
    (mine / "channels.yaml").write_text("\n".join(c for c in channels if c.startswith("truck_mass_t")) + "\n")
    gap = start(words, tmp_path)
    _, said = gap.communicate(timeout=60)
    assert gap.returncode == 2 and "forces: neither hoist_force_kN nor crowd_force_kN is there" in said
    assert "--masses-only" in said and not (tmp_path / "started").exists()
    gap = start([*words, "--masses-only"], tmp_path)
    wait_for_runs(gap, tmp_path, 1)
    gap.send_signal(signal.SIGINT)
    gap.communicate(timeout=60)
    assert gap.returncode == 4


def with_base(folder, *lines):
    """The case, with these lines in a file between it and the one it includes."""
    (folder / "case/base.yaml").write_text("\n".join((*CASE.splitlines()[:3], "machine: {motion: motion.csv}", *lines)))
    (folder / "case/case.yaml").write_text("format: 1\ntitle: the mine\ninclude: base.yaml\n")


@pytest.mark.parametrize("line, said", [
    ("effects: {fines: 0.1}", "case.yaml: effects: the case has some already (fines)"),
    ("observation: {rate_Hz: 5}", "a reading every 1 s, and the case's every 0.2 s")])
def test_what_a_case_includes_is_seen(words, tmp_path, line, said):
    with_base(tmp_path, line)
    (tmp_path / "file").write_text("in the way")
    gap = start([*words, "--out", str(tmp_path / "file")], tmp_path)
    out, err = gap.communicate(timeout=60)
    assert gap.returncode == 2 and said in out + err and "Traceback" not in err
    assert not (tmp_path / "started").exists()


def test_the_seed_and_motion_of_what_a_case_includes_are_taken(words, tmp_path):
    with_base(tmp_path, "seed: 5")
    shutil.move(tmp_path / "case/base.yaml", tmp_path / "base.yaml")
    shutil.move(tmp_path / "case/motion.csv", tmp_path / "motion.csv")
    (tmp_path / "case/case.yaml").write_text("format: 1\ntitle: the mine\ninclude: ../base.yaml\n")
    gap = start(words, tmp_path)
    wait_for_runs(gap, tmp_path, 2)
    gap.send_signal(signal.SIGINT)
    gap.communicate(timeout=20)
    assert gap.returncode == 4
    assert sorted(f.read_text() for f in tmp_path.glob("started/*")) == ["5", "6"]


def test_a_case_whose_operator_plans_is_refused(words, tmp_path):
    case = ANALYSIS.parent / "cases/quick/case.yaml"
    (tmp_path / "case/case.yaml").write_text(f"format: 1\ntitle: the mine\ninclude: {case}\n")
    gap = start(words, tmp_path)
    _, err = gap.communicate(timeout=60)
    assert gap.returncode == 2 and "machine.operator: is plan" in err
    assert not (tmp_path / "started").exists() and not (tmp_path / "out").exists()
