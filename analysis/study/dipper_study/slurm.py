"""Runs through Slurm: a job array; each task is a `dipper_run.worker` on a node, which sees the same cache.

What was submitted is in OUT/slurm/N: jobs.json, and a log and an answer a task. A task without an answer whose run is
not kept and that the queue no longer knows was lost (killed, out of time, its node gone): it is submitted again,
`retries` times. One with an error has failed.
"""
import dataclasses
import hashlib
import json
import subprocess
import sys
import time
from pathlib import Path

import dipper_run
from dipper_run.findings import BadInput
from dipper_run.kept_runs import KeptRuns, RunFailed
from dipper_run.program import ProgramFailed

LOOK_S = 1.0
PATIENCE_S = 120.0   # with a controller that does not answer, and with jobs that are to end
WARNING_S = 60       # before the time limit, for a checkpoint
ARRAY = 1000         # tasks an array: what a controller takes unless configured otherwise
PACKAGES = Path(dipper_run.__file__).resolve().parents[1]


class Detached(Exception):
    """Submitted; nobody watches."""


class SlurmQueue:
    """The executor for `executor: slurm`."""

    detach = False

    def __init__(self, study, program, out):
        self._study, self._program, self._folder = study, str(program), Path(out).resolve() / "slurm"
        self._name = "dipper-" + hashlib.sha256(str(self._folder).encode()).hexdigest()[:12]
        try:
            cpus = _cores(study.slurm.partition)
        except ProgramFailed as e:
            raise BadInput([f"{study.file}: executor: slurm, but {e}; a machine that submits to Slurm"]) from e
        if not cpus:
            raise BadInput([f"{study.file}: slurm.partition: {study.slurm.partition or 'none'}: has no cores; one "
                            "that sinfo lists"])
        self.at_once = study.slurm.at_once or max(1, cpus // study.ranks)
        self.statement = (f"{self.at_once} at a time, {study.ranks} rank{'s' * (study.ranks > 1)} each, through Slurm "
                          f"({cpus} cores)")
        self.kept = KeptRuns(program, 1).kept

    def make(self, jobs, progress):
        """[(job, RunFailed)]; an interrupt cancels what was submitted and is raised."""
        todo, failures, tries = {str(job.folder): job for job in jobs}, [], {}
        for answer in self._folder.glob("*/[0-9]*.json"):
            answer.unlink()  # of an earlier call: what failed then is tried again
        try:
            while True:
                alive = self._alive()  # before the answers: what is gone has left its own
                again = self._settle(todo, alive, tries, failures, progress)
                if not todo:
                    return failures
                if again:
                    self._submit(again)
                    tries.update((str(job.folder), tries.get(str(job.folder), 0) + 1) for job in again)
                if self.detach:
                    raise Detached(f"{len(todo)} runs are with Slurm")
                states = list(alive.values())
                progress.show(f", {states.count('RUNNING')} running, {states.count('PENDING')} pending")
                time.sleep(LOOK_S)
        except KeyboardInterrupt:
            self.cancel()
            raise

    def cancel(self):
        """Ends all that was submitted for this study's folder; returns how many tasks. Waits until they are gone."""
        count = len(self._alive())
        if count:
            _ask("scancel", "--name", self._name)
            until = time.monotonic() + PATIENCE_S
            while _ask("squeue", "-h", "-n", self._name) and time.monotonic() < until:
                time.sleep(LOOK_S)
        return count

    def _settle(self, todo, alive, tries, failures, progress):
        """Takes out of `todo` what is done or has failed; returns what is to be submitted, also again."""
        errors, again = self._errors(), []
        for folder, job in list(todo.items()):
            if folder in alive:
                continue
            lost, error = tries.get(folder, 0), None
            if not self.kept(job.folder, job.drop):
                if folder in errors:
                    error = RunFailed(errors[folder])
                elif lost <= self._study.slurm.retries:
                    again.append(job)
                    continue
                else:
                    error = RunFailed(f"run lost {lost} times ({job.label}): killed, out of time, or its node gone; "
                                      f"logs in {self._folder}")
            del todo[folder]
            progress.ended(job, error)
            if error:
                failures.append((job, error))
        return again

    def _submit(self, jobs):
        """An array for every thousand jobs."""
        slurm, ranks = self._study.slurm, self._study.ranks
        for first in range(0, len(jobs), ARRAY):
            part = jobs[first:first + ARRAY]
            folder = self._new_batch(part)
            limit = f"%{slurm.at_once}" if slurm.at_once else ""
            warning = min(WARNING_S, 30 * slurm.time_limit_min)
            words = ["sbatch", "--parsable", "--job-name", self._name, "--array", f"0-{len(part) - 1}{limit}",
                     "--comment", folder.name, "--nodes", "1", "--ntasks", str(ranks), "--no-requeue",
                     "--time", str(slurm.time_limit_min), "--signal", f"B:TERM@{warning}",
                     "--output", str(folder / "%a.log"), "--chdir", str(folder)]
            words += ["--partition", slurm.partition] if slurm.partition else []
            _ask(*words, *slurm.options, given=f'#!/bin/sh\nexport PYTHONPATH="{PACKAGES}"\n'
                 f'exec "{sys.executable}" -B -P -s -m dipper_run.worker "{folder}/jobs.json" "$SLURM_ARRAY_TASK_ID"\n')

    def _new_batch(self, jobs):
        """The folder of a submission, with its jobs in it."""
        numbers = [int(f.name) for f in self._folder.glob("*") if f.name.isdigit()]
        folder = self._folder / str(max(numbers, default=0) + 1)
        folder.mkdir(parents=True)
        listed = [{**dataclasses.asdict(job), "folder": str(job.folder)} for job in jobs]
        (folder / "jobs.json").write_text(json.dumps({"program": self._program, "jobs": listed}))
        return folder

    def _alive(self):
        """{run's folder: state} of the tasks that wait or go on."""
        found = {}
        for line in _asked_again("squeue", "-h", "-r", "-n", self._name, "-o", "%k %K %T").splitlines():
            batch, number, state = line.split()
            if state != "COMPLETING":  # of a node that is gone it stays so; of others the answer is there
                found[self._jobs(batch)[int(number)]["folder"]] = state
        return found

    def _errors(self):
        """{run's folder: message} of the tasks that have failed."""
        found = {}
        for answer in self._folder.glob("*/[0-9]*.json"):
            if error := json.loads(answer.read_text())["error"]:
                found[self._jobs(answer.parent.name)[int(answer.stem)]["folder"]] = error
        return found

    def _jobs(self, batch):
        return json.loads((self._folder / batch / "jobs.json").read_text())["jobs"]


def _cores(partition):
    """Of a partition, else of the default one."""
    rows = (line.split() for line in _ask("sinfo", "-h", "-o", "%P %C").splitlines())
    return sum(int(cores.split("/")[-1]) for name, cores in rows
               if (name.rstrip("*") == partition if partition else name.endswith("*")))


def _ask(*words, given=None):
    """What a program of Slurm prints; raises ProgramFailed with what it says."""
    try:
        made = subprocess.run(words, input=given, capture_output=True, text=True)
    except OSError as e:
        raise ProgramFailed(f"{words[0]}: {e.strerror}") from e
    if made.returncode != 0:
        raise ProgramFailed(f"{words[0]}: {made.stderr.strip()}")
    return made.stdout.strip()


def _asked_again(*words):
    """The same, patient with a controller that is away for a moment."""
    until = time.monotonic() + PATIENCE_S
    while True:
        try:
            return _ask(*words)
        except ProgramFailed:
            if time.monotonic() > until:
                raise
            time.sleep(LOOK_S)
