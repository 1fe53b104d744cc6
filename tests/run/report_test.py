"""`dipper report` on a real run: what it writes agrees with the record, opens in VTK, and a folder that is not
whole gets no report at all."""

import csv
import json
import re
import shutil
import subprocess
import unittest

import h5py
import numpy as np
from vtkmodules.vtkIOXML import vtkXMLCollectionReader

from runs import DIPPER, RunTest


class Report(RunTest):
    def report(self, folder, status=0):
        done = subprocess.run([DIPPER, "report", folder], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_a_run(self):
        run = self.folder / "run"
        self.run_case(run)
        self.report(run)
        metrics = json.loads((run / "report/metrics.json").read_text())
        self.check_masses(run, metrics)
        self.check_tables(run, metrics)
        self.check_paraview(run, metrics)
        shutil.rmtree(run / "report")
        self.check_bad_input(run)

    def check_masses(self, run, metrics):
        frames = metrics["frames"]
        with h5py.File(run / "record.h5", "r") as f:
            rows = np.searchsorted(f["time_s"][:], np.array(frames["time_s"]) - 1e-9)
            # A clump's place in the dump is the middle of its spheres, in the record its centre of mass.
            np.testing.assert_allclose(frames["rock_kg"], f["rock/rock_mass"][:][rows], rtol=1e-5)
            np.testing.assert_allclose(frames["in_dipper_kg"], f["rock/mass_in_dipper"][:][rows], atol=500)
        self.assertGreater(max(frames["in_dipper_kg"]), 500)
        np.testing.assert_allclose(np.add(frames["flow_kg"], frames["bulk_kg"]), frames["in_dipper_kg"], atol=1e-6)
        one, = metrics["passes"]
        self.assertAlmostEqual(one["lifted_kg"], sum(one[k] for k in (
            "carry_back_kg", "back_in_pile_kg", "spillage_kg")) + metrics["frames"]["in_truck_kg"][-1], delta=1e-6)
        self.assertAlmostEqual(metrics["dipper"]["struck_volume_m3"], 42, delta=0.42)
        self.assertEqual(one["dig_force_peak_N"], self.summary(run)["passes"][0]["dig_force_peak_N"])
        self.assertAlmostEqual(sum(s["pile_percent"] for s in metrics["sizes"]), 100, delta=1e-9)

    def check_tables(self, run, metrics):
        for name in ("frames", "phases", "pile", "sizes", "passes"):
            rows = list(csv.DictReader((run / f"report/{name}.csv").open()))
            table = metrics[name]
            if isinstance(table, list):
                self.assertEqual(len(rows), len(table), name)
        rows = list(csv.DictReader((run / "report/frames.csv").open()))
        self.assertEqual([float(r["in_dipper_kg"]) for r in rows], metrics["frames"]["in_dipper_kg"])

    def check_paraview(self, run, metrics):
        """VTK's own reader of collections, which is ParaView's."""
        problems = []
        reader = vtkXMLCollectionReader()
        for event in ("ErrorEvent", "WarningEvent"):
            reader.AddObserver(event, lambda *_: problems.append(1))
        reader.SetFileName(str(run / "report/run.pvd"))
        reader.UpdateInformation()
        times = [reader.GetAttributeValue(0, k) for k in range(reader.GetNumberOfAttributeValues(0))]
        self.assertEqual(sorted(float(t) for t in times), metrics["frames"]["time_s"])
        reader.SetRestriction("timestep", times[-1])
        reader.Update()
        parts = [reader.GetOutput().GetBlock(k).NewIterator() for k in range(4)]
        data = []
        for part in parts:
            part.InitTraversal()
            data.append(part.GetCurrentDataObject())
        self.assertFalse(problems)
        self.assertEqual(data[0].GetNumberOfPoints(), metrics["run"]["particles"])
        self.assertGreater(data[0].GetPointData().GetArray("radius").GetRange()[0], 0)
        self.assertEqual([d.GetNumberOfPolys() for d in data[1:]], [352, 76, 632])
        with h5py.File(run / "record.h5", "r") as f:
            x = f["bodies/dipper/wall_pose"][-1, 0]
        low, high = data[1].GetBounds()[:2]
        self.assertTrue(low - 1 < x < high + 1, (low, x, high))

    def check_bad_input(self, run):
        dumps = run / "dumps"
        frame = sorted(dumps.glob("rocks_*.dump"), key=lambda p: int(re.findall(r"\d+", p.name)[-1]))[-1]
        text = frame.read_text()

        def refused(what, message, file=frame):
            with self.subTest(what):
                said = self.report(run, status=2)
                self.assertRegex(said, message)
                self.assertIn(file.name, said)
                self.assertFalse((run / "report").exists())
                self.assertFalse(list(run.glob(".report*")))

        frame.write_text(text[:len(text) // 2])
        refused("cut short", r"\.dump:\d+: .*cut short")
        frame.write_text(text.replace("x y z vx vy vz omegax omegay omegaz radius", "x y z vx vy vz omegax omegay omegaz q"))
        refused("no radius", r"\.dump:9: particles without radius")
        rows = text.split("\n")
        rows[3] = str(int(rows[3]) - 500)
        frame.write_text("\n".join(rows[:9 + int(rows[3])]) + "\n")
        refused("another pile", r"\.dump:\d+: .* t of rock at .*another run")
        frame.write_text(text.replace("\n-12 32\n", "\n-10 30\n"))
        refused("another box", r"\.dump:6: the box .*another run")
        frame.write_text(text)
        middle = sorted(dumps.glob("rocks_*.dump"), key=lambda p: int(re.findall(r"\d+", p.name)[-1]))[3]
        middle.rename(self.folder / middle.name)
        refused("missing frame", r"dumps: the frame of step \d+ is missing", file=dumps)
        (self.folder / middle.name).rename(middle)
        wall = dumps / frame.name.replace("rocks", "dipper").replace(".dump", ".vtk")
        whole = wall.read_text()
        wall.write_text((dumps / "dipper_0.vtk").read_text())
        refused("another wall", r"\.vtk:5: dipper is .* m from where the record has it", file=wall)
        wall.write_text(whole)
        self.report(run)


if __name__ == "__main__":
    unittest.main()
