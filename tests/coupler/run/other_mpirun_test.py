"""An mpirun of another MPI starts whole runs where ranks belong; and an mpirun may start this program."""

import os
import pathlib
import shutil
import stat
import subprocess
import unittest

from runs import DIPPER, RunTest, SOURCE

TINY = SOURCE / "tests/coupler/run/tiny"
SHORT = ("--ranks", "2", "--set", "end_s=0.06")
# What one of another MPI does to a program: it comes up N times, each as rank 0 of 1.
OTHER = """#!/bin/bash
while [ "$1" != "-np" ]; do shift; done
n=$2; shift 2
for k in $(seq "$n"); do "$@" & done
for job in $(jobs -p); do wait "$job" || status=$?; done
exit "${status:-0}"
"""


class OtherMpirun(RunTest):
    def dipper(self, *words, before=(), **environment):
        done = subprocess.run([*before, DIPPER, *map(str, words)], env={**os.environ, **environment}, text=True,
                              capture_output=True, timeout=200)
        return done.returncode, done.stdout + done.stderr

    def other(self):
        """PATH with another mpirun in front, and that one's name."""
        folder = self.folder / "other"
        folder.mkdir()
        (folder / "mpirun").write_text(OTHER)
        (folder / "mpirun").chmod((folder / "mpirun").stat().st_mode | stat.S_IXUSR)
        return f"{folder}:{os.environ['PATH']}", str(folder / "mpirun")

    def test_is_reported_before_the_pile_is_settled_and_before_it_is_dug(self):
        path, mpirun = self.other()
        cache = self.folder / "cache"
        status, said = self.dipper("run", TINY, *SHORT, "--out", self.folder / "a", PATH=path,
                                   XDG_CACHE_HOME=str(cache))
        self.assertEqual(status, 3, said)
        self.assertIn(f"1 rank came up where 2 belong: {mpirun} is of another MPI", said)
        self.assertEqual([p for p in (cache / "dipper/piles").glob("*") if p.is_dir()], [])
        status, said = self.dipper("run", TINY, *SHORT, "--out", self.folder / "b")  # settles the pile
        self.assertEqual(status, 0, said)
        status, said = self.dipper("run", TINY, *SHORT, "--out", self.folder / "c", PATH=path)
        self.assertEqual(status, 3, said)
        self.assertIn(f"dipper-dem: 1 rank came up where 2 belong: {mpirun} is of another MPI", said)

    def test_a_run_within_another_mpirun(self):
        outer = [shutil.which("mpirun"), "--allow-run-as-root", "--oversubscribe", "-np"]
        status, said = self.dipper("run", TINY, *SHORT, "--out", self.folder / "one", before=[*outer, "1"])
        self.assertEqual(status, 0, said)
        status, said = self.dipper("run", TINY, *SHORT, "--out", self.folder / "two", before=[*outer, "2"])
        self.assertNotEqual(status, 0)
        self.assertIn("an mpirun has started 2 of this program", said)
        self.assertIn("--ranks 2", said)
        self.assertFalse(pathlib.Path(self.folder / "two").exists())

    def test_a_home_that_cannot_be_written_is_reported_before_anything_is(self):
        no_folder = self.folder / "file"
        no_folder.write_text("")
        for where in ({"XDG_CACHE_HOME": str(no_folder)}, {"XDG_CACHE_HOME": "", "HOME": str(no_folder)},
                      {"XDG_CACHE_HOME": "/proc/none"}):
            status, said = self.dipper("run", TINY, *SHORT, "--out", self.folder / "out", **where)
            self.assertEqual(status, 2, said)
            self.assertIn("set XDG_CACHE_HOME to a folder that can be written", said)
            self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    unittest.main()
