"""Where runs are made: here, as many at a time as the cores take, or through Slurm."""
import os

from dipper_run.kept_runs import KeptRuns

from .slurm import SlurmQueue


class LocalExecutor:
    """`jobs` runs at a time of `ranks` each; by default as many as fill the cores."""

    def __init__(self, study, program):
        cores = len(os.sched_getaffinity(0))
        self.at_once = study.jobs or max(1, cores // study.ranks)
        self.statement = f"{self.at_once} at a time, {study.ranks} rank{'s' * (study.ranks > 1)} each, on {cores} cores"
        self._runs = KeptRuns(program, self.at_once)
        self.kept = self._runs.kept

    def make(self, jobs, progress):
        """[(job, RunFailed)] of those that failed; an interrupt ends all runs under way and is raised."""
        failures = []

        def on_end(job, error):
            progress.ended(error)
            if error:
                failures.append((job, error))

        self._runs.make(jobs, on_end)
        return failures


def executor_of(study, program, out):
    return SlurmQueue(study, program, out) if study.executor == "slurm" else LocalExecutor(study, program)
