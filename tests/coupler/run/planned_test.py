"""A run whose passes an operator plans and feels (docs/operator.md): it goes on from a checkpoint, and replays."""
import json
import subprocess
import unittest

import h5py
import numpy as np

from runs import DIPPER, PATIENCE_S, SOURCE, RunTest

CHOOSE = """choose:
  heading_deg: [0, 0, 1]
  depth_m: [0.5, 0.5, 0.1]
  floor_rise: [0.1, 0.1, 0.1]
  exit_z_m: [2, 2, 1]
  start_m: [12.8, 0.5]
  smooth_m: 3
  crowd_max_m: 2.95
  teeth_m_s: 1.2
"""
PLANNED = ("--ranks", "1", "--set", "machine.drives=limited", "--set", "machine.operator=plan",
           "--set", "operator.least_fill=0.01", "--set", "output.checkpoint_every_s=1.1", "--set", "dem.hold_below_m_s=0")


class Planned(RunTest):
    def test_goes_on_from_a_checkpoint_and_replays(self):
        cycle = (SOURCE / "cases/aitik/plan.yaml").read_text().split("passes:")[0]
        plan = self.folder / "plan.yaml"
        plan.write_text(cycle + CHOOSE)
        settings = (*PLANNED, "--set", f"machine.plan={plan}")
        whole, parts = self.folder / "whole", self.folder / "parts"
        self.run_case(whole, *settings, "--set", "end_s=3.3")
        self.run_case(parts, *settings, "--set", "end_s=2.2")
        (parts / "operator/pass_2.json").write_text("{}")  # as a later pass that was not to be
        self.run_case(parts, "--set", "end_s=3.3", "--resume")
        self.assertFalse((parts / "operator/pass_2.json").exists())
        decision = json.loads((whole / "operator/pass_1.json").read_text())
        self.assertEqual(decision["rows"], json.loads((parts / "operator/pass_1.json").read_text())["rows"])
        self.assertGreater(max(decision["face"]["z_cm"]), 150, "the bench is seen")
        with h5py.File(whole / "record.h5") as a, h5py.File(parts / "record.h5") as b:
            for name in ("path_time", "hoist_lift", "load_felt", "crowd", "hoist_force"):
                np.testing.assert_array_equal(a["machine"][name][:], b["machine"][name][:], name)
            self.assertGreater(np.ptp(a["machine/load_felt"][:]), 100, "he feels the dig")
        for side in ("mbs", "dem"):
            done = subprocess.run([DIPPER, "replay", parts, "--side", side], capture_output=True, text=True,
                                  timeout=PATIENCE_S)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("to the bit", done.stdout)


if __name__ == "__main__":
    unittest.main()
