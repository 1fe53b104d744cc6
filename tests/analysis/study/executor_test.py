"""Runs of several ranks, several at a time, keep to cores of their own."""
from dipper_run.kept_runs import Job, KeptRuns
from dipper_study.executor import shares


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
