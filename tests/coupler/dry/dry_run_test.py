"""`dipper run --no-rock`: the machine alone, and against an estimate of the rock."""

import json
import signal
import subprocess
import sys
import time
import unittest

import h5py
import numpy as np
import yaml

sys.path.insert(0, __file__.rsplit("/tests/", 1)[0] + "/tests/coupler/run")
sys.path.insert(0, __file__.rsplit("/tests/", 1)[0] + "/tests/analysis/report")
from browser import Browser
from runs import DIPPER, PATIENCE_S, SOURCE, TINY, RunTest

QUICK = SOURCE / "cases" / "quick"
NARROW = SOURCE / "tests/coupler/case/narrow"
COARSE = ("--set", "coupling.sync_steps=20")  # the machine is as exact, and three times as fast


class DryRun(RunTest):
    def report(self, run):
        subprocess.run([DIPPER, "report", run], check=True, capture_output=True)
        return run / "report" / "report.html"

    def test_machine_in_the_air(self):
        out = self.folder / "air"
        text, _ = self.run_case(out, "--no-rock", *COARSE, case=QUICK)
        summary = self.summary(out)
        self.assertEqual(summary["status"], "complete")
        self.assertEqual(summary["rock_model"], "none")
        self.assertEqual([p["payload_kg"] for p in summary["passes"]], [0])
        (one,) = summary["passes"]
        self.assertLess(abs(one["monitor_payload_kg"]), 1000, "the monitor knows the empty machine")
        self.assertNotIn("specific_dig_energy_J_kg", one, "nothing is loaded")
        self.assertEqual(max(summary["faces"][0]["up_m"]), 8.5, "the bench is where the dipper would dig")
        self.assertNotIn("above it", text, "an empty dipper asks no drive for too much")
        self.assertIn("drives: 0.0 s late", text)
        self.assertEqual(summary["drives"]["crowd_saturated_s"], 0)
        self.assertFalse((out / "dumps").exists(), "no rock, no frames")
        with h5py.File(out / "record.h5") as record:
            self.assertEqual(np.abs(record["bodies/dipper/wrench_mean"][:]).max(), 0)
            energy = record["machine/energy_residual"][:]
            self.assertLess(np.abs(energy).max(), 1e-4 * np.abs(record["machine/drive_work"][:]).max())

    def test_against_the_estimate(self):
        out = self.folder / "rock"
        machine = (SOURCE / "mbs/bucyrus495.yaml").read_text()
        weak = self.folder / "weak.yaml"
        weak.write_text(machine.replace("crowd_stall: {value: 3.0e6", "crowd_stall: {value: 2.4e6"))
        self.assertNotEqual(weak.read_text(), machine)
        text, _ = self.run_case(out, "--no-rock=estimate", *COARSE, "--set", f"machine.model={weak}", case=NARROW)
        summary = self.summary(out)
        (first,) = summary["passes"]
        # The struck volume at the pile's density, as the teeth sweep more than that.
        self.assertAlmostEqual(first["payload_kg"], 42 * 1903, delta=500)
        self.assertAlmostEqual(first["truck_kg"], 42 * 1903, delta=500)
        # LIGGGHTS's rock: 4.13 MN; a path is designed by a force that is right by a third.
        self.assertGreater(first["dig_phases_force_mean_N"], 2.2e6)
        self.assertLess(first["dig_phases_force_mean_N"], 4.3e6)
        self.check_outputs(out, first)
        limits = {row["name"]: row for row in summary["limits"]}
        self.assertGreater(limits["crowd_force"]["over_s"], 1)
        self.assertIn("warning: crowd_force reaches", text)
        with h5py.File(out / "record.h5") as record:
            force = np.abs(record["machine/crowd_force"][:])
            self.assertAlmostEqual(limits["crowd_force"]["most"], force.max())

        page = self.report(out)
        with Browser() as browser:
            browser.open(page)
            self.assertEqual(browser.run("return document.querySelectorAll('figure.way').length"), 1)
            walls = browser.run("return document.querySelector('canvas').stage.walls.map((wall) => wall.name)")
            self.assertEqual(sorted(walls), ["bench", "dipper", "door", "truck"])
            self.assertTrue(browser.run("return document.querySelector('canvas').stage.figure !== null"))
            drawn = browser.run("return document.querySelector('.way .teeth').getBBox().width")
            self.assertGreater(drawn, 8, "the teeth go some metres out")
            rows = browser.run("return document.querySelectorAll('#limits tbody tr').length")
            self.assertEqual(rows, len(summary["limits"]))
            self.assertEqual(browser.run("return document.querySelectorAll('#forces figure').length"), 5)
            names = "return [...document.querySelectorAll('#work tbody tr th')].map((e) => e.textContent)"
            phases = browser.run(names)
            self.assertEqual(phases, [row["phase"] for row in first["phases"]])

    def check_outputs(self, run, one):
        """Work by phase adds up to the drives' over the run; the monitor finds the load that is there."""
        self.assertTrue(one["monitor_at_rest"])
        inside_kg = one["monitor_inside_kg"]
        self.assertAlmostEqual(one["monitor_payload_kg"], inside_kg, delta=0.02 * inside_kg)
        dug = [row for row in one["phases"] if row["phase"] in ("penetrate", "fill", "breakout")]
        work = sum(row["hoist_work_J"] + row["crowd_work_J"] for row in dug)
        self.assertAlmostEqual(one["dig_work_J"], work, delta=1e-6 * work)
        self.assertAlmostEqual(one["specific_dig_energy_J_kg"], work / one["payload_kg"], delta=1e-6 * work)
        with h5py.File(run / "record.h5") as record:
            time, power = record["time_s"][:], record["machine/swing_power"][:]
        whole = np.sum((power[1:] + power[:-1]) / 2 * np.diff(time))
        self.assertAlmostEqual(sum(row["swing_work_J"] for row in one["phases"]), whole, delta=1e3)
        for row in one["phases"]:
            self.assertGreaterEqual(row["hoist_power_peak_W"], row["hoist_power_mean_W"])

    def test_another_machine_is_data_alone(self):
        out = self.folder / "another"
        self.run_case(out, "--no-rock=estimate", case=SOURCE / "cases" / "shovel20")
        (one,) = self.summary(out)["passes"]
        self.assertGreater(one["payload_kg"], 0.8 * 20 * 1903, "most of its 20 m3")
        self.assertLess(one["payload_kg"], 20.1 * 1903)
        inside_kg = one["monitor_inside_kg"]
        self.assertAlmostEqual(one["monitor_payload_kg"], inside_kg, delta=0.015 * inside_kg)
        machine = yaml.safe_load((SOURCE / "mbs" / "shovel20.yaml").read_text())
        for body in ("dipper", "door"):
            mesh = yaml.safe_load((SOURCE / "meshes" / "shovel20" / f"{body}.yaml").read_text())
            self.assertAlmostEqual(machine[body]["mass"]["value"], 7850 * mesh["solid_volume_m3"],
                                   delta=0.02 * machine[body]["mass"]["value"], msg=f"the {body}'s steel")

    def test_preview_is_the_page_alone(self):
        page = self.folder / "look.html"
        done = subprocess.run([DIPPER, "preview", TINY, "--out", page], text=True, capture_output=True, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(list(self.folder.iterdir()), [page])
        self.assertIn(str(page), done.stdout)
        self.assertGreater(page.stat().st_size, 1e5)

    def motion(self, *words, status=0):
        done = subprocess.run([DIPPER, "motion", QUICK, *words, "--out", "motion.csv"], text=True, capture_output=True,
                              cwd=self.folder)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_path_of_the_teeth_becomes_a_motion_over_the_pile(self):
        said = self.motion(SOURCE / "docs/data/path.csv", "--set", "machine.drives=prescribed")
        self.assertIn("the points are reached at 0.0 5.4", said)
        self.assertIn("warning: swing_torque reaches", said)
        names = ("motion.csv", "quick-motion.html")
        self.assertEqual(sorted(file.name for file in self.folder.iterdir()), sorted(names))
        run = self.folder / "run"
        self.run_case(run, "--no-rock", *COARSE, "--set", "machine.operator=motion",
                      f"machine.motion={self.folder / 'motion.csv'}", case=QUICK)
        points = np.genfromtxt(SOURCE / "docs/data/path.csv", delimiter=",", names=True, skip_header=1)
        with h5py.File(run / "record.h5") as record:
            out = np.hypot(record["rock/teeth_x"][:], record["rock/teeth_y"][:])
            up = record["rock/teeth_z"][:]
        for x, z in zip(points["x_m"], points["z_m"]):
            # The ropes stretch under the empty dipper by 0.2 m.
            self.assertLess(np.hypot(out - x, up - z).min(), 0.25)
        with Browser() as browser:
            browser.open(self.folder / "quick-motion.html")
            self.assertEqual(browser.run("return document.querySelectorAll('figure.way').length"), 1)

    def test_path_that_the_machine_cannot_follow_leaves_nothing(self):
        path = self.folder / "path.csv"
        head = "x_m,z_m,speed_m_s,wait_s,swing_deg,door_deg\n"
        path.write_text(head + "13.1,0.45,0,0,0,0\n18,2,3,0,0,0\n33,7,0,0,0,0\n")
        said = self.motion(path, status=2)
        self.assertIn("crowd is", said)
        self.assertIn("above the limit of 3.200 m", said)
        path.write_text(head + "13.1,0.45,0,0,0,0\n18,-1,1,0,0,0\n20,2,0,0,0,0\n")
        self.assertIn("lowest point is", self.motion(path, status=2))
        self.assertEqual(list(self.folder.iterdir()), [path])
        self.assertIn("excludes", self.motion(path, "--plan", "plan.yaml", status=2))

    def test_is_not_resumed_and_a_failed_one_is_no_run(self):
        out = self.folder / "whole"
        self.run_case(out, "--no-rock", case=TINY)
        settings = (out / "settings.txt").read_text()
        _, said = self.run_case(out, "--resume", "--set", "coupling.timeout_s=7", status=2, case=TINY)
        self.assertIn("holds a run without rock", said)
        self.assertEqual((out / "settings.txt").read_text(), settings)
        out = self.folder / "failed"
        for _ in range(2):
            _, said = self.run_case(out, "--no-rock=estimate", "--operator", "false", status=3, case=QUICK)
            self.assertFalse((out / "record.h5").exists(), said)

    def test_is_begun_anew(self):
        out = self.folder / "none"
        _, said = self.run_case(out, "--no-rock", "--resume", status=2)
        self.assertIn("--resume", said)
        self.assertFalse(out.exists())
        _, said = self.run_case(out, "--no-rock=sand", status=2)
        self.assertIn("none,estimate", said.replace(" ", "").replace("{", "").replace("}", ""))
        interrupted = self.start(out, "--no-rock", case=QUICK)
        while not (out / "record.h5").exists():
            self.assertIsNone(interrupted.poll())
            time.sleep(0.01)
        interrupted.send_signal(signal.SIGINT)
        _, said = interrupted.communicate(timeout=PATIENCE_S)
        self.assertEqual(interrupted.returncode, 4, said)
        self.assertIn("the same command starts it again", said)
        self.run_case(out, "--no-rock", case=TINY)
        before = json.loads((out / "summary.json").read_text())
        _, said = self.run_case(out, "--no-rock", case=TINY, status=2)
        self.assertIn("holds a run already", said)
        self.assertEqual(json.loads((out / "summary.json").read_text()), before)


if __name__ == "__main__":
    unittest.main()
