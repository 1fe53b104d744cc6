"""The optional rock physics in paired runs: each works there, and does what docs/physics_options.md says."""

import subprocess
import unittest

import h5py
import numpy as np

from runs import DIPPER, PATIENCE_S, RunTest, last_rocks, rocks, two_cores


def option(**keys):
    return [word for key, value in keys.items()
            for word in ("--set", f"{key.replace('__', '.')}={value}")]


ALL = option(contact__cohesion_Pa=3000, contact__adhesion_Pa=1000, crust__tensile_strength_Pa=2e5,
             crust__above_m=0.5, rock__fines_fraction=0.5, output__wall_stress="on",
             output__wear_m3_J=1e-12, seed=2)
# Rock without rolling friction, which would run off the bench.
LOOSE = option(contact__rolling_friction_sphere=0, contact__friction_sphere_sphere=0.2,
               contact__friction_sphere_rock=0.2, contact__friction_rock_rock=0.2, pile__settle_s=0.6,
               pile__relax_s=0.1, end_s=1.2, seed=2)


def column(file, name):
    with h5py.File(file / "record.h5", "r") as f:
        return f[name][:]


def face_angle(run):
    """Angle in degrees of the line through the highest rock of each 0.6 m of the face, at the end."""
    rock = last_rocks(run)
    x, top = rock["x"], rock["z"] + rock["radius"]
    edges = np.arange(x.min(), x.max(), 0.6)
    bins = [(x >= a) & (x < a + 0.6) for a in edges]
    surface = np.array([((a + 0.3), top[b].max()) for a, b in zip(edges, bins) if b.any()])
    crest = surface[:, 1].argmax()
    height = surface[crest, 1]
    face = (surface[:, 1] > 0.25 * height) & (surface[:, 1] < 0.85 * height)
    face[crest + 1:] = False
    return np.degrees(np.arctan(np.polyfit(*surface[face].T, 1)[0]))


def cell_arrays(file):
    """name -> values of a mesh dump."""
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    reader = vtk.vtkPolyDataReader()
    reader.SetFileName(str(file))
    reader.ReadAllScalarsOn()
    reader.Update()
    cells = reader.GetOutput().GetCellData()
    return {cells.GetArray(i).GetName(): vtk_to_numpy(cells.GetArray(i))
            for i in range(cells.GetNumberOfArrays())}


class RockPhysics(RunTest):
    @two_cores
    def test_everything_at_once_runs_resumes_and_replays(self):
        whole, parts = self.folder / "whole", self.folder / "parts"
        self.run_case(whole, *ALL)
        bonds = column(whole, "rock/bonds")
        self.assertGreater(bonds[0], 50)
        self.assertTrue((np.diff(bonds) <= 0).all(), "a bond has come back")
        self.assertLess(bonds[-1], bonds[0])
        self.assertEqual(self.summary(whole)["status"], "complete")

        first = sorted((whole / "dumps").glob("dipper_*.vtk"), key=lambda f: int(f.stem[7:]))
        worn = [cell_arrays(f)["wear"] for f in first]
        self.assertEqual(worn[0].max(), 0)
        self.assertGreater(worn[-1].max(), 0)
        self.assertTrue(all((b >= a).all() for a, b in zip(worn, worn[1:])), "wear went back")
        self.assertGreater(cell_arrays(first[-1])["normal_stress_average"].max(), 0)

        done = subprocess.run([DIPPER, "replay", whole, "--side", "dem"], text=True,
                              capture_output=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("bit for bit", done.stdout)

        self.run_case(parts, *ALL, "--set", "end_s=1.8")
        self.run_case(parts, "--set", "end_s=2.1", "--resume")
        resumed = column(parts, "rock/bonds")
        at = np.searchsorted(column(parts, "time_s"), 1.8 + 1e-9)
        self.assertEqual(resumed[at], bonds[at])  # the first row after the checkpoint
        np.testing.assert_allclose(resumed, bonds, atol=0.02 * bonds[0])
        again = cell_arrays(parts / "dumps" / first[-1].name)["wear"]
        np.testing.assert_allclose(again.sum(), worn[-1].sum(), rtol=0.05)

    def test_a_crust_and_moisture_hold_a_face_that_would_run(self):
        runs = {"loose": [], "moist": option(contact__cohesion_Pa=20000),
                "crust": option(crust__tensile_strength_Pa=2e6)}
        # Faces of 400 rocks differ by some degrees from seed to seed.
        seeds = range(1, 4)
        energy, angle = {}, {}
        for name, keys in runs.items():
            outs = [self.folder / f"{name}{seed}" for seed in seeds]
            for seed, out in zip(seeds, outs):
                self.run_case(out, *LOOSE, *keys, "--ranks", "1", "--seed", str(seed))
            energy[name] = np.mean([column(out, "rock/rock_kinetic_energy")[100:].mean() for out in outs])
            angle[name] = np.mean([face_angle(out) for out in outs])
        # The sheet stood at 35 degrees; loose, the face runs out to some 17.
        for name in ("moist", "crust"):
            self.assertLess(energy[name], 0.5 * energy["loose"], energy)
            self.assertGreater(angle[name], angle["loose"] + 8, angle)
        bonds = column(self.folder / "crust1", "rock/bonds")
        self.assertGreater(bonds[-1], 0.9 * bonds[0])

    def test_fines_add_their_mass(self):
        mass = {}
        for fines in (0, 1):
            out = self.folder / str(fines)
            self.run_case(out, "--set", f"rock.fines_fraction={fines}", "--set", "end_s=0.03",
                          "--ranks", "1")
            mass[fines] = column(out, "rock/rock_mass")[0]
        # The same bench, 1 + phi e times as heavy, but for which rocks its profile cuts off.
        self.assertAlmostEqual(mass[1] / mass[0], 1 + (1 - 1903 / 3215), delta=0.05)

    def test_rock_twice_as_heavy_on_contacts_twice_as_stiff_is_the_same_pile_to_the_bit(self):
        # Gravity, friction and shares of critical damping have no force in them, so that forces go with the density. By
        # two, and with stiffnesses that the tables' six digits hold, without a rounding: spheres, K_t 0.256 K_n.
        alike = ["--ranks", "1", "--set", "pile.toe_x_m=13.0", "--set", "contact.tangential_scale=0.256", "--set",
                 "rock.classes=[{name: d200, size_m: 0.2, mass_percent: 100, shapes: [sphere]}]"]
        frames, force_N = {}, {}
        for times in (1, 2):
            out = self.folder / str(times)
            self.run_case(out, *alike, *option(rock__density_kg_m3=3215 * times, contact__normal_scale=0.01 * times,
                                               rock__bulk_density_kg_m3=1903 * times, end_s=1.5))
            frames[times] = [rocks(out / "dumps" / f"rocks_{step}.dump.gz") for step in (0, 4000)]
            force_N[times] = column(out, "bodies/dipper/wrench_mean")[:, 3:]
        for light, heavy in zip(frames[1], frames[2]):
            for name in ("id", "x", "y", "z", "vx", "vy", "vz"):
                np.testing.assert_array_equal(light[name], heavy[name])
        touched = np.flatnonzero(force_N[1].any(axis=1))[0]  # from then on the ropes give in to what the rock weighs
        np.testing.assert_array_equal(2 * force_N[1][touched], force_N[2][touched])


if __name__ == "__main__":
    unittest.main()
