"""Runs that are made once: `dipper run`, several at a time, each kept in a cache entry and found again."""
import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass, field
from pathlib import Path

from . import run_cache

KEEPER = Path(__file__).with_name("keeper.py")
# Of a run's folder, what is large and only needed to look at rock, to go on or to replay the rock's side.
HEAVY = ("checkpoints", "dumps", "events.lcmlog")
# A run that is to be kept without dumps need not write them.
QUIET = ("--set", "output.dump_every_s=0", "--set", "output.checkpoint_every_s=0")
BEGUN = "begun.json"  # of an entry under way: what its run will not have
INTERRUPTED = 4  # exit status of a run that can be gone on with


class RunFailed(RuntimeError):
    """A run did not end well; the message names it and where its log is."""


@dataclass(frozen=True)
class Job:
    """One run: `dipper run WORDS`, kept in `run`, beside its manifest and its log.

    words: the case and the options that decide the run, without --out and --resume. drop: what of the run's folder is
    removed once it is done. report: whether its page is made before that. facts: kept with it, as JSON.
    """

    folder: Path
    words: tuple
    label: str
    drop: tuple = HEAVY
    report: bool = False
    facts: dict = field(default_factory=dict, compare=False)

    @property
    def run(self):
        return self.folder / "run"

    @property
    def begun(self):
        """Whether an earlier start has left a checkpoint to go on from, and lacks nothing that is to be kept."""
        return ((self.run / "record.h5").exists() and any((self.run / "checkpoints").glob("*"))
                and set(self._lacks()) <= set(self.drop))

    def _lacks(self):
        try:
            return json.loads((self.folder / BEGUN).read_text())["dropped"]
        except (OSError, ValueError, KeyError):
            return HEAVY


class KeptRuns:
    """Makes jobs that are not there yet, `at_once` at a time; nothing is made twice, by whichever process.

    cores: one list of cores, "0,1", for each run at a time, which its ranks keep to; else mpirun binds those of every
    run to the same first cores.
    """

    def __init__(self, program, at_once, cores=()):
        self.program, self.at_once = str(program), at_once
        self._cores = list(cores)
        self._sound = {}  # {folder: what was said of it}
        self._children, self._lock, self._stopped = {}, threading.Lock(), False
        self._alive, self._held = os.pipe()  # ends when this process does, however it ends

    def kept(self, folder, drop=HEAVY):
        """What was said of an entry when it was kept; None where it is not, is damaged (it is moved aside), or lacks
        something that is not in `drop`. Looked at once."""
        if folder not in self._sound:
            facts = run_cache.facts(folder)
            if facts is None:
                return None
            self._sound[folder] = facts
        facts = self._sound[folder]
        return facts if set(facts.get("dropped", HEAVY)) <= set(drop) else None

    def stopped(self):
        return self._stopped

    def make(self, jobs, on_end):
        """Makes the jobs that are not kept. on_end(job, None or the RunFailed) is called as each ends, here."""
        todo = [job for job in jobs if not self.kept(job.folder, job.drop)]
        with ThreadPoolExecutor(self.at_once) as pool:
            futures = {}
            try:
                for job in todo:
                    futures[pool.submit(self._make, job)] = job
                for future in as_completed(futures):
                    error = future.exception()
                    if error is not None and not isinstance(error, RunFailed):
                        raise error
                    on_end(futures[future], error)
            except BaseException:
                self.stop()
                for future in futures:
                    future.cancel()
                raise

    def stop(self):
        """Ends the runs under way; each leaves a checkpoint to go on from."""
        with self._lock:
            self._stopped = True
            for child in self._children.values():
                child.send_signal(signal.SIGINT)

    def _make(self, job):
        with run_cache.locked(job.folder, self.stopped) as lock:
            if not (self._stopped or self.kept(job.folder, job.drop)):
                self._make_alone(job, lock)

    def _make_alone(self, job, lock):
        folder, run = job.folder, job.run
        self._sound.pop(folder, None)
        folder.mkdir(exist_ok=True)
        (folder / run_cache.ENTRY_MANIFEST).unlink(missing_ok=True)  # of a run that kept less than is wanted
        words = [self.program, "run", *job.words, "--out", str(run)]
        began, begun = time.monotonic(), job.begun
        (folder / BEGUN).write_text(json.dumps({"dropped": job.drop}))
        status = self._call(words + ["--resume"], folder, lock) if begun else None
        if status not in (0, INTERRUPTED) and not self._stopped:
            shutil.rmtree(run, ignore_errors=True)
            status = self._call(words, folder, lock)
        if status == 0 and job.report and not self._stopped:
            status = self._call([self.program, "report", str(run)], folder, lock)
        if self._stopped:
            return
        if status != 0:
            raise RunFailed(f"run failed ({job.label}), status {status}; see {folder / 'run.log'}")
        for name in job.drop:
            own = Path(name)
            for path in [run / own, *run.glob(f"{own.stem}-*{own.suffix}")]:  # events-7.lcmlog, of a resumed run
                shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
        (folder / BEGUN).unlink()
        run_cache.seal(folder, {**job.facts, "dropped": list(job.drop), "wall_s": time.monotonic() - began})

    def _call(self, words, folder, lock):
        with open(folder / "run.log", "w") as log:
            with self._lock:
                if self._stopped:
                    return INTERRUPTED
                shared = (self._alive, lock.fileno())
                kept = [sys.executable, "-S", "-I", str(KEEPER), *map(str, shared), *words]
                cores = self._cores.pop() if self._cores else None
                own = {"OMPI_MCA_hwloc_base_cpu_list": cores} if cores else {}
                child = subprocess.Popen(kept, stdout=log, stderr=subprocess.STDOUT, start_new_session=True,
                                         pass_fds=shared, env={**os.environ, **own})
                self._children[child.pid] = child
            status = child.wait()
            with self._lock:
                self._cores += [cores] if cores else []
                self._children.pop(child.pid, None)
        return status
