"""Runs that are made once, with a program that stands in for `dipper`: a new run is interrupted, a resumed one ends."""
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from dipper_run.kept_runs import HEAVY, Job, KeptRuns

PROGRAM = """#!/bin/sh
echo "$@" >> CALLS
run=$(echo "$@" | sed 's/.*--out //; s/ .*//')
case "$*" in
*--resume*) exit 0 ;;
esac
mkdir -p "$run/checkpoints/1" "$run/dumps"
touch "$run/record.h5" "$run/events.lcmlog" "$run/events-7.lcmlog"
exit 4
"""


@pytest.fixture
def made(tmp_path):
    """made(drop): makes the run; returns what was said of it, the errors, and whether the last start went on."""
    program, calls = tmp_path / "dipper", tmp_path / "calls"
    program.write_text(PROGRAM.replace("CALLS", str(calls)))
    program.chmod(0o755)

    def make(drop):
        runs, job, errors = KeptRuns(program, 1), Job(tmp_path / "entry", (), "a run", drop), []
        runs.make([job], lambda _, error: errors.append(error))
        return runs.kept(job.folder, drop), errors[0], calls.read_text().splitlines()[-1].endswith("--resume")

    return make


def test_a_run_goes_on_from_its_checkpoint(made):
    facts, error, resumed = made(HEAVY)
    assert facts is None and "status 4" in str(error) and not resumed
    facts, error, resumed = made(HEAVY)
    assert facts["dropped"] == list(HEAVY) and error is None and resumed


def test_recordings_of_every_segment_are_dropped(made, tmp_path):
    made(HEAVY), made(HEAVY)
    assert [f.name for f in (tmp_path / "entry/run").iterdir()] == ["record.h5"]


@pytest.mark.parametrize("first, then, goes_on", [(HEAVY, (), False), ((), HEAVY, True), ((), (), True)])
def test_one_that_keeps_less_than_is_wanted_does_not(made, first, then, goes_on):
    made(first)
    assert made(then)[2] == goes_on


def test_an_interrupt_while_jobs_are_handed_out_ends_the_run_under_way(tmp_path, monkeypatch):
    program, started = tmp_path / "dipper", tmp_path / "started"
    program.write_text(f"#!/bin/sh\ntouch {started}\nexec sleep 30\n")
    program.chmod(0o755)
    submit, handed_out = ThreadPoolExecutor.submit, []

    def interrupted(*words):
        while handed_out and not started.exists():
            time.sleep(0.01)
        if handed_out:
            raise KeyboardInterrupt
        handed_out.append(words)
        return submit(*words)

    monkeypatch.setattr(ThreadPoolExecutor, "submit", interrupted)
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        KeptRuns(program, 2).make([Job(tmp_path / name, (), name, HEAVY) for name in ("first", "second")], print)
    assert time.monotonic() - began < 15
