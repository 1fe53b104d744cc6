"""Runs of several ranks, several at a time, keep to cores of their own; the remaining time is that of whole runs."""
import io
import time

from dipper_run.kept_runs import Job, KeptRuns
from dipper_study.executor import shares
from dipper_study.progress import Progress


def test_runs_of_several_ranks_share_no_core():
    assert shares(range(5), 2, 2) == ["0,1", "2,3"]
    assert shares(range(4), 4, 1) == shares(range(4), 1, 4) == shares(range(2), 2, 2) == []


def test_a_run_is_given_its_cores(tmp_path):
    program = tmp_path / "dipper"
    program.write_text("#!/bin/sh\nwhile [ $1 != --out ]; do shift; done; mkdir -p $2\n"
                       "sleep 0.3; echo $OMPI_MCA_hwloc_base_cpu_list > $2/cores\n")
    program.chmod(0o755)
    jobs = [Job(tmp_path / f"entry{k}", (), str(k)) for k in range(4)]
    errors = []
    KeptRuns(program, 2, ["0,1", "2,3"]).make(jobs, lambda _, error: errors.append(error))
    given = [(job.folder / "run/cores").read_text().strip() for job in jobs]
    assert errors == [None] * 4 and sorted(given) == ["0,1", "0,1", "2,3", "2,3"]


def test_a_run_that_is_resumed_says_nothing_of_the_remaining_time(tmp_path, monkeypatch):
    now = 0.0
    monkeypatch.setattr(time, "monotonic", lambda: now)
    jobs = [Job(tmp_path / f"entry{k}", (), str(k)) for k in range(4)]
    (jobs[0].run / "checkpoints/1").mkdir(parents=True)
    (jobs[0].run / "record.h5").touch()
    progress = Progress(5, jobs, 100.0, 1, io.StringIO())
    now = 5.0
    progress.ended(jobs[0])
    assert progress.left_s() == 3 * 100
    now = 95.0
    progress.ended(jobs[1])
    assert progress.left_s() == 2 * 95 and progress.done == 3
