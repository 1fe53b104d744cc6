"""Where runs are made: here, as many at a time as the cores take, or through Slurm."""
import os

from dipper_run.kept_runs import KeptRuns

from .slurm import SlurmQueue


class LocalExecutor:
    """`jobs` runs at a time of `ranks` each; by default as many as fill the cores."""

    def __init__(self, study, program):
        cores = sorted(os.sched_getaffinity(0))
        self.at_once = study.jobs or max(1, len(cores) // study.ranks)
        self.statement = (f"{self.at_once} at a time, {study.ranks} rank{'s' * (study.ranks > 1)} each, "
                          f"on {len(cores)} cores")
        self._runs = KeptRuns(program, self.at_once, shares(cores, self.at_once, study.ranks))
        self.kept = self._runs.kept

    def make(self, jobs, progress):
        """[(job, RunFailed)] of those that failed; an interrupt ends all runs under way and is raised."""
        failures = []

        def on_end(job, error):
            progress.ended(job, error)
            if error:
                failures.append((job, error))

        self._runs.make(jobs, on_end)
        return failures


def shares(cores, at_once, ranks):
    """Cores of each run at a time; none where a single rank moves freely, or there are not enough for all."""
    if ranks == 1 or at_once == 1 or at_once * ranks > len(cores):
        return []
    return [",".join(map(str, cores[k * ranks:(k + 1) * ranks])) for k in range(at_once)]


def executor_of(study, program, out):
    return SlurmQueue(study, program, out) if study.executor == "slurm" else LocalExecutor(study, program)
