"""Runs of a case, as the workflow asks for them: by `dipper run`, some at a time, each kept and found again."""
import copy
import shutil
import subprocess
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path

from dipper_run import run_cache
from dipper_run.findings import BadInput
from dipper_run.kept_runs import QUIET, Job, KeptRuns, RunFailed
from dipper_run.program import ask
from dipper_run.quantities import minutes

from ..readings.measured import read_measured

JOBS = 2  # runs at a time, unless asked otherwise


@dataclass(frozen=True)
class Request:
    """One run: the case, these effects {name: strength} as sorted pairs, this seed.

    how: `run`; or, of the plain run of the same seed, `observe` (the effects change only what the
    instruments show) or `replay` (some change the machine's forces but not its motion, so the rock's
    recorded force on it stays what it was); or `empty`, the machine's cycle without rock as the
    instruments show it.
    """

    effects: tuple
    seed: int
    how: str = "run"

    @property
    def plain(self):
        """The run that is looked at, with other instruments or another machine."""
        return EMPTY if self.how == "empty" else Request((), self.seed)

    def __str__(self):
        said = ", ".join(f"{n} {s:.4g}" for n, s in self.effects) or "unchanged"
        return "the empty cycle" if self.how == "empty" else f"{said}, seed {self.seed}"


EMPTY = Request((), 1, "empty")


def request(effects, seed, catalogue):
    pairs = tuple(sorted((n, float(s)) for n, s in effects.items() if s))
    affected = {catalogue[n].affects for n, _ in pairs}
    how = "run"
    if affected == {"instruments"}:
        how = "observe"
    elif pairs and affected <= {"instruments", "machine"}:  # the machine against the recorded rock
        how = "replay"
    return Request(pairs, int(seed), how)


class Simulator:
    """What the workflow needs; `DipperSimulator` is the real one, tests have a fake."""

    jobs = JOBS
    catalogue = {}  # {name: Effect}
    known = None  # readings.fidelity.KnownErrors by which runs are corrected

    def run(self, requests, say=print):
        """One Measured, noise-free, for each request."""
        raise NotImplementedError

    def with_effect(self, effect):
        """The same that also knows an effect which is in no file."""
        raise NotImplementedError

    def takes_a_run(self, request):
        """Whether a request needs a run of its own, besides the plain one of its seed."""
        return request.how == "run"

    def needed(self, requests):
        """The runs that requests take, each once: those of their own, or the plain ones of their seeds."""
        return list(dict.fromkeys(r if self.takes_a_run(r) else r.plain for r in requests))

    def plan(self, requests):
        """(runs to make, runs kept from before, seconds a run takes or None)."""
        raise NotImplementedError

    def case_hash(self):
        """Text that changes when the case or a file it names does."""
        raise NotImplementedError


def check(program, case, effects=()):
    """What `dipper check` has against the case with these (name, strength); empty when it is sound."""
    made = subprocess.run([str(program), "check", str(case)] + _settings(effects), capture_output=True, text=True)
    return "" if made.returncode == 0 else (made.stdout + made.stderr).strip()


