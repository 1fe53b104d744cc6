"""From points and seeds to runs: every point is checked by `dipper check`, and every run has its place in the cache."""
import hashlib
import os
import re
import shutil
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

from dipper_run.findings import BadInput
from dipper_run.kept_runs import HEAVY, QUIET, Job
from dipper_run.program import check_json
from dipper_run.run_cache import entry_of

from .motions import Motions

# What a study removes of a run, by `keep`. A run's own page and its figures stay always.
DROPPED = {"all": (), "record": HEAVY, "summary": (*HEAVY, "record.h5", "observed", "deck")}
PAGE_BYTES = 2e6  # of a run, about
NAME_BYTES = 100  # of a run's name: a longer one is cut


@dataclass(frozen=True)
class PlannedRun:
    """A point with a seed. `job` makes it."""

    point: object
    seed: int
    job: Job

    @property
    def folder(self):
        return self.job.run

    @property
    def name(self):
        """Of the link to it in the study's folder; ends with a hash where it does not say the values."""
        joined = "_".join(v.name for v in self.point.values)
        values = re.sub(r"[^\w.+-]+", "-", joined).encode()[:NAME_BYTES].decode(errors="ignore")
        parted = len(self.point.values) < 2 or not any("_" in v.name for v in self.point.values)
        if values != joined or not parted:
            values += f"-{hashlib.sha256(str(self.point).encode()).hexdigest()[:8]}"
        return f"{values or 'case'}_s{self.seed}"

    def __str__(self):
        return f"{self.point}, seed {self.seed}"


class Planner:
    """Checks points, once each, and makes the runs of them."""

    def __init__(self, study, program, cache):
        self.study, self.program, self.cache = study, program, cache
        self.motions = Motions(study.case, program, cache.with_name("motions"))
        self._checked = {}   # {point: the JSON of `dipper check`}
        self._settings = {}  # {point: its settings as `--set` takes them}

    def check(self, points):
        """Raises BadInput with what is wrong with any of them, each finding once."""
        wrong = dict.fromkeys(finding for of_point in self.faults(points).values() for finding in of_point)
        if wrong:
            raise BadInput(wrong)

    def faults(self, points):
        """{point: what `dipper motion` and `dipper check` have against it}; the points left out are checked."""
        found, planned = {}, []
        for point in dict.fromkeys(points):
            if point in self._checked:
                continue
            try:
                self._settings[point] = self.motions.resolved(self.study.file, point.settings)
                planned.append(point)
            except BadInput as e:
                found[point] = e.findings
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for point, checked in zip(planned, pool.map(self._ask, planned)):
                if checked["findings"]:
                    found[point] = [self._line(point, finding) for finding in checked["findings"]]
                else:
                    self._checked[point] = checked
        return found

    def runs(self, points, seeds):
        """The runs of checked points, seed by seed within a point."""
        return [self._run(point, seed) for point in points for seed in seeds]

    def checked(self, point):
        """The JSON of `dipper check --json` for a point."""
        return self._checked[point]

    def seconds(self, run):
        """What a run may take, its pile's settling with it."""
        return self._checked[run.point]["cost"]["wall_s"]

    def disk(self, run):
        """(bytes that stay, bytes more while it goes on), about."""
        cost, keep = self._checked[run.point]["cost"], self.study.keep
        most = cost["disk_B"] - (0 if keep == "all" else cost["dumps_B"])  # such a run leaves its dumps out (QUIET)
        stays = {"summary": 0, "record": cost["record_B"], "all": most}[keep]
        return stays + PAGE_BYTES, most - stays

    def _words(self, point):
        return [word for s in self._settings[point] for word in ("--set", str(s))]

    def _ask(self, point):
        words = [*self._words(point), "--set", f"dem.ranks={self.study.ranks}", "--set", "seed=1"]
        return check_json(self.study.case, *words, of=self.program)

    def _line(self, point, finding):
        """A finding about a --set is one about the line of the study that says so."""
        place = f"{finding['file']}:{finding['line']}" if finding["line"] else finding["file"]
        if finding["file"] == "--set":
            lines = [s.line for s in self._settings[point] if s.key == finding["key"] or s.key == "" or
                     finding["key"].startswith(s.key + ".") or s.key.startswith(finding["key"] + ".")]
            place = f"{self.study.file}:{lines[0]}" if lines else str(self.study.file)
        return f"{place}: {finding['key']}: {finding['message']}"

    def _run(self, point, seed):
        checked, study = self._checked[point], self.study
        folder = entry_of(self.cache, checked, seed, "")
        # Through Slurm a run may end at any time: it goes on from the case's own checkpoints.
        quiet = () if study.keep == "all" else QUIET[:2] if study.executor == "slurm" else QUIET
        words = [str(study.case.resolve()), "--ranks", str(study.ranks), "--seed", str(seed), *quiet,
                 *self._words(point)]
        facts = {"settings": [str(s) for s in self._settings[point]], "seed": seed}
        return PlannedRun(point, seed, Job(folder, tuple(words), f"{point}, seed {seed}", DROPPED[study.keep], True,
                                           facts))


def free_bytes(folder):
    """Free on the disk that a folder is, or will be, on."""
    while not folder.exists():
        folder = folder.parent
    return shutil.disk_usage(folder).free
