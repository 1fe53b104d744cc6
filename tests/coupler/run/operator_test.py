"""Runs whose machine a program drives (docs/operator_program.md): the page's examples, going on, replay, faults."""
import os
import pathlib
import re
import subprocess
import sys
import unittest

import h5py
import numpy as np

from runs import DIPPER, PATIENCE_S, SOURCE, TINY, RunTest

PAGE = SOURCE / "docs/operator_program.md"
FOLLOWER = SOURCE / "tests/coupler/operate/path_follower.py"
LIMITED = ("--set", "machine.drives=limited", "--ranks", "1", "--set", "output.checkpoint_every_s=0.2")
GREETS = "read line; echo '{\"dipper_operator\": 1}'; "
STILL = '{"hoist_m": -0.0469, "crowd_m": -1.5589, "swing_rad": 0, "door_rad": 0}'


def setUpModule():
    os.environ["PYTHONPATH"] = str(SOURCE / "analysis/runs")
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"


def example(heading):
    """The Python of a section of the page."""
    return re.search(rf"^## {heading}\n.*?^```python\n(.*?)^```$", PAGE.read_text(), re.M | re.S).group(1)


def channels(out):
    with h5py.File(out / "record.h5") as f:
        return {name: np.array(data) for name, data in f["machine"].items()}


class Operator(RunTest):
    def program(self, name, text):
        file = self.folder / name
        file.write_text(text)
        return file

    def driven(self, name, command, *arguments, status=0):
        out = self.folder / name
        return out, self.run_case(out, *LIMITED, "--operator", command, *arguments, status=status)

    def test_the_example_drives_and_is_the_same_again(self):
        text = example("In Python")
        self.assertLess(len(text.splitlines()), 36)
        command = f"python3 {self.program('patient.py', text)}"
        words = ("--no-rock", "--set", "end_s=3")
        first, _ = self.driven("first", command, *words)
        second, _ = self.driven("second", command, *words)
        one, two = channels(first), channels(second)
        self.assertEqual(set(one), set(two))
        for name, values in one.items():
            np.testing.assert_array_equal(values, two[name], name)
        moved = np.ptp(one["crowd"])
        self.assertGreater(moved, 0.5, "the motion's crowd goes out")
        self.assertLess(np.abs(one["crowd"] - one["sent_crowd"]).max(), 0.06, "in the air it is where it is sent")
        self.assertEqual(self.summary(first)["operator"], command)
        self.assertIn("--operator-folder=", (first / "settings.txt").read_text())

    def test_a_program_ends_the_run(self):
        text = FOLLOWER.read_text().replace("return dict", "return {'done': t_s > 0.95} | dict")
        stops = self.program("stops.py", text)
        out, _ = self.driven("done", f"python3 {stops}", "--no-rock", "--set", "end_s=0")
        self.assertAlmostEqual(self.summary(out)["sim_s"], 1.0, delta=0.01)
        soon = self.program("soon.py", text.replace("0.95", "0.15"))
        out, _ = self.driven("dug", f"python3 {soon}", "--set", "end_s=0")
        before = (out / "summary.json").read_bytes()
        said, _ = self.run_case(out, "--resume")
        self.assertIn("complete already", said)
        self.assertEqual((out / "summary.json").read_bytes(), before)

    def test_dies_goes_on_and_is_the_same_run_and_a_learner_begins_there(self):
        whole, _ = self.driven("whole", f"python3 {FOLLOWER}", "--set", "end_s=0.5")
        dies = self.program("dies.py", FOLLOWER.read_text().replace(
            'time, rate', f'if t_s > 0.25 and not __import__("os").path.exists("{self.folder}/well"):\n'
            '            raise SystemExit("no more")\n        time, rate', 1))
        out, (_, err) = self.driven("dies", f"python3 {dies}", "--set", "end_s=0.5", status=3)
        for words in ("the operator side failed at t = 0.3", f"`python3 {dies}`: no more (exit status 1)",
                      "last checkpoint: ", "(t = 0.2", "--resume"):
            self.assertIn(words, err)
        (self.folder / "well").touch()
        self.run_case(out, "--resume")
        self.assertEqual(self.summary(out)["status"], "complete")
        self.assertEqual(self.summary(out)["state_hash"], self.summary(whole)["state_hash"])
        (self.folder / "well").unlink()  # a replay needs no program
        replayed = subprocess.run([DIPPER, "replay", out, "--side", "mbs"], capture_output=True, text=True)
        self.assertEqual(replayed.returncode, 0, replayed.stdout + replayed.stderr)
        self.assertIn("every answer equals the recorded one, bit for bit", replayed.stdout)

        learner = self.program("learn.py", example("A learner's loop"))
        learnt = subprocess.run([sys.executable, learner, TINY, whole, self.folder / "episodes", "0.8"], text=True,
                                capture_output=True, timeout=PATIENCE_S, env={**os.environ, "DIPPER": str(DIPPER)})
        self.assertEqual(learnt.returncode, 0, learnt.stderr)
        self.assertEqual(len(re.findall(r"m/s: -?\d+\.\d kg in ", learnt.stdout)), 2, learnt.stdout)
        for episode in ("1", "2"):
            summary = self.summary(self.folder / "episodes" / episode)
            self.assertEqual((summary["status"], round(summary["sim_s"], 3)), ("complete", 0.8))
        one, two = (channels(self.folder / "episodes" / e)["crowd"] for e in "12")
        begun = channels(whole)["crowd"]
        np.testing.assert_array_equal(one[:len(begun)], begun)
        self.assertGreater(abs(one[-1] - two[-1]), 0.005, "the episodes' actions differ")

    def test_faults_end_with_their_reason(self):
        for name, script, words in (
                ("hangs", GREETS + "sleep 60", "no answer for 1 s"),
                ("nonsense", GREETS + "read line; echo woe", "not a line of JSON: 'woe'"),
                ("nan", GREETS + f"read line; echo '{STILL.replace('0,', 'NaN,', 1)}'; sleep 9", "not a line of JSON"),
                ("far", GREETS + f"read line; echo '{STILL.replace('-1.5589', '3.3')}'; sleep 9",
                 "crowd_m: 3.3 is out of the drive's reach, -2.6 to 3.2"),
                ("lacks", GREETS + "read line; echo '{\"hoist_m\": -0.0469}'; sleep 9", "crowd_m: missing key")):
            with self.subTest(name):
                file = self.program(name, script)
                _, (_, err) = self.driven(f"run-{name}", f"sh {file}", "--no-rock", "--set", "coupling.timeout_s=1",
                                          status=3)
                self.assertIn(f"the operator side failed at t = 0.0000 s: `sh {file}`: ", err)
                self.assertIn(words, err)

    def test_what_cannot_be_driven_starts_nothing(self):
        for name, command, arguments, words in (
                ("missing", "no-such-program --fast", (), "--operator: no-such-program: no such program"),
                ("quotes", "sh 'x", (), "--operator: "),
                ("prescribed", "cat", ("--set", "machine.drives=prescribed"), "machine.drives"),
                ("away", "cat", ("--set", "machine.contact_on_return=off"), "machine.contact_on_return")):
            with self.subTest(name):
                out, (_, err) = self.driven(name, command, "--no-rock", *arguments, status=2)
                self.assertIn(words, err)
                self.assertFalse(out.exists())
        _, err = self.run_case(pathlib.Path(self.folder / "truth"), "--operator-truth", status=2)
        self.assertIn("--operator-truth: goes with --operator", err)


if __name__ == "__main__":
    unittest.main()