class DipperSimulator(Simulator):
    def __init__(self, case, catalogue, program, cache, jobs=JOBS):
        self.jobs = jobs
        self.case, self.catalogue, self.program = Path(case), catalogue, str(program)
        self.cache = Path(cache)
        self._told = ask("check", "--json", self.case, of=self.program)
        self._runs = KeptRuns(self.program, jobs)

    def with_effect(self, effect):
        if effect.affects != "instruments":
            raise ValueError(f"effect {effect.name}: a run needs its file; only what is observed can do without")
        other = copy.copy(self)
        other.catalogue = {**self.catalogue, effect.name: effect}
        return other

    def case_hash(self):
        return self._told["case_hash"]

    def _guess(self):
        """Seconds a run may take on one core, its pile's settling with it."""
        return self._told["cost"]["settle_cpu_s"] + self._told["cost"]["dig_cpu_s"]

    def folder(self, r):
        """Where a run is kept: by all that decides it."""
        overlays = "".join(str(self.catalogue[n].overlay) for n, _ in r.effects)
        return run_cache.entry_of(self.cache, self._told, r, overlays)

    def _possible(self, r):
        """With limited drives another machine moves otherwise: a run answers what a replay cannot."""
        limited = self._told.get("values", {}).get("machine.drives") == "limited"
        return replace(r, how="run") if limited and r.how == "replay" else r

    def takes_a_run(self, request):
        return self._possible(request).how == "run"

    def plan(self, requests):
        need = [self._possible(r) for r in self.needed(requests)]
        kept = [r for r in need if self._kept(r)]
        took = [self._kept(r)["wall_s"] for r in kept]
        return len(need) - len(kept), len(kept), (sum(took) / len(took) if took else self._guess())

    def run(self, requests, say=print):
        requests = [self._possible(r) for r in requests]
        need = list(dict.fromkeys(r if r.how == "run" else r.plain for r in requests))
        jobs = [self._job(r) for r in need if not self._kept(r)]
        began, ended, failures = time.monotonic(), [], []

        def on_end(job, error):
            ended.append(job)
            if error:
                failures.append(str(error))
                return
            left = (time.monotonic() - began) / len(ended) * (len(jobs) - len(ended))
            say(f"  run {len(ended)} of {len(jobs)}: {job.label}; about {minutes(left)} left")

        self._runs.make(jobs, on_end)
        if failures:
            raise RunFailed("\n".join(failures))
        with ThreadPoolExecutor(self.jobs) as pool:
            try:
                return list(pool.map(self._observed, requests))
            except BaseException:
                pool.shutdown(wait=False, cancel_futures=True)
                raise

    def _kept(self, r):
        return self._runs.kept(self.folder(r))

    def _job(self, r):
        words = [str(self.case), "--ranks", "1", "--seed", str(r.seed), *QUIET, *_settings(r.effects)]
        if r.how == "empty":
            words.insert(1, "--no-rock")
        return Job(self.folder(r), tuple(words), str(r), facts={"effects": dict(r.effects), "seed": r.seed})

    def _again(self, r):
        """Words that look at the plain run once more, with other instruments or another machine."""
        plain = str(self._job(r.plain).run)
        if r.how == "replay":
            # The run may be of a like case elsewhere that is gone.
            return [self.program, "replay", plain, "--side", "mbs", "--case", str(self.case)] + _settings(r.effects)
        settings = [v for n, s in r.effects for v in _values(self.catalogue[n], s)]
        return [self.program, "observe", plain] + [w for v in settings for w in ("--set", v)]

    def _observed(self, r):
        if r.how == "run":
            return read_measured(self._job(r).run / "observed", simulated=True)
        # What an empty cycle shows is kept beside it: its run writes no observed folder.
        folder = self.folder(r) if r.how != "empty" else self.folder(r).with_name(self.folder(r).name + "-observed")
        with run_cache.locked(folder, self._runs.stopped):
            if not self._runs.kept(folder):
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir()
                words = self._again(r) + ["--out", str(folder / "observed")]
                made = subprocess.run(words, capture_output=True, text=True)
                if made.returncode != 0:
                    raise RunFailed(f"dipper {r.how} failed ({r}): {made.stderr.strip()}")
                run_cache.seal(folder, {"effects": dict(r.effects), "seed": r.seed})
        return read_measured(folder / "observed", simulated=True)


def _values(effect, strength):
    """Settings of `dipper observe`, whose keys are off at 0."""
    for key, how, factor in effect.overlay:
        if how == "scale":
            raise BadInput([f"effect {effect.name}: {key}: an observation effect adds or sets"])
        yield f"{key}={factor * strength:.9g}"


def _settings(effects):
    return [w for name, strength in effects for w in ("--set", f"effects.{name}={strength:.9g}")]
