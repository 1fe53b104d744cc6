"""A case, a study and a program that stands in for `dipper`, in a folder of the test's own."""
import csv
import os
import shutil
import subprocess
import sys
from pathlib import Path

from dipper_run.program import program

HERE = Path(__file__).resolve().parent
ANALYSIS = HERE.parents[2] / "analysis"
STUDY = """case: case
seeds: [1, 2, 3]
parameters:
  machine.rake_angle_deg: [60, 62, 64]
"""


class World:
    def __init__(self, folder, real=None):
        self.folder = Path(folder)
        shutil.copy(HERE / "fake_dipper.py", self.folder / "dipper")
        (self.folder / "dipper").chmod(0o755)
        (self.folder / "real").write_text(real or program())
        (self.folder / "case").mkdir()
        (self.folder / "case/case.yaml").write_text("seed: 1\n")
        self.out = self.folder / "out"
        self.environment = {**os.environ, "PYTHONPATH": f"{ANALYSIS}/study:{ANALYSIS}/runs",
                            "DIPPER": str(self.folder / "dipper"), "XDG_CACHE_HOME": str(self.folder / "cache")}

    def say(self, name, text):
        (self.folder / name).write_text(str(text))

    def words(self, study, *more):
        (self.folder / "study.yaml").write_text(study)
        file = str(self.folder / "study.yaml")
        return [sys.executable, "-B", "-m", "dipper_study", file, "--out", str(self.out), *more]

    def study(self, study=STUDY, *more, status=0):
        """Runs it to the end; returns what it said."""
        made = subprocess.run(self.words(study, *more), env=self.environment, capture_output=True, text=True,
                              timeout=300)
        assert made.returncode == status, made.stdout + made.stderr
        return made.stdout + made.stderr

    def start(self, study=STUDY, *more):
        return subprocess.Popen(self.words(study, *more), env=self.environment, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, start_new_session=True)

    def calls(self):
        file = self.folder / "calls"
        return file.read_text().splitlines() if file.exists() else []

    def rows(self):
        with open(self.out / "study.csv", newline="") as f:
            return list(csv.DictReader(f))

    def left(self):
        """Runs of this test that still go on."""
        found = subprocess.run(["pgrep", "-f", f"{self.folder}/dipper run"], capture_output=True, text=True)
        return found.stdout.split()
