"""`dipper report` on a real run: what it writes agrees with the record, opens in VTK, and a folder that is not
whole gets no report at all."""

import csv
import gzip
import json
import re
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as xml

import h5py
import numpy as np
from vtkmodules.util import numpy_support
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from runs import DIPPER, PATIENCE_S, SOURCE, RunTest


class Report(RunTest):
    def report(self, folder, status=0):
        done = subprocess.run([DIPPER, "report", folder], capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_a_run(self):
        run = self.folder / "run"
        self.run_case(run, "--seed", "2", "--set", "output.wall_stress=on", "--set", "output.wear_m3_J=1e-12")
        self.report(run)
        metrics = json.loads((run / "report/metrics.json").read_text())
        self.check_masses(run, metrics)
        self.check_tables(run, metrics)
        self.check_walls(run, metrics)
        self.check_paraview(run, metrics)
        self.check_python(run, metrics)
        shutil.rmtree(run / "report")
        self.check_bad_input(run)

    def test_a_run_that_ends_one_row_into_its_last_phase(self):
        """The crowd begins to move at 0.498 s: breakout is the last tenth of a millisecond, in one row."""
        run = self.folder / "run"
        self.run_case(run, "--ranks", "1", "--set", "end_s=0.501")
        self.report(run)
        sys.path.insert(0, str(SOURCE / "analysis/runs"))
        from dipper_run import Run
        read = Run(run)
        phases = read.table("phases")
        with h5py.File(run / "record.h5") as f:
            force_N = np.hypot(f["machine/crowd_force"][-1], f["machine/hoist_force"][-1])
        self.assertEqual(phases["phase"][-1], "breakout")
        self.assertLess(phases["t_end_s"][-1] - phases["t_start_s"][-1], 3e-3)
        np.testing.assert_allclose(phases["dig_force_mean_N"][-3:], force_N, rtol=0.01)
        self.assertEqual(read.summary["passes"][0]["phases"][-1]["dig_force_mean_N"], phases["dig_force_mean_N"][-1])

    def test_a_killed_run_whose_record_is_behind_its_dumps(self):
        run = self.folder / "run"
        self.run_case(run, "--ranks", "1", "--set", "end_s=0.95")
        for name in ("manifest.sha256", "summary.json"):
            (run / name).unlink()
        with h5py.File(run / "record.h5", "r+") as f:
            rows = np.searchsorted(f["time_s"][:], 0.8)
            f.visititems(lambda _, data: data.resize(rows, axis=0) if isinstance(data, h5py.Dataset) else None)
        self.report(run)
        self.assertAlmostEqual(float(self.read_csv(run / "report/frames.csv")[-1]["time_s"]), 0.6, delta=0.01)

    def check_masses(self, run, metrics):
        frames = metrics["frames"]
        with h5py.File(run / "record.h5", "r") as f:
            rows = np.searchsorted(f["time_s"][:], np.array(frames["time_s"]) - 1e-9)
            # A clump's place in the dump is the middle of its spheres, in the record its centre of mass.
            np.testing.assert_allclose(frames["rock_kg"], f["rock/rock_mass"][:][rows], rtol=1e-5)
            np.testing.assert_allclose(frames["in_dipper_kg"], f["rock/mass_in_dipper"][:][rows], atol=500)
        self.assertGreater(max(frames["in_dipper_kg"]), 100)
        np.testing.assert_allclose(np.add(frames["flow_kg"], frames["bulk_kg"]), frames["in_dipper_kg"], atol=1e-6)
        one, = metrics["passes"]
        self.assertAlmostEqual(one["lifted_kg"], sum(one[k] for k in (
            "carry_back_kg", "back_in_pile_kg", "spillage_kg")) + metrics["frames"]["in_truck_kg"][-1], delta=1e-6)
        self.assertAlmostEqual(metrics["dipper"]["struck_volume_m3"], 42, delta=0.42)
        # The summary's figures are the page's, all of them; the fill factor is given by either density.
        summed = self.summary(run)["passes"][0]
        phases = summed.pop("phases")
        self.assertEqual({key: one.get(key) for key in summed}, summed)
        self.assertEqual(metrics["phases"], [{"pass": 1, **phase} for phase in phases])
        full_kg = 42 * one["load_bulk_density_kg_m3"]
        self.assertAlmostEqual(one["fill_factor_load"], one["payload_kg"] / full_kg, delta=1e-9)
        self.assertAlmostEqual(one["fill_factor"], one["payload_kg"] / (42 * 1903), delta=1e-9)
        self.assertAlmostEqual(sum(s["pile_percent"] for s in metrics["sizes"]), 100, delta=1e-9)

    def check_python(self, run, metrics):
        """The snippet of docs/python.md as it stands there."""
        snippet, = re.findall(r"^```python\n(.*?)^```$", (SOURCE / "docs/python.md").read_text(), re.M | re.S)
        said = "print(payload_t, len(hoist_MN), max(in_dipper_kg), len(last['radius']))"
        done = subprocess.run(["/usr/bin/python3", "-c", snippet.replace("runs/quick", str(run)) + said],
                              env={"PYTHONPATH": str(SOURCE / "analysis/runs")}, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        summary = self.summary(run)
        payload_t, rows, most_kg, spheres = map(float, done.stdout.split())
        self.assertEqual(payload_t, summary["passes"][0]["payload_kg"] / 1000)
        self.assertEqual(most_kg, max(metrics["frames"]["in_dipper_kg"]))
        self.assertEqual((rows, spheres), (summary["coupling"]["syncs"] + 1, summary["dem"]["particles"]))

    def check_tables(self, run, metrics):
        self.assertEqual(metrics["dipper"]["cavity"]["max_m"], [4.0, 2.0, 1.5], "up to the lip, without the heap")
        for name in ("frames", "phases", "pile", "sizes", "passes"):
            rows = self.read_csv(run / f"report/{name}.csv")
            table = metrics[name]
            if isinstance(table, list):
                self.assertEqual(len(rows), len(table), name)
        rows = self.read_csv(run / "report/frames.csv")
        self.assertEqual([float(r["in_dipper_kg"]) for r in rows], metrics["frames"]["in_dipper_kg"])

    def check_walls(self, run, metrics):
        """The teeth have dug: pressure times area is of the order of the dig force, wear has grown on some."""
        fields = {(w["body"], w["field"]): w for w in metrics["walls"]}
        self.assertEqual(len(fields), 6)
        wear = self.read_csv(run / "report/wall_dipper_wear.csv")
        self.assertEqual(len(wear), 352)
        worn = [float(t["last"]) for t in wear]
        self.assertGreater(sum(w > 0 for w in worn), 3)
        self.assertAlmostEqual(max(worn) / fields["dipper", "wear"]["max_over_time"], 1, delta=1e-5)  # it never heals
        pressure = self.read_csv(run / "report/wall_dipper_normal_stress_average.csv")
        force = sum(float(t["last"]) * float(t["area_m2"]) for t in pressure)
        peak = metrics["passes"][0]["dig_force_peak_N"]
        self.assertTrue(0.01 * peak < force < 5 * peak, (force, peak))

    def read_csv(self, file):
        with file.open() as lines:
            return list(csv.DictReader(lines))

    def check_paraview(self, run, metrics):
        """run.pvd lists each part at each time, and VTK's reader, which is ParaView's, reads what it lists."""
        root = xml.parse(run / "report/run.pvd").getroot()
        self.assertEqual((root.tag, root.get("type")), ("VTKFile", "Collection"))
        sets = root.findall("Collection/DataSet")
        names = {s.get("part"): s.get("name") for s in sets}
        self.assertEqual(sorted(names.values()), [
            "bail", "crawlers", "dipper", "door", "handle", "house", "rocks", "ropes", "saddle", "truck",
            "truck outline"])
        for part in names:
            times = [float(s.get("timestep")) for s in sets if s.get("part") == part]
            np.testing.assert_allclose(times, metrics["frames"]["time_s"], atol=1e-9)
        data = {s.get("name"): self.read_vtp(run / "report" / s.get("file")) for s in sets}  # the last of each
        self.assertEqual(data["rocks"].GetNumberOfPoints(), metrics["run"]["particles"])
        self.assertGreater(data["rocks"].GetPointData().GetArray("radius").GetRange()[0], 0)
        self.check_rocks(data["rocks"], metrics)
        self.assertEqual([data[w].GetNumberOfPolys() for w in ("dipper", "door", "truck")], [352, 76, 632])
        with h5py.File(run / "record.h5", "r") as f:
            x = f["bodies/dipper/wall_pose"][-1, 0]
        low, high = data["dipper"].GetBounds()[:2]
        self.assertTrue(low - 1 < x < high + 1, (low, x, high))
        bail = data["bail"].GetBounds()
        self.assertTrue(low - 1 < bail[0] and bail[1] < high + 1, (low, bail, high))
        self.assertAlmostEqual(data["crawlers"].GetBounds()[4], 0, places=6)
        files = {s.get("file") for s in sets if s.get("name") == "crawlers"}
        self.assertEqual(len(files), 1, "what stands still is one file")

    def check_rocks(self, rocks, metrics):
        """Each sphere carries its rock's data: number of rocks, sizes and load are those of metrics.json."""
        column = {name: numpy_support.vtk_to_numpy(rocks.GetPointData().GetArray(name))
                  for name in ("rock", "size", "in_dipper", "shape", "type", "id_multisphere")}
        self.assertEqual(len(set(column["rock"])), metrics["run"]["rocks"])
        for row in metrics["sizes"]:
            np.testing.assert_allclose(column["size"][column["type"] == row["class"]], row["size_m"], rtol=1e-4)
        single = column["id_multisphere"] < 0
        self.assertTrue((column["shape"][single] == 0).all())
        self.assertEqual(set(column["shape"][~single]), {1, 2, 3})
        self.assertEqual(column["in_dipper"].any(), metrics["frames"]["in_dipper_kg"][-1] > 0)

    def read_vtp(self, file):
        problems = []
        reader = vtkXMLPolyDataReader()
        for event in ("ErrorEvent", "WarningEvent"):
            reader.AddObserver(event, lambda *_: problems.append(event))
        reader.SetFileName(str(file))
        reader.Update()
        self.assertFalse(problems, file)
        return reader.GetOutput()

    def check_bad_input(self, run):
        dumps = run / "dumps"
        frame = sorted(dumps.glob("rocks_*.dump.gz"), key=lambda p: int(re.findall(r"\d+", p.name)[-1]))[-1]
        text = gzip.decompress(frame.read_bytes()).decode()

        def put(text):
            frame.write_bytes(gzip.compress(text.encode()))

        def refused(what, message, file=frame):
            with self.subTest(what):
                said = self.report(run, status=2)
                self.assertRegex(said, message)
                self.assertIn(file.name, said)
                self.assertFalse((run / "report").exists())
                self.assertFalse(list(run.glob(".report*")))

        put(text[:len(text) // 2])
        refused("cut short", r"\.dump\.gz:\d+: .*cut short")
        put(text.replace("vx vy vz omegax omegay omegaz radius", "vx vy vz omegax omegay omegaz q"))
        refused("no radius", r"\.dump\.gz:9: particles without radius")
        rows = text.split("\n")
        rows[3] = str(int(rows[3]) // 2)
        put("\n".join(rows[:9 + int(rows[3])]) + "\n")
        refused("another pile", r"\.dump\.gz:\d+: .* t of rock at .*another run")
        put(text.replace("\n-12 32\n", "\n-10 30\n"))
        refused("another box", r"\.dump\.gz:6: the box .*another run")
        put(text)
        middle = sorted(dumps.glob("rocks_*.dump.gz"), key=lambda p: int(re.findall(r"\d+", p.name)[-1]))[3]
        middle.rename(self.folder / middle.name)
        refused("missing frame", r"dumps: the frame of step \d+ is missing", file=dumps)
        (self.folder / middle.name).rename(middle)
        wall = dumps / frame.name.replace("rocks", "dipper").replace(".dump.gz", ".vtk")
        whole = wall.read_text()
        wall.write_text((dumps / "dipper_0.vtk").read_text())
        refused("another wall", r"\.vtk:5: dipper is .* m from where the record has it", file=wall)
        wall.write_text(whole)
        self.report(run)


if __name__ == "__main__":
    unittest.main()
