"""What a run leaves is damaged: no reader uses it, crashes, or passes over it in silence."""

import json
import random
import shutil
import subprocess
import unittest

from runs import DIPPER, PATIENCE_S, TINY, RunTest

READ = ("case.txt", "record.h5", "scales.json", "summary.json", "deck/rocks.in", "deck/case.in")


def mutant(data, rng):
    """A bit turned, a number exchanged, the end cut off, a piece left out."""
    data = bytearray(data)
    at = rng.randrange(len(data))
    how = rng.randrange(5)
    if how < 2:
        data[at] ^= 1 << rng.randrange(8)
    elif how == 2:
        digits = [k for k, byte in enumerate(data) if 0x30 <= byte <= 0x39]
        at = rng.choice(digits or [at])
        data[at:at + 1] = rng.choice([b"nan", b"-1", b"1e300", b"", b"99999999999999999999"])
    elif how == 3:
        del data[at:]
    else:
        del data[at:at + rng.randrange(1, 64)]
    return bytes(data)


class Damage(RunTest):
    """Copies of one run; each test damages a file of its own and mends it again."""

    def setUp(self):
        super().setUp()
        self.run = self.folder / "run"
        shutil.copytree(self.shared("--ranks", "1", "--set", "end_s=0.9"), self.run)
        self.metrics = self.report("whole")
        self.assertIsNotNone(self.metrics)

    def dipper(self, *words):
        done = subprocess.run([DIPPER, *words], capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertIn(done.returncode, (0, 2, 3), done)  # no signal, no abort
        if done.returncode:
            self.assertRegex(done.stderr, "dipper: .", done)
        return done

    def report(self, name):
        """Its metrics; None when it was refused."""
        out = self.folder / name
        shutil.rmtree(out, ignore_errors=True)
        self.done = self.dipper("report", self.run, "--out", out)
        return json.loads((out / "metrics.json").read_text()) if self.done.returncode == 0 else None

    def each_mutant(self, file, count, seed):
        whole = file.read_bytes()
        rng = random.Random(seed)
        for _ in range(count):
            damaged = mutant(whole, rng)
            if damaged == whole:
                continue
            file.write_bytes(damaged)
            yield
        file.write_bytes(whole)

    def test_of_a_run_that_has_ended_every_change_is_found(self):
        for k, name in enumerate(READ):
            file = self.run / name
            for _ in self.each_mutant(file, 3, k):
                for words in (("report", self.run, "--out", self.folder / "no"), ("phases", self.run),
                              ("observe", self.run, "--out", self.folder / "no"), ("replay", self.run)):
                    done = self.dipper(*words)
                    self.assertEqual(done.returncode, 2, (name, words, done))
                    self.assertIn(f"{file} has changed since it was written", done.stderr)
                done = self.dipper("run", TINY, "--out", self.run, "--ranks", "1", "--resume")
                self.assertEqual(done.returncode, 2, (name, done))
                self.assertIn(f"{file} has changed since it was written", done.stderr)
        for _ in self.each_mutant(self.run / "manifest.sha256", 10, 50):
            self.assertEqual(self.dipper("phases", self.run).returncode, 2)
        self.assertFalse((self.folder / "no").exists())
        self.assertEqual(self.report("mended"), self.metrics)
        (self.run / "record.h5").unlink()
        done = self.dipper("report", self.run)
        self.assertIn("record.h5 is missing", done.stderr)

    def test_of_a_run_that_was_killed_nothing_crashes_a_reader(self):
        """It has no manifest yet: what is known is reported, with the file's name."""
        (self.run / "manifest.sha256").unlink()
        readers = (("report", self.run, "--out", self.folder / "no"), ("phases", self.run),
                   ("observe", self.run, "--out", self.folder / "seen"))
        refused = 0
        for k, name in enumerate(READ):
            file = self.run / name
            for _ in self.each_mutant(file, 15 if name == "record.h5" else 5, 100 + k):
                for words in readers:
                    done = self.dipper(*words)
                    refused += done.returncode != 0
                    if done.returncode:
                        self.assertIn(str(self.run), done.stderr, (name, words))
                    if name == "record.h5":
                        self.assertIn(done.returncode, (0, 2), (words, done))
                    shutil.rmtree(self.folder / "no", ignore_errors=True)
        self.assertGreater(refused, 10)
        (self.run / "record.h5").unlink()
        for words in readers:
            done = self.dipper(*words)
            self.assertEqual(done.returncode, 2, (words, done))
            self.assertIn(f"{self.run / 'record.h5'}: is missing", done.stderr)


if __name__ == "__main__":
    unittest.main()
