"""Effects of the catalogue in whole runs: what the rock does when one is there."""

import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import h5py
import numpy as np

from runs import DIPPER, PATIENCE_S, TINY, RunTest, last_rocks, two_cores

ROOT = pathlib.Path(__file__).resolve().parents[3]


class Record:
    def __init__(self, run):
        with h5py.File(run / "record.h5") as f:
            self.time_s = f["time_s"][:]
            self.place_m = f["bodies/dipper/pose"][:, :3]
            self.rock_kg = f["rock/rock_mass"][:]
            self.rock_J = f["rock/rock_kinetic_energy"][:]
            self.force_N = np.linalg.norm(f["bodies/dipper/wrench_mean"][:, 3:], axis=1)

    def first_contact(self):
        return np.argmax(self.force_N > 20e3)


class WornTeeth(RunTest):
    def test_meet_the_face_later_by_what_they_have_lost(self):
        records = {}
        for wear in (0, 0.5):
            out = self.folder / str(wear)
            self.run_case(out, "--set", f"effects.worn_teeth={wear}", "--ranks", "1")
            records[wear] = Record(out)
        whole, worn = records[0], records[0.5]
        first, later = whole.first_contact(), worn.first_contact()
        self.assertGreater(first, 0)
        # The dipper crowds forward along its teeth, give or take the rock it meets.
        way = np.linalg.norm(worn.place_m[later] - worn.place_m[first])
        self.assertGreater(worn.time_s[later], whole.time_s[first])
        self.assertAlmostEqual(way, 0.5, delta=0.2)
        np.testing.assert_array_equal(worn.place_m[:first], whole.place_m[:first])

    def test_beyond_their_length_are_reported_before_the_run(self):
        out, _ = self.run_case(self.folder / "x", "--set", "machine.tooth_wear_m=0.7", status=2)
        self.assertIn("machine.tooth_wear_m: teeth cannot wear by 0.7 m", out)
        self.assertFalse((self.folder / "x").exists())


# The shovel one metre back, so that its dipper is not under the slab.
BACK = ("--set", "machine.base_position_m=[-1,0,0]")
AT_S = 0.6
SLAB = (*BACK, "--set", "effects.collapsing_pile=0.8", "--set", f"collapse.at_s={AT_S}")
# 0.8 m over half the face and the crest: 5 m wide, (2.5 m / tan 35) / 2 + 2 m long, 0.6 of it rock.
SLAB_KG = 0.8 * 5 * (2.5 / np.tan(np.radians(35)) / 2 + 2) * 0.6 * 3215


class CollapsingPile(RunTest):
    def run_here(self, name, *arguments):
        self.run_case(self.folder / name, *arguments)
        return Record(self.folder / name)

    def test_is_the_plain_case_until_rock_comes_down_over_the_face(self):
        plain = self.run_here("plain", *BACK, "--ranks", "1", "--set", "effects.collapsing_pile=0")
        slab = self.run_here("slab", *SLAB, "--ranks", "1")
        before = slab.time_s < AT_S + 1e-9
        np.testing.assert_array_equal(slab.rock_J[before], plain.rock_J[before])
        np.testing.assert_array_equal(slab.rock_kg[before], plain.rock_kg[0])
        came = slab.rock_kg[~before] - plain.rock_kg[0]
        np.testing.assert_allclose(came, SLAB_KG, rtol=0.05)  # a rock more or less
        # It falls half a metre and more, and comes to rest: most of it on the bench, none lost.
        self.assertGreater(slab.rock_J.max(), SLAB_KG * 9.81 * 0.2)
        self.assertLess(slab.rock_J[-1], 0.5 * slab.rock_J.max())
        self.assertEqual(slab.rock_kg[-1], slab.rock_kg.max())
        heights = [self.centre_height(self.folder / run) for run in ("plain", "slab")]
        self.assertGreater(heights[1], heights[0] + 0.1)

    @staticmethod
    def centre_height(run):
        """Of the rock, by volume, in the last dump."""
        rock = last_rocks(run)
        return np.average(rock["z"], weights=rock["radius"]**3)

    def test_comes_once_whether_resumed_before_or_after(self):
        whole = self.run_here("whole", *SLAB, "--ranks", "1", "--set", "end_s=1.5")
        for end_s in (0.3, 0.6, 1.2):
            self.run_here(f"parts{end_s}", *SLAB, "--ranks", "1", "--set", f"end_s={end_s}")
            parts = self.run_here(f"parts{end_s}", *SLAB, "--ranks", "1", "--set", "end_s=1.5", "--resume")
            np.testing.assert_allclose(parts.rock_kg, whole.rock_kg, rtol=1e-9)

    @two_cores
    def test_comes_on_two_ranks(self):
        slab = self.run_here("two", *SLAB, "--ranks", "2", "--set", "end_s=0.9",
                             "--set", "coupling.timeout_s=60")
        np.testing.assert_allclose(slab.rock_kg[-1] - slab.rock_kg[0], SLAB_KG, rtol=0.05)

    def test_falls_on_rock_that_is_held_too(self):
        held = self.run_here("held", *SLAB, "--ranks", "1", "--set", "dem.hold_below_m_s=0.3")
        np.testing.assert_allclose(held.rock_kg[-1] - held.rock_kg[0], SLAB_KG, rtol=0.05)
        self.assertGreater(held.rock_J.max(), SLAB_KG * 9.81 * 0.2)


class OneOfYourOwn(RunTest):
    """docs/case.md's example, as it stands there, for the tiny case."""

    def test_works_from_a_file_in_the_case_folder(self):
        page = (ROOT / "docs/case.md").read_text()
        file = re.search(r"Save this as `cases/quick/(effects/(\w+)\.yaml)`:\n\n```yaml\n(.*?)```", page, re.S)
        command = re.search(r"dipper run cases/quick (--set \S+)", page[file.end():])
        shown = re.search(r"grep (?:\w+\.)?(\w+) .*# (\S+) in place of (\S+)\n", page[file.end():])
        case = self.folder / "case"
        (case / "effects").mkdir(parents=True)
        (case / file[1]).write_text(file[3])
        shutil.copy(TINY / "motion.csv", case)
        (case / "case.yaml").write_text((TINY / "case.yaml").read_text().replace("../../../..", str(ROOT)))

        words = command[1].split()
        done = subprocess.run([DIPPER, "check", case, *words], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)
        done = subprocess.run([DIPPER, "run", case, *words, "--ranks", "1", "--set", "end_s=0.1", "--out",
                               self.folder / "run"], capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        text = (self.folder / "run/case.txt").read_text()
        value = float(re.search(rf"^\S*\.{shown[1]}=(\S+)$", text, re.M)[1])
        self.assertAlmostEqual(value, float(shown[2]))
        self.assertIn(f"{shown[1]}: {shown[3]}", (case / "case.yaml").read_text())
        self.assertEqual(self.summary(self.folder / "run")["effects"], {file[2]: 0.2})

        sys.path[:0] = [str(ROOT / "analysis/gap"), str(ROOT / "analysis/runs")]
        from dipper_gap.simulation.effects import read_catalogue
        self.assertIn(file[2], read_catalogue(case))


if __name__ == "__main__":
    unittest.main()
