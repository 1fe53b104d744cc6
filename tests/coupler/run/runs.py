"""What the tests of whole runs share: the program, the tiny case, and a folder of their own."""

import gzip
import json
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

import numpy as np

DIPPER = pathlib.Path(os.environ["DIPPER"])
TINY = pathlib.Path(__file__).parent / "tiny"
SOURCE = TINY.parents[3]
STEP_S, WINDOW = 3e-4, 10  # of the tiny case
PATIENCE_S = 300  # with a command that takes 2 s on a quiet machine
CORES = os.environ.get("CORES")  # of a file's tests, those that take so many; without it all


def two_cores(test):
    """Of a test with runs of two ranks, or that measures how long something takes: nothing goes beside it."""
    test.two_cores = True
    return test


def processes(folder):
    """(pid, name) of every living process of the run in `folder`, by the config file it was given."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
            state = (entry / "stat").read_text().rsplit(")", 1)[1].split()[0]
        except OSError:  # it has just ended
            continue
        if state != "Z" and any(w.startswith(str(folder).encode()) for w in words[1:]):
            found.append((int(entry.name), pathlib.Path(words[0].decode()).name))
    return found


def rocks(dump):
    """{column: values} of a run's dump of rock."""
    lines = gzip.decompress(dump.read_bytes()).decode().splitlines()
    head = next(i for i, line in enumerate(lines) if line.startswith("ITEM: ATOMS"))
    rows = np.array([line.split() for line in lines[head + 1:]], dtype=float)
    return dict(zip(lines[head].split()[2:], rows.T))


def last_rocks(run):
    """{column: values} of a run's last dump of rock."""
    return rocks(max((run / "dumps").glob("rocks_*.dump.gz"), key=lambda f: int(f.name[6:-8])))


class RunTest(unittest.TestCase):
    def setUp(self):
        cores = 2 if hasattr(getattr(self, self._testMethodName), "two_cores") else 1
        if CORES and int(CORES) != cores:
            self.skipTest(f"takes {cores} cores")
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="dipper-test-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def start(self, out, *arguments, case=TINY, dipper=DIPPER):
        return subprocess.Popen([dipper, "run", case, "--out", out, *arguments],
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def run_case(self, out, *arguments, status=0, case=TINY):
        """Runs to the end; returns (stdout, stderr)."""
        process = self.start(out, *arguments, case=case)
        try:
            text = process.communicate(timeout=PATIENCE_S)
        finally:
            process.kill()
        self.assertEqual(process.returncode, status, text[0] + text[1])
        return text

    def shared(self, *arguments):
        """A run with these arguments that is made once for all tests of a class; they leave it as it is."""
        here = type(self)
        if "made" not in vars(here):
            here.made = {}
            here.place = pathlib.Path(tempfile.mkdtemp(prefix="dipper-test-"))
            here.addClassCleanup(shutil.rmtree, here.place)
        if arguments not in here.made:
            out = here.place / str(len(here.made))
            self.run_case(out, *arguments)
            here.made[arguments] = out
        return here.made[arguments]

    def tiny_with_its_own_machine(self):
        """A copy of the tiny case whose machine file, machine.yaml, is in its folder."""
        folder = self.folder / "a" / "b" / "case"
        folder.mkdir(parents=True)
        shutil.copy(SOURCE / "mbs" / "bucyrus495.yaml", folder / "machine.yaml")
        shutil.copy(TINY / "motion.csv", folder)
        case = (TINY / "case.yaml").read_text().replace("../../../../mbs/bucyrus495.yaml", "machine.yaml")
        (folder / "case.yaml").write_text(case.replace("../../../../", f"{SOURCE}/"))
        return folder

    def wait_until_digging(self, process, out, time_s=0.5):
        """Until the record shows that much simulated time."""
        import h5py
        deadline = time.time() + PATIENCE_S
        while time.time() < deadline and process.poll() is None:
            try:
                with h5py.File(out / "record.h5", "r") as f:
                    t = f["time_s"]
                    if len(t) and t[-1] >= time_s:
                        return
            except (OSError, KeyError):  # not there yet, or just being written
                pass
            time.sleep(0.05)
        process.send_signal(signal.SIGKILL)
        self.fail(f"the run did not get to {time_s} s: {process.communicate()}")

    def soon_after(self, out, windows=100):
        """s: so many windows after where a run was cut short."""
        import h5py
        with h5py.File(out / "record.h5") as f:
            return round(f["time_s"][-1] + windows * WINDOW * STEP_S, 3)

    def summary(self, out):
        return json.loads((out / "summary.json").read_text())
