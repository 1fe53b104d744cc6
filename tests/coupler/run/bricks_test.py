"""A bench of bricks: made by the run, the same for the same seed, of whole rocks, inside its walls."""
import csv
import os
import unittest
import unittest.mock

import numpy as np

from runs import RunTest, rocks

BRICKS = ("--set", "pile.built=bricks", "--set", "end_s=0.03", "--set", "pile.relax_s=1.5", "--ranks", "1")
HALF_M, TOE_M, HEIGHT_M, REAR_M = 2.5, 13.3, 2.5, 13.3 + 2.5 / np.tan(np.radians(35)) + 2
DENSITY, D200_M, D300_M = 3215, 0.5, 0.75


class Bricks(RunTest):
    def setUp(self):
        super().setUp()
        changed = unittest.mock.patch.dict(os.environ, {"XDG_CACHE_HOME": str(self.folder / "cache")})
        changed.start()
        self.addCleanup(changed.stop)

    def bench(self, name, *arguments):
        out = self.folder / name
        self.run_case(out, *BRICKS, *arguments)
        return rocks(out / "dumps/rocks_0.dump.gz")

    def settled(self, kind):
        return sorted(f for f in (self.folder / "cache/dipper" / kind).iterdir() if f.is_dir())

    def test_seeds_and_the_cache(self):
        first = self.bench("first")
        self.check_brick()
        self.check_bench(first)
        # From an empty cache again: the same to the bit.
        (self.folder / "cache").rename(self.folder / "kept")
        again = self.bench("again")
        for column in ("x", "y", "z", "radius", "id_multisphere"):
            np.testing.assert_array_equal(first[column], again[column])
        # Seed 5 has seed 1's brick, and another bench; a wider bench has it too.
        brick = self.settled("bricks")
        other = self.bench("other", "--seed", "5")
        self.bench("wide", "--set", "pile.width_m=5.5")
        self.assertEqual(self.settled("bricks"), brick)
        self.assertEqual(len(self.settled("piles")), 3)
        self.assertFalse(np.isin(np.round(other["x"], 2), np.round(first["x"], 2)).all())

    def check_brick(self):
        """No rock was lost as it settled, and it stands on the ground, over a bench's height."""
        [brick] = self.settled("bricks")
        self.assertEqual(sorted(f.name for f in brick.iterdir()), ["brick.csv", "manifest.sha256"])
        with open(brick / "brick.csv") as file:
            rows = list(csv.DictReader(file))
        mass = sum((D200_M if row["kind"] == "d200_sphere" else D300_M)**3 for row in rows) * np.pi / 6 * DENSITY
        rock = D300_M**3 * np.pi / 6 * DENSITY
        self.assertAlmostEqual(mass, 1.1 * 0.6 * DENSITY * 6 * 6 * 3, delta=0.6 * rock)  # half of one, rounded
        self.assertEqual({row["kind"] for row in rows}, {"d200_sphere", "d300_block", "d300_wedge", "d300_slab"})
        z = np.array([float(row["z_m"]) for row in rows])
        self.assertGreater(z.min(), 0.2)
        self.assertGreater(z.max(), HEIGHT_M)
        turns = np.array([[float(row[q]) for q in ("qw", "qx", "qy", "qz")] for row in rows])
        np.testing.assert_allclose(np.linalg.norm(turns, axis=1), 1, atol=1e-12)

    def check_bench(self, rock):
        clumps = rock["id_multisphere"][rock["type"] > 1]
        self.assertGreater(len(set(clumps)), 10)
        self.assertEqual(set(np.unique(clumps, return_counts=True)[1]), {6})
        radius = rock["radius"]
        self.assertLess((np.abs(rock["y"]) + radius).max(), HALF_M + 0.02)
        self.assertLess((rock["x"] + radius).max(), REAR_M + 0.02)
        self.assertGreater((rock["z"] - radius).min(), -0.03)
        self.assertLess(rock["z"].max(), HEIGHT_M + D300_M / 2)
        # It fills its outline, but for the walls, which are seven rocks apart.
        mass = np.pi / 6 * ((rock["type"] == 1).sum() * D200_M**3 + len(set(clumps)) * D300_M**3)
        area = HEIGHT_M * (2 + (REAR_M - 2 - TOE_M) / 2)
        self.assertTrue(0.35 < mass / (area * 2 * HALF_M) < 0.6, mass / (area * 2 * HALF_M))
        speed = np.sqrt(rock["vx"]**2 + rock["vy"]**2 + rock["vz"]**2)
        self.assertLess(np.median(speed), 0.2)


if __name__ == "__main__":
    unittest.main()
