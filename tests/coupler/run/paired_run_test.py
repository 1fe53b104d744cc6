"""A short paired run through real LCM, LIGGGHTS and Simbody."""

import json
import os
import pathlib
import shutil
import struct
import subprocess
import time
import unittest

import h5py
import numpy as np

from runs import DIPPER, PATIENCE_S, TINY, RunTest, two_cores


ONE_RANK, TWO_RANKS = ("--ranks", "1"), ("--ranks", "2")
NO_CHECKPOINTS = ("--set", "output.checkpoint_every_s=0")
HOLD = ("--set", "dem.hold_below_m_s=0.3")


class PairedRun(RunTest):
    @two_cores
    def test_same_seed_same_state(self):
        first, second = self.shared(*TWO_RANKS), self.folder / "b"
        self.run_case(second, *TWO_RANKS)
        a, b = self.summary(first), self.summary(second)
        self.assertEqual(a["status"], "complete")
        self.assertEqual(len(a["state_hash"]), 64)
        self.assertEqual(a["state_hash"], b["state_hash"])
        self.assertEqual(a["coupling"]["foreign_messages"], 0)
        self.assertEqual(a["dem"]["steps"], 7000)
        self.assertEqual(a["coupling"]["syncs"], 700)
        self.check_record(first)
        self.check_dumps(first)

    def check_record(self, run):
        with h5py.File(run / "record.h5", "r") as f:
            t = f["time_s"][:]
            self.assertEqual(len(t), 701)
            np.testing.assert_allclose(t, np.arange(701) * 3e-3, atol=1e-12)
            for name in ("machine/hoist_force", "machine/crowd_force", "machine/rope_tension_left",
                         "machine/swing", "rock/mass_in_dipper", "bodies/dipper/wrench_mean",
                         "coupling/energy_residual"):
                self.assertEqual(len(f[name]), 701, name)
                self.assertTrue(f[name].attrs["unit"], name)
                self.assertTrue(f[name].attrs["frame"], name)
            self.assertIn(b"seed", f.attrs["case"])
            # The walls are where the machine is, but for the correction of the last window.
            for body in ("dipper", "door"):
                off = f[f"bodies/{body}/pose"][:, :3] - f[f"bodies/{body}/wall_pose"][:, :3]
                self.assertLess(np.abs(off).max(), 2e-3)
            # The dipper has met rock, and the rock pushes back, away from the face.
            force = f["bodies/dipper/wrench_mean"][:, 3:]
            self.assertGreater(np.linalg.norm(force, axis=1).max(), 1e5)
            self.assertLess(force[:, 0].min(), -1e5)

    def check_dumps(self, run):
        frames = {int(file.name.split(".")[0][6:]) for file in (run / "dumps").glob("rocks_*")}
        self.assertEqual(len(frames), 8, "of rock one file a frame")
        for series in ("dipper.vtk.series", "door.vtk.series", "truck.vtk.series"):
            frames = json.loads((run / "dumps" / series).read_text())["files"]
            self.assertEqual([round(f["time"], 6) for f in frames],
                             [round(0.3 * k, 6) for k in range(8)])
            for f in frames:
                self.assertTrue((run / "dumps" / f["name"]).stat().st_size > 0)

    def test_liggghts_own_loop_digs_as_the_fast_one_but_for_the_order_of_sums(self):
        fast, own = self.shared(*ONE_RANK, *NO_CHECKPOINTS), self.folder / "own"
        self.run_case(own, *ONE_RANK, *NO_CHECKPOINTS, "--set", "dem.loop=liggghts")
        self.assertEqual(self.summary(own)["status"], "complete")
        forces = []
        for run, is_fast in ((fast, True), (own, False)):
            self.assertEqual(json.loads((run / "logs/dem.json").read_text())["settings"]["fast_loop"], is_fast)
            with h5py.File(run / "record.h5", "r") as f:
                forces.append(np.linalg.norm(f["bodies/dipper/wrench_mean"][:, 3:], axis=1).mean())
        self.assertNotEqual(self.summary(own)["state_hash"], self.summary(fast)["state_hash"])
        # Settled with another order of sums, so few rocks dig as those of another seed.
        self.assertLess(abs(forces[1] / forces[0] - 1), 0.5)

    @two_cores
    def test_each_side_replays_to_the_bit(self):
        run = self.shared(*TWO_RANKS)
        for side, requests in (("dem", 700), ("mbs", 700)):
            done = self.replay(run, side)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("bit for bit", done.stdout)
            self.assertGreater(int(done.stdout.split()[1]), requests)

    def test_dumps_open_with_the_readers_users_have(self):
        reader = pathlib.Path(__file__).parents[2] / "scripts" / "dumps_open"
        done = subprocess.run([reader, self.shared(*ONE_RANK, *NO_CHECKPOINTS)], text=True, capture_output=True,
                              timeout=PATIENCE_S)
        if done.returncode == 77:
            self.skipTest("python3-vtk9 is not installed")
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_a_run_can_be_drawn(self):
        run = self.shared(*ONE_RANK, *NO_CHECKPOINTS)
        plot = pathlib.Path(__file__).parents[3] / "scripts" / "plot_run"
        done = subprocess.run([plot, run], text=True, capture_output=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater((run / "run.png").stat().st_size, 20000)

    @two_cores
    @unittest.skipIf(os.cpu_count() < 2, "two ranks need two cores")
    def test_other_work_on_a_core_takes_its_share_and_no_more(self):
        self.shared(*TWO_RANKS)  # with it, the pile
        took = []
        for name in ("alone", "beside"):
            busy = None if name == "alone" else subprocess.Popen(["sh", "-c", "while :; do :; done"])
            begin = time.monotonic()
            try:
                self.run_case(self.folder / name, *TWO_RANKS)
            finally:
                took.append(time.monotonic() - begin)
                if busy:
                    busy.kill()
                    busy.wait()
        # Three tasks on two cores; a rank that yielded to the other work took fifty times as long.
        self.assertLess(took[1], 8 * took[0])

    def test_serial_scheme_can_be_chosen(self):
        self.run_case(self.folder / "s", "--set", "coupling.scheme=serial", *ONE_RANK)
        self.assertEqual(self.summary(self.folder / "s")["coupling"]["scheme"], "serial")

    def test_limited_drives_end_with_their_path_and_go_on_to_the_bit(self):
        rows = (TINY.parents[3] / "tests/coupler/case/narrow/motion.csv").read_text().splitlines(True)
        motion = self.folder / "motion.csv"
        motion.write_text("".join(r for r in rows if not r[0].isdigit() or float(r.split(",")[0]) <= 2))
        settings = [*ONE_RANK, "--set", "machine.drives=limited", "--set", f"machine.motion={motion}"]
        run = self.folder / "limited"
        self.run_case(run, *settings, "--set", "end_s=1.8")
        self.run_case(run, "--set", "end_s=0", "--resume")  # the rest is as it was asked for
        summary = self.summary(run)
        self.assertEqual(summary["status"], "complete")
        drives = summary["drives"]
        self.assertAlmostEqual(drives["path_time_s"], 2, delta=0.01)
        self.assertAlmostEqual(drives["path_time_s"] + drives["late_s"], summary["sim_s"], places=6)
        with h5py.File(run / "record.h5") as f:
            path = f["machine/path_time"][:]
            self.assertTrue((np.diff(path) >= 0).all())
            self.assertLess(np.abs(f["machine/crowd_force"][:]).max(), 3.0e6 + 1)  # its stall
        text = self.run_case(run, "--resume")
        self.assertIn("complete already", text[0] + text[1])
        done = self.replay(run, "mbs")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("bit for bit", done.stdout)

    @two_cores
    def test_a_resumed_run_ends_like_an_uninterrupted_one(self):
        whole, parts = self.shared(*TWO_RANKS), self.folder / "parts"
        self.run_case(parts, *TWO_RANKS, "--set", "end_s=1.8")
        first = self.summary(parts)
        self.run_case(parts, "--set", "end_s=2.1", "--resume")
        both = self.summary(parts)
        self.assertEqual(both["dem"]["steps"], 7000)
        for side in ("dem", "mbs"):  # the second part, a sixth of the first, comes on top
            self.assertGreater(both[side]["cpu_s"], first[side]["cpu_s"])
        parts = parts.rename(self.folder / "moved to")
        for side in ("dem", "mbs"):
            done = self.replay(parts, side)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("of 2 segments", done.stdout)
            self.assertIn("bit for bit", done.stdout)
        self.change_an_answer(next(parts.glob("events-*.lcmlog")), b"DIPPER_FROM_MBS")
        done = self.replay(parts, "mbs")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("1 answers differ", done.stdout)
        with h5py.File(whole / "record.h5") as a, h5py.File(parts / "record.h5") as b:
            np.testing.assert_array_equal(a["time_s"][:], b["time_s"][:])
            np.testing.assert_array_equal(a["step_index"][:], b["step_index"][:])
            # To the bit up to the checkpoint. Then the lists are built at other steps and sums come in another
            # order; what that makes grows with every impact (docs/reliability.md).
            before = slice(0, np.searchsorted(b["time_s"][:], 1.8 + 1e-9))
            for name in ("bodies/dipper/pose", "bodies/dipper/wrench_mean", "machine/crowd_force"):
                np.testing.assert_array_equal(a[name][before], b[name][before], name)
            pose_a, pose_b = (f["bodies/dipper/pose"][:, :3] for f in (a, b))
            force_a, force_b = (f["bodies/dipper/wrench_mean"][:, 3:] for f in (a, b))
            peak = np.abs(force_a).max()
            following = before.stop
            np.testing.assert_allclose(pose_a[following], pose_b[following], rtol=0, atol=1e-12)
            np.testing.assert_allclose(force_a[following], force_b[following], rtol=0, atol=1e-12 * peak)
            np.testing.assert_allclose(pose_a, pose_b, rtol=0, atol=1e-9)
            np.testing.assert_allclose(force_a, force_b, rtol=0, atol=1e-9 * peak)

    def replay(self, run, side):
        return subprocess.run([DIPPER, "replay", run, "--side", side], text=True, capture_output=True,
                              timeout=PATIENCE_S)

    @staticmethod
    def change_an_answer(log, channel):
        """Flips the last bit of the last number in the log's fiftieth packet on `channel` with a number at its end: a
        prediction ends with how many channels it has, none."""
        data = bytearray(log.read_bytes())
        at = count = 0
        while count < 50:
            name, size = struct.unpack_from(">II", data, at + 20)
            at += 28 + name + size
            answer = bytes(data[at - size:at])
            count += data[at - size - name:at - size] == channel and answer[-4:] != bytes(4)
        changed = answer[:-1] + bytes([answer[-1] ^ 1])
        log.write_bytes(data.replace(answer, changed))  # it may have been sent again

    def test_checkpoints_change_nothing(self):
        for hold in ((), HOLD):
            often = self.folder / f"often{len(hold)}"
            self.run_case(often, *ONE_RANK, "--set", "output.checkpoint_every_s=0.03", *hold)
            never = self.shared(*ONE_RANK, *NO_CHECKPOINTS, *hold)
            self.assertEqual(self.summary(often)["state_hash"], self.summary(never)["state_hash"])

    def observed(self, *command):
        """hoist and crowd force of signals.csv that a command writes, kN."""
        out = self.folder / "observed"
        done = subprocess.run([DIPPER, *command, "--out", out, "--set", "observation.rate_Hz=5"],
                              text=True, capture_output=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 0, done.stderr)
        return np.loadtxt(out / "signals.csv", delimiter=",", skiprows=1)

    def test_effects_change_a_run_as_they_do_its_replayed_machine(self):
        run, worn = self.shared(*ONE_RANK, *NO_CHECKPOINTS), self.folder / "worn"
        self.run_case(worn, *ONE_RANK, "--set", "effects.crowd_friction=100")
        self.assertEqual(self.summary(worn)["effects"], {"crowd_friction": 100})
        # Friction does not move the dipper: the rock is the same to the bit.
        self.assertEqual(self.summary(run)["passes"][0]["payload_kg"],
                         self.summary(worn)["passes"][0]["payload_kg"])
        plain = self.observed("observe", run)
        (self.folder / "observed/profile.csv").write_text("pass,x_m,z_m,after\n")  # of an earlier run with a dump
        again = self.observed("replay", run, "--side", "mbs")
        np.testing.assert_allclose(again, plain, rtol=0, atol=1e-6)
        replayed = self.observed("replay", run, "--side", "mbs", "--set", "effects.crowd_friction=100")
        np.testing.assert_allclose(replayed, self.observed("observe", worn), rtol=0, atol=1e-3)
        # The crowd moves out from 1 s on; its force is 100 kN more, the hoist's the same.
        np.testing.assert_allclose(replayed[5:, 5] - plain[5:, 5], 100, atol=0.5)
        np.testing.assert_allclose(replayed[:, 4], plain[:, 4], rtol=1e-9)
        for place in (run / "observed", self.folder / "observed"):
            files = {p.name for p in place.iterdir()}
            self.assertEqual(files, {"channels.yaml", "passes.csv", "signals.csv"})  # no pass has dumped: no sections
        # A mine's own folder is no place for it.
        mine = self.folder / "mine"
        mine.mkdir()
        (mine / "channels.yaml").write_text("truck_mass_t: {unit: t, role: response, sigma: 2, common_sigma: 1}\n")
        for command in (("observe", run), ("replay", run, "--side", "mbs", "--set", "effects.crowd_friction=100")):
            done = subprocess.run([DIPPER, *command, "--out", mine], text=True, capture_output=True, timeout=PATIENCE_S)
            self.assertEqual(done.returncode, 2, done.stderr)
            self.assertIn("channels.yaml: --out: is no observation, and would be lost", done.stderr)
            self.assertEqual([p.name for p in mine.iterdir()], ["channels.yaml"])
        done = subprocess.run([DIPPER, "replay", run, "--side", "mbs", "--out", self.folder / "none"], text=True,
                              capture_output=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertIn("--out: goes with --set", done.stderr)
        face = json.loads((run / "faces" / "face_0.json").read_text())
        self.assertEqual((face["t_s"], face["axis_m"]), (0, [0, 0]))
        heights = np.array(face["z_cm"]).reshape(face["nx"], face["ny"]) / 100
        x = face["x0_m"] + (np.arange(face["nx"]) + 0.5) * face["cell_m"]
        top = np.median(heights, axis=1)
        self.assertAlmostEqual(top.max(), 2.5, delta=0.3)      # the bench, and the floor before its toe
        self.assertEqual(top[x < 13].max(), 0)
        # A machine that could not run is not replayed either: its dipper would be in the ground.
        sunk = ("--set", "machine.base_position_m=[0, 0, -5]")
        errors = subprocess.run([DIPPER, "check", TINY, *sunk], text=True, capture_output=True)
        done = subprocess.run([DIPPER, "replay", run, "--side", "mbs", "--out", self.folder / "no",
                               *sunk], text=True, capture_output=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 2, done.stderr)

        def found(text):
            return [line[line.index("domain.min_m:"):] for line in text.splitlines() if "domain.min_m:" in line]
        self.assertGreater(len(found(done.stderr)), 0)
        self.assertEqual(found(done.stderr), found(errors.stdout))
        self.assertFalse((self.folder / "no").exists())

    def test_a_case_that_is_elsewhere_now_is_named(self):
        gone = self.folder / "tests" / "coupler" / "run" / "gone"
        shutil.copytree(TINY, gone)
        for beside in ("meshes", "mbs", "cases"):  # the case names files there
            shutil.copytree(TINY.parents[3] / beside, self.folder / beside)
        self.run_case(self.folder / "run", "--ranks", "1", "--set", "end_s=0.3", case=gone)
        shutil.rmtree(gone)
        again = [DIPPER, "replay", self.folder / "run", "--side", "mbs", "--out", self.folder / "seen", "--set",
                 "effects.crowd_friction=100"]
        lost = subprocess.run(again, text=True, capture_output=True, timeout=PATIENCE_S)
        self.assertEqual(lost.returncode, 2)
        self.assertIn(str(gone), lost.stderr)
        found = subprocess.run([*again, "--case", TINY], text=True, capture_output=True, timeout=PATIENCE_S)
        self.assertEqual(found.returncode, 0, found.stderr)
        self.assertTrue((self.folder / "seen" / "signals.csv").is_file())

    def test_a_run_that_holds_rock_replays_and_resumes(self):
        whole = self.shared(*ONE_RANK, *NO_CHECKPOINTS, *HOLD)
        self.run_case(self.folder / "parts", "--set", "end_s=1.8", *ONE_RANK, *HOLD)
        self.run_case(self.folder / "parts", "--resume", "--set", "end_s=2.1")
        done = subprocess.run([DIPPER, "replay", whole, "--side", "dem"], text=True,
                              capture_output=True, timeout=PATIENCE_S)
        self.assertIn("bit for bit", done.stdout)
        with h5py.File(whole / "record.h5") as a, \
                h5py.File(self.folder / "parts" / "record.h5") as b:
            mass, parked = a["rock/rock_mass"][:], a["rock/rock_parked"][:]
            self.assertGreater(parked.max(), 0.2 * mass[0])
            self.assertEqual(parked[0], 0)
            np.testing.assert_allclose(mass, mass[0], rtol=1e-12)  # what is out is counted
            before = slice(0, np.searchsorted(b["time_s"][:], 1.8 + 1e-9))
            for name in ("bodies/dipper/wrench_mean", "rock/rock_parked"):
                np.testing.assert_array_equal(a[name][before], b[name][before], name)
            after = slice(before.stop, None)
            np.testing.assert_allclose(parked[after], b["rock/rock_parked"][after], rtol=1e-12)
            force_a, force_b = (f["bodies/dipper/wrench_mean"][after, 3:] for f in (a, b))
            np.testing.assert_allclose(force_a, force_b, rtol=0, atol=1e-9 * np.abs(force_a).max())

    def test_a_way_back_without_rock_goes_through_it(self):
        # The dig's first 2.5 s backwards, out of the bench; the door, having opened, closes from 0.5 s on.
        lines = (TINY / "motion.csv").read_text().splitlines()
        rows = [line.split(",") for line in lines if line[0].isdigit()][10::-1]
        door = {0.25: "5", 0.5: "10", 0.75: "5"}
        back = self.folder / "back.csv"
        back.write_text("time_s,hoist_m,crowd_m,swing_deg,door_deg\n" + "".join(
            f"{2.5 - float(row[0])},{row[1]},{row[2]},0,{door.get(2.5 - float(row[0]), '0')}\n" for row in rows))
        met = {}
        for contact in ("on", "off"):
            out = self.folder / contact
            self.run_case(out, *ONE_RANK, "--set", f"machine.motion={back}", "--set", "pile.clear_machine=on",
                          "--set", "end_s=1.5", "--set", f"machine.contact_on_return={contact}")
            with h5py.File(out / "record.h5") as f:
                met[contact] = np.abs(f["bodies/dipper/wrench_mean"][:][f["time_s"][:] > 0.55]).max()
        self.assertGreater(met["on"], 1e5)
        self.assertEqual(met["off"], 0)

    def test_without_dumps_only_those_of_the_start_are_left(self):
        run = self.folder / "quiet"
        self.run_case(run, *ONE_RANK, "--set", "output.dump_every_s=0", "--set", "end_s=0.9")
        self.assertEqual({file.name.split(".")[0] for file in (run / "dumps").glob("*_[0-9]*")},
                         {"rocks_0", "dipper_0", "door_0", "truck_0"})
        done = subprocess.run([DIPPER, "report", run], text=True, capture_output=True, timeout=PATIENCE_S)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_bad_input_starts_nothing_and_writes_nothing(self):
        out, err = self.run_case(self.folder / "x", "--set", "rock.density_t_m3=3.2",
                                 "--set", "coupling.sync_steps=0", status=2)
        self.assertIn("density_kg_m3", out)
        self.assertIn("sync_steps", out)
        self.assertFalse((self.folder / "x").exists())

    def test_a_result_is_never_written_over(self):
        self.run_case(self.folder / "once", "--set", "end_s=0.03", "--ranks", "1")
        before = (self.folder / "once" / "record.h5").read_bytes()
        _, err = self.run_case(self.folder / "once", status=2)
        self.assertIn("holds a run already", err)
        self.assertEqual((self.folder / "once" / "record.h5").read_bytes(), before)

    def test_resuming_what_is_complete_changes_nothing(self):
        run = self.folder / "done"
        self.run_case(run, "--set", "end_s=0.03", "--ranks", "1")
        before = (run / "summary.json").read_bytes()
        out, _ = self.run_case(run, "--resume")
        self.assertIn("complete already", out)
        self.assertEqual((run / "summary.json").read_bytes(), before)

    def test_a_run_goes_on_with_the_files_it_began_with(self):
        case, run = self.tiny_with_its_own_machine(), self.folder / "run"
        self.run_case(run, "--set", "end_s=0.03", "--ranks", "1", case=case)
        machine = case / "machine.yaml"
        machine.write_text(machine.read_text() + "# heavier\n")
        _, err = self.run_case(run, "--set", "end_s=0.06", "--ranks", "1", "--resume", case=case, status=2)
        self.assertIn(f"{machine} has changed", err)

    def test_wear_cannot_begin_when_a_run_is_resumed(self):
        run, one_rank = self.folder / "run", ("--ranks", "1")
        self.run_case(run, "--set", "end_s=0.03", *one_rank)
        _, err = self.run_case(run, "--set", "end_s=0.06", "--set", "output.wear_m3_J=1e-12", *one_rank, "--resume",
                               status=2)
        self.assertIn("output.wear_m3_J", err)

    def test_resuming_nothing_is_bad_usage(self):
        _, err = self.run_case(self.folder / "none", "--resume", status=2)
        self.assertIn("no run to resume", err)


if __name__ == "__main__":
    unittest.main()
