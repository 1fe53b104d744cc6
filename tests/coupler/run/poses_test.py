"""machine.kind poses: bodies of any name along a table, from the check to the report."""
import json
import re
import subprocess
import unittest

import h5py
import numpy as np

from runs import DIPPER, PATIENCE_S, SOURCE, TINY, RunTest

TABLE = """time_s,body,x_m,y_m,z_m,qw,qx,qy,qz
0,guard,-2,0,0.1,1,0,0,0
0,scoop,11.2,0,0.1,1,0,0,0
0.9,scoop,12.6,0,0.1,1,0,0,0
1.2,scoop,12.7,0,0.4,0.98480775,0,-0.17364818,0
"""


class Poses(RunTest):
    def case(self, table=TABLE, bodies=("scoop", "guard"), machine="kind: poses\n  poses: poses.csv"):
        """The tiny pile, and two buckets: one is pushed in, one stands aside."""
        folder = self.folder / "cases" / "mine"
        folder.mkdir(parents=True, exist_ok=True)
        text = (TINY / "case.yaml").read_text().replace("../../../../", f"{SOURCE}/")
        text = re.sub(r"end_s: .*\n", "", text)
        text = re.sub(r"(?sm)^truck:.*?\n\n", "", text)
        text = re.sub(r"(?sm)^machine:.*?\n\n", f"machine:\n  {machine}\n\n", text)
        meshes = "".join(f"  {name}: {SOURCE}/meshes/bucket.stl\n" for name in bodies)
        text = re.sub(r"(?sm)^bodies:.*?\n\n", f"bodies:\n{meshes}\n", text)
        (folder / "case.yaml").write_text(text)
        (folder / "poses.csv").write_text(table)
        return folder

    def dipper(self, *command, status=0):
        done = subprocess.run([DIPPER, *command], text=True, capture_output=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def test_a_run_follows_its_table_and_has_a_page(self):
        case, run = self.case(), self.folder / "run"
        self.run_case(run, "--ranks", "1", case=case)
        with h5py.File(run / "record.h5") as f:
            time_s, pose = f["time_s"][:], f["bodies/scoop/wall_pose"][:]
            at = np.searchsorted(time_s, 0.9 - 1e-9)
            np.testing.assert_allclose(pose[at, :3], [12.6, 0, 0.1], atol=1e-9)
            np.testing.assert_allclose(pose[-1], [12.7, 0, 0.4, 0.98480775, 0, -0.17364818, 0], atol=1e-7)
            force = np.linalg.norm(f["bodies/scoop/wrench_mean"][:, 3:], axis=1)
            self.assertGreater(force.max(), 1e3)
            self.assertEqual(np.abs(f["bodies/guard/wrench_mean"][:]).max(), 0)
            self.assertGreater(f["rock/mass_in_scoop"][-1], 100)
            self.assertEqual(f["rock/mass_in_guard"][-1], 0)
            # The rock's work is the force along the way.
            moved = np.diff(f["bodies/scoop/wall_pose"][:, 0], prepend=pose[0, 0])
            push = -(f["bodies/scoop/wrench_mean"][:, 3] * moved)[:at].sum()
            self.assertAlmostEqual(abs(f["coupling/rock_work"][at - 1]) / push, 1, delta=0.05)
        summary = self.summary(run)
        self.assertEqual(summary["passes"], [])
        self.assertLess(abs(summary["coupling"]["energy_residual_J"]),
                        1e-3 * abs(summary["coupling"]["interface_work_J"]))
        self.assertIn("bit for bit", self.dipper("replay", run, "--side", "dem"))
        self.assertIn("bit for bit", self.dipper("replay", run, "--side", "mbs"))
        self.dipper("report", run)
        metrics = json.loads((run / "report/metrics.json").read_text())
        self.assertNotIn("passes", metrics)
        self.assertGreater(metrics["frames"]["time_s"][-1], 1)

    def test_a_resumed_run_is_the_same(self):
        case, whole, parts = self.case(), self.folder / "whole", self.folder / "parts"
        self.run_case(whole, "--ranks", "1", case=case)
        self.run_case(parts, "--ranks", "1", "--set", "end_s=0.6", case=case)
        self.run_case(parts, "--ranks", "1", "--resume", "--set", "end_s=0", case=case)
        with h5py.File(whole / "record.h5") as a, h5py.File(parts / "record.h5") as b:
            for name in ("bodies/scoop/wall_pose", "bodies/scoop/wrench_mean"):
                x, y = a[name][:], b[name][:]
                np.testing.assert_allclose(x, y, rtol=0, atol=1e-9 * np.abs(x).max())

    def test_what_is_wrong_is_named(self):
        for change, said in (
                (dict(bodies=("scoop",)), r"poses.csv: body: guard is not under bodies in the case"),
                (dict(bodies=("scoop", "guard", "plate")), r"bodies.plate: has no row in machine.poses"),
                (dict(bodies=("scoop", "guard", "rocks")), r"bodies.rocks: the rock's scripts use this name"),
                (dict(machine="kind: poses"), r"machine.kind: poses needs machine.poses"),
                (dict(machine="kind: poses\n  poses: poses.csv\n  rake_angle_deg: 60"),
                 r"machine.rake_angle_deg: is not used by machine.kind poses"),
                (dict(machine="kind: poses\n  poses: none.csv"), r"machine.poses: no such file"),
                (dict(table=TABLE + "1.2,scoop,0,0,0,1,0,0,0\n"),
                 r"poses.csv:6:1: machine.poses: time_s is 1.2, not after"),
                (dict(table=TABLE + "9,scoop,99,0,0,1,0,0,0\n"), r"domain.max_m: the scoop leaves the domain")):
            self.assertRegex(self.dipper("check", self.case(**change), status=2), said)
        rows = [line.split(",") for line in TABLE.splitlines()[1:]]
        in_mm = "".join(",".join(r[:2] + [f"{1000 * float(v):g}" for v in r[2:5]] + r[5:]) + "\n" for r in rows)
        early = "".join(",".join([str(float(r[0]) - 3), *r[1:]]) + "\n" for r in rows)
        header = TABLE.splitlines()[0] + "\n"
        self.assertRegex(self.dipper("check", self.case(header + in_mm), status=2),
                         r"poses.csv: machine.poses: x_m,y_m,z_m go far beyond the domain: in mm, perhaps\?")
        self.assertRegex(self.dipper("check", self.case(header + early), status=2),
                         r"poses.csv: machine.poses: has no row after 0 s, where the run begins")
        self.assertIn("a case of poses has none", self.dipper("preview", self.case(), status=2))
        shovel = self.dipper("check", TINY, "--set", f"bodies.blade={SOURCE}/meshes/bucket.stl", status=2)
        self.assertIn("machine.kind: poses", shovel)

    def test_what_is_doubtful_is_warned_of(self):
        self.assertNotIn("warning:", self.dipper("check", self.case()))
        header, *rows = TABLE.splitlines()
        rows = [r.split(",") for r in rows]

        def table(change):
            return "\n".join([header, *(",".join(change(r)) for r in rows)]) + "\n"

        for changed, said in (
                (table(lambda r: r[:5] + r[6:] + r[5:6]),
                 r"poses.csv: machine.poses: qz is the largest of .* scalar last"),
                (table(lambda r: [f"{1e5 / 60 * float(r[0]):g}", *r[1:]]),
                 r"time_s has a row every \d+ s: in ms, perhaps"),
                (table(lambda r: [str(float(r[0]) + 4), *r[1:]]),
                 r"the first row is at 4 s; .* nothing moves until then"),
                (table(lambda r: [str(float(r[0]) - 0.5), *r[1:]]), r"the first row is at -0.5 s; .* is left out"),
                (TABLE.replace("0.9,scoop", "0.01,scoop"),
                 r"poses.csv:4: machine.poses: scoop moves 1.4 m in 0.01 s, 140 m/s: a wrong row"),
                (TABLE.replace("0.98480775,0,-0.17364818", "0.0871557,0,-0.9961947"),
                 r"poses.csv:5: machine.poses: scoop turns by 170 degrees from one row to the next")):
            with self.subTest(said):
                self.assertRegex(self.dipper("check", self.case(changed)), f"warning: .*{said}")
        case = self.case()
        text = (case / "case.yaml").read_text()
        (case / "sieve.csv").write_text("size_m,passing_percent\n0.2,0\n0.3,45\n0.5,80\n")
        (case / "case.yaml").write_text(re.sub(r"(?m)^  classes:.*\n(    .*\n)+",
                                               "  sieve: {file: sieve.csv, classes: 2}\n", text))
        self.assertIn("warning:", self.dipper("check", case), "the rock's warnings are not those of a shovel alone")


if __name__ == "__main__":
    unittest.main()
