"""Effects of the catalogue in whole runs: what the rock does when one is there."""

import unittest

import h5py
import numpy as np

from runs import RunTest


class Record:
    def __init__(self, run):
        with h5py.File(run / "record.h5") as f:
            self.time_s = f["time_s"][:]
            self.place_m = f["bodies/dipper/pose"][:, :3]
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

    def test_beyond_their_length_are_told_before_the_run(self):
        out, _ = self.run_case(self.folder / "x", "--set", "machine.tooth_wear_m=0.7", status=2)
        self.assertIn("machine.tooth_wear_m: teeth cannot wear by 0.7 m", out)
        self.assertFalse((self.folder / "x").exists())


if __name__ == "__main__":
    unittest.main()
