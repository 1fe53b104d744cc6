"""Every command says what it is for, with an example; scripts/setup says what it may not install."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

DIPPER = os.environ["DIPPER"]
SOURCE = pathlib.Path(__file__).resolve().parents[3]


def told(*words):
    return subprocess.run([DIPPER, *words, "--help"], capture_output=True, text=True, check=True).stdout


class Help(unittest.TestCase):
    def test_every_command_has_an_example_of_itself(self):
        listed = told().split("Subcommands:")[1]
        names = set(re.findall(r"^  (\w+) ", listed, re.M))
        self.assertLess({"run", "check", "preview", "clean"}, names)
        for name in sorted(names):
            words = (name, "pile-angle") if name == "calibrate" else (name,)
            example = "dipper completion" if name == "completion" else "dipper " + " ".join(words)
            with self.subTest(name):
                before, _, after = told(*words).lower().rpartition("example")
                self.assertIn(name, before)
                self.assertIn(example, " ".join(after.split()))

    def test_set_up_without_rights_lists_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in (("dpkg-query", "exit 1"), ("id", "echo 1000"), ("sudo", "exit 1")):
                program = pathlib.Path(folder, name)
                program.write_text(f"#!/bin/sh\n{text}\n")
                program.chmod(0o755)
            env = {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}
            done = subprocess.run([SOURCE / "scripts" / "setup", "packages"], capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL, env=env)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertIn("an administrator does it with: apt-get install g++ cmake", done.stderr)


if __name__ == "__main__":
    unittest.main()
