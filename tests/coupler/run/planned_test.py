"""A run whose passes an operator plans and feels (docs/operator.md): it goes on from a checkpoint, and replays."""
import json
import subprocess
import unittest

import h5py
import numpy as np

from runs import DIPPER, PATIENCE_S, RunTest

PLAN = """source: "a test's"
sample_s: 0.25
cycle_s: 48
dig: [0.5, 18, 1]
swing_out: [13.5, 22, 2.5]
door_open: [22, 23.5, 0.6]
swing_back: [27, 36.5, 2.5]
back: [29.5, 43.5, 3]
door_close: [34.5, 37.5, 1]
lift_m: [[24.2, 11.4], [22.6, 14.3], [21.3, 15.2]]
lower_deg_m: [[8, 12.1], [-12, 11.35], [-30, 11.1], [-48, 11.1], [-60, 11.08]]
dump_deg: 80
door_deg: 75
choose:
  heading_deg: [0, 0, 1]
  depth_m: [0.5, 0.5, 0.1]
  floor_rise: [0.1, 0.1, 0.1]
  exit_z_m: [6, 6, 1]
  start_m: [12.95, 0.45]
  smooth_m: 3
  crowd_max_m: 2.95
  teeth_m_s: 1.2
"""
PLANNED = ("--ranks", "1", "--set", "machine.drives=limited", "--set", "machine.operator=plan",
           "--set", "operator.least_fill=0.01", "--set", "output.checkpoint_every_s=1.05", "--set",
           "dem.hold_below_m_s=0")


class Planned(RunTest):
    def test_goes_on_from_a_checkpoint_and_replays(self):
        plan = self.folder / "plan.yaml"
        plan.write_text(PLAN)
        settings = (*PLANNED, "--set", f"machine.plan={plan}")
        whole, parts = self.folder / "whole", self.folder / "parts"
        self.run_case(whole, *settings, "--set", "end_s=3.3")
        self.run_case(parts, *settings, "--set", "end_s=2.1")
        (parts / "operator/pass_2.json").write_text("{}")  # as a later pass that was not to be
        self.run_case(parts, "--set", "end_s=3.3", "--resume")
        self.assertFalse((parts / "operator/pass_2.json").exists())
        decision = json.loads((whole / "operator/pass_1.json").read_text())
        self.assertEqual(decision["rows"], json.loads((parts / "operator/pass_1.json").read_text())["rows"])
        self.assertGreater(max(decision["face"]["z_cm"]), 150, "the bench is seen")
        with h5py.File(whole / "record.h5") as a, h5py.File(parts / "record.h5") as b:
            for name in ("path_time", "hoist_lift", "load_felt", "crowd", "hoist_force"):
                np.testing.assert_array_equal(a["machine"][name][:], b["machine"][name][:], name)
            self.assertGreater(np.ptp(a["machine/load_felt"][:]), 100, "the operator feels the dig")
        for side in ("mbs", "dem"):
            done = subprocess.run([DIPPER, "replay", parts, "--side", side], capture_output=True, text=True,
                                  timeout=PATIENCE_S)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("bit for bit", done.stdout)
        done = subprocess.run([DIPPER, "replay", parts, "--side", "mbs", "--out", self.folder / "seen", "--set",
                               "machine.drives=prescribed"], capture_output=True, text=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("machine.operator: is plan", done.stderr)


if __name__ == "__main__":
    unittest.main()
