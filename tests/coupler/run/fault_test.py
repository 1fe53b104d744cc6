"""Kill, stop or starve a side at any moment: a clear end within seconds, and no process left."""

import hashlib
import os
import pathlib
import re
import shutil
import signal
import tempfile
import time
import unittest
import unittest.mock

import h5py

from runs import DIPPER, PATIENCE_S, SOURCE, STEP_S, WINDOW, RunTest, processes, two_cores


# Long enough that on any machine there is something left to kill; a record is flushed each second.
LONGER = ("--set", "end_s=4.5")


class Faults(RunTest):
    def pids(self, out, name):
        return [pid for pid, program in processes(out) if program == name]

    def assert_ended(self, process, out, status, *words, within=5.0):
        """The run ends in time, says all the words on stderr, and leaves nobody behind."""
        began = time.time()
        try:
            _, err = process.communicate(timeout=within)
        except Exception:
            process.kill()
            raise
        self.assertLess(time.time() - began, within)
        self.assertEqual(process.returncode, status, err)
        for word in words:
            self.assertIn(word, err)
        deadline = time.time() + 2
        while processes(out) and time.time() < deadline:
            time.sleep(0.05)
        self.assertEqual(processes(out), [])
        self.assertEqual(list(pathlib.Path().glob("restart_forced*")), [], "LIGGGHTS's, where the user stands")
        return err

    def go_on(self, out):
        """Resumes a run that was cut short, and ends it soon; the steps it then has."""
        end_s = self.soon_after(out)
        self.run_case(out, "--resume", "--set", f"end_s={end_s}")
        return round(end_s / STEP_S)

    def digging(self, name, *arguments, time_s=0.7, ranks=1):
        out = self.folder / name
        process = self.start(out, *LONGER, *arguments, "--ranks", str(ranks))
        self.wait_until_digging(process, out, time_s)
        return process, out

    def test_a_killed_machine_side(self):
        process, out = self.digging("mbs")
        os.kill(self.pids(out, "dipper-mbs")[0], signal.SIGKILL)
        self.assert_ended(process, out, 3, "the mbs side failed at t = ", "killed by signal 9",
                          "last checkpoint", "--resume")
        self.assertEqual(self.summary(out)["status"], "failed")
        with h5py.File(out / "record.h5") as f:  # opens, with what had been flushed
            self.assertGreater(len(f["time_s"]), 0)

    @two_cores
    def test_a_killed_rank(self):
        process, out = self.digging("rank", ranks=2)
        os.kill(self.pids(out, "dipper-dem")[-1], signal.SIGKILL)
        self.assert_ended(process, out, 3, "the dem side failed at t = ", "signal 9")

    @two_cores
    def test_a_killed_mpirun(self):
        process, out = self.digging("mpirun", ranks=2)
        os.kill(self.pids(out, "mpirun")[0], signal.SIGKILL)
        err = self.assert_ended(process, out, 3, "the dem side failed at t = ",
                                "mpirun was killed by signal 9")
        self.assertNotIn("WARNING", err)

    @two_cores
    def test_a_killed_launcher_leaves_no_orphan(self):
        process, out = self.digging("launcher", ranks=2)
        process.kill()
        process.communicate()
        deadline = time.time() + 5
        while processes(out) and time.time() < deadline:
            time.sleep(0.05)
        self.assertEqual(processes(out), [])

    def test_a_side_that_hangs(self):
        process, out = self.digging("hang", "--set", "coupling.timeout_s=2")
        os.kill(self.pids(out, "dipper-mbs")[0], signal.SIGSTOP)
        self.assert_ended(process, out, 3, "the mbs side failed at t = ", "no answer for 2 s",
                          within=8)

    def test_a_run_that_hangs_ends_on_a_scheduler_s_sigterm(self):
        """Long before coupling.timeout_s, whichever side hangs."""
        hung = []
        for name in ("dipper-mbs", "dipper-dem"):
            process, out = self.digging(name, "--set", "coupling.timeout_s=200")
            os.kill(self.pids(out, name)[0], signal.SIGSTOP)
            process.send_signal(signal.SIGTERM)
            hung.append((process, out, name.removeprefix("dipper-")))
        for process, out, side in hung:
            self.assert_ended(process, out, 3, f"the {side} side failed at t = ", "no answer for 1", "--resume",
                              within=25)
            self.assertEqual(self.summary(out)["status"], "failed")

    def test_a_settling_that_hangs_ends_on_sigterm(self):
        process, out = self.settling("hung", "--set", "pile.settle_s=60", "--set", "coupling.timeout_s=200",
                                     "--ranks", "1")
        deadline = time.time() + 60
        while not self.pids(out, "dipper-liggghts") and time.time() < deadline:
            time.sleep(0.05)
        os.kill(self.pids(out, "dipper-liggghts")[0], signal.SIGSTOP)
        process.send_signal(signal.SIGTERM)
        self.assert_ended(process, out, 4, "interrupted", within=10)

    def test_killed_while_starting(self):
        out = self.folder / "early"
        process = self.start(out, "--ranks", "1")
        deadline = time.time() + 60
        while not self.pids(out, "dipper-mbs") and time.time() < deadline:
            time.sleep(0.01)
        os.kill(self.pids(out, "dipper-mbs")[0], signal.SIGKILL)
        self.assert_ended(process, out, 3, "the mbs side failed at t = 0.0000 s")

    @two_cores
    def test_ctrl_c_ends_cleanly_and_can_be_resumed(self):
        process, out = self.digging("interrupt", ranks=2)
        process.send_signal(signal.SIGINT)
        self.assert_ended(process, out, 4, "interrupted at t = ", "--resume")
        self.assertEqual(self.summary(out)["status"], "interrupted")
        # On to where it stands: no window is taken, and nothing is said otherwise than before.
        self.run_case(out, "--resume", "--set", f"end_s={self.summary(out)['sim_s']}")
        self.assertGreater(self.summary(out)["dem"]["particles"], 100)
        steps = self.go_on(out)
        self.assertEqual(self.summary(out)["status"], "complete")
        self.assertEqual(self.summary(out)["dem"]["steps"], steps)

    def test_a_closed_terminal_is_an_interrupt(self):
        out = self.folder / "terminal"
        process = self.start(out, *LONGER, "--ranks", "1")
        process.stdout.readline()  # what is written after it has no reader
        process.stdout.close()
        process.stdout = None
        self.wait_until_digging(process, out, 0.7)
        process.send_signal(signal.SIGHUP)
        self.assert_ended(process, out, 4, "interrupted at t = ", "--resume")

    def test_one_run_writes_a_folder(self):
        process, out = self.digging("live")
        for more in ((), ("--resume",)):
            _, err = self.run_case(out, *LONGER, *more, status=2)
            self.assertIn(f"another run is writing it (process {process.pid})", err)
        process.send_signal(signal.SIGINT)
        self.assert_ended(process, out, 4, "interrupted at t = ")

    def test_a_killed_run_resumes_from_its_last_checkpoint(self):
        process, out = self.digging("killed", time_s=1.3)
        os.kill(self.pids(out, "dipper-dem")[0], signal.SIGKILL)
        err = self.assert_ended(process, out, 3, "last checkpoint")
        failed, saved = (float(t) for t in re.findall(r"t = (\d+\.\d+) s", err))
        self.assertLessEqual(saved, failed)
        self.assertLess(failed - saved, 0.6 + 0.01)  # one every 0.6 s
        steps = self.go_on(out)
        with h5py.File(out / "record.h5") as f:
            self.assertEqual(len(f["time_s"]), steps // WINDOW + 1)

    def test_a_killed_run_without_checkpoints_does_not_lose_its_record(self):
        process, out = self.digging("bare", "--set", "output.checkpoint_every_s=0")
        os.kill(self.pids(out, "dipper-dem")[0], signal.SIGKILL)
        self.assert_ended(process, out, 3, "no checkpoint yet")
        record = (out / "record.h5").read_bytes()
        _, err = self.run_case(out, "--resume", status=2)
        self.assertIn("holds no checkpoint of this run, which came to t = ", err)
        self.assertEqual((out / "record.h5").read_bytes(), record)

    def test_a_liggghts_error_reaches_the_user_as_liggghts_wrote_it(self):
        cache = self.folder / "cache"
        os.environ["XDG_CACHE_HOME"] = str(cache)
        self.addCleanup(os.environ.pop, "XDG_CACHE_HOME")
        first = self.folder / "first"
        self.run_case(first, "--set", "end_s=0.03", "--ranks", "1")
        pile = next(cache.glob("dipper/piles/*/pile.restart"))
        pile.write_bytes(b"this is no restart file" * 100)
        with open(pile.parent / "manifest.sha256", "w") as f:  # as if it had been written so
            f.write(f"{hashlib.sha256(pile.read_bytes()).hexdigest()}  pile.restart\n# files: 1\n")
        process = self.start(self.folder / "second", "--set", "end_s=0.03", "--ranks", "1")
        self.assert_ended(process, self.folder / "second", 3, "the dem side failed", "ERROR",
                          within=10)

    def with_deck(self, name, before, more, change=("", "")):
        """DIPPER_DATA whose dem_in/NAME has the lines `more` before its last line that begins with `before`, and other
        words in that line."""
        data = pathlib.Path(tempfile.mkdtemp(dir=self.folder))
        for entry in SOURCE.iterdir():
            if entry.name not in ("dem_in", "build", ".git"):
                (data / entry.name).symlink_to(entry)
        shutil.copytree(SOURCE / "dem_in", data / "dem_in")
        deck = data / "dem_in" / name
        head, found, tail = deck.read_text().rpartition(f"\n{before}")
        self.assertTrue(found, f"{name} has no {before}")
        deck.write_text(f"{head}\n{more}{found}{tail.replace(*change)}")
        changed = unittest.mock.patch.dict(os.environ, {"DIPPER_DATA": str(data)})
        changed.start()
        self.addCleanup(changed.stop)

    @two_cores
    def test_an_error_of_any_rank_reaches_the_user(self):
        """LIGGGHTS's Error::one: rock in one rank's part alone, with more neighbours than fit in its list."""
        for rank, sides in ((1, "0.5 9"), (0, "-9 -0.5")):
            self.with_deck("settle.in", "region        pour", f"neigh_modify one 1 page 100\nregion half block -99 99 "
                           f"{sides} -99 99 units box", ("2 prism inside", "3 prism inside half"))
            out = self.folder / f"rank{rank}"
            process = self.start(out, "--set", "end_s=0.03", "--ranks", "2")
            self.assert_ended(process, out, 3, f"settling the pile failed: ERROR on proc {rank}: Neighbor list "
                              "overflow", within=20)
        self.with_deck("dig.in", "if \"", "neigh_modify one 1 page 100")
        process = self.start(self.folder / "dig", "--set", "end_s=0.03", "--ranks", "2")
        self.assert_ended(process, self.folder / "dig", 3, "the dem side failed at t = 0.0000 s (sync step 0): ERROR "
                          "on proc ", "overflow, boost neigh_modify one", within=60)

    def test_a_damaged_pile_is_settled_again(self):
        cache = self.folder / "damaged-cache"
        os.environ["XDG_CACHE_HOME"] = str(cache)
        self.addCleanup(os.environ.pop, "XDG_CACHE_HOME")
        short = ("--set", "end_s=0.03", "--ranks", "1")
        first, second = self.folder / "whole-pile", self.folder / "damaged-pile"
        self.run_case(first, *short)
        pile = next(cache.glob("dipper/piles/*/pile.restart"))
        data = bytearray(pile.read_bytes())
        data[len(data) // 2] ^= 1
        pile.write_bytes(data)
        process = self.start(second, *short)
        _, err = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 0, err)
        self.assertIn(f"{pile} has changed since it was written", err)
        self.assertIn(".damaged and is made again", err)
        self.assertEqual(self.summary(first)["state_hash"], self.summary(second)["state_hash"])

    def test_a_damaged_checkpoint_is_not_gone_on_from(self):
        process, out = self.digging("flipped", time_s=1.9)  # two checkpoints, at 0.6 s and 1.2 s
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        *_, before, last = sorted(p for p in (out / "checkpoints").iterdir() if p.is_dir())
        state = last / "machine.state"
        data = bytearray(state.read_bytes())
        data[len(data) // 2] ^= 1
        state.write_bytes(data)
        _, err = self.run_case(out, "--resume", "--set", f"end_s={self.soon_after(out)}")
        self.assertIn(f"{state} has changed since it was written", err)
        self.assertIn(f"the run continues from the previous one: {before}", err)
        self.assertEqual(self.summary(out)["status"], "complete")

    def test_with_no_sound_checkpoint_left_nothing_is_started(self):
        process, out = self.digging("lost", time_s=1.3)
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=60)
        for state in (out / "checkpoints").glob("*/machine.state"):
            state.write_bytes(b"")
        before = {p: (p.stat().st_mtime_ns, p.stat().st_size) for p in out.rglob("*") if p.is_file()}
        _, err = self.run_case(out, *LONGER, "--resume", status=2)
        for state in (out / "checkpoints").glob("*/machine.state"):
            self.assertIn(f"{state} has changed since it was written", err)
        self.assertIn("no valid checkpoint is left to continue from", err)
        self.assertIn("another --out", err)
        after = {p: (p.stat().st_mtime_ns, p.stat().st_size) for p in out.rglob("*") if p.is_file()}
        self.assertEqual({p for p in after if p.name != "run.lock" and after[p] != before.get(p)}, set())

    def settling(self, name, *arguments, instead=None):
        """A run that settles its pile anew, by a script in place of LIGGGHTS if one is given."""
        change = {"XDG_CACHE_HOME": str(self.folder / "cache")}
        programs = DIPPER.parent
        if instead:
            programs = self.folder / "programs"
            programs.mkdir()
            shutil.copy(DIPPER, programs)  # looks for the others beside itself
            for other in ("dipper-dem", "dipper-mbs", "bench-cut"):
                (programs / other).symlink_to(DIPPER.parent / other)
            (programs / "dipper-liggghts").write_text(
                f'#!/bin/sh\nfor word; do [ "$before" = -screen ] && screen=$word; before=$word; done\n{instead}\n')
            (programs / "dipper-liggghts").chmod(0o755)
            change["DIPPER_DATA"] = str(SOURCE)
        changed = unittest.mock.patch.dict(os.environ, change)
        changed.start()
        self.addCleanup(changed.stop)
        out = self.folder / name
        return self.start(out, "--set", "end_s=0.03", "--set", "coupling.timeout_s=2", *arguments,
                          dipper=programs / "dipper"), out

    def test_a_settling_that_stops_is_found(self):
        process, out = self.settling("asleep", instead='echo Step 100 > "$screen"; sleep 100')
        self.assert_ended(process, out, 3, "settling the pile failed: LIGGGHTS hangs: it did not run",
                          "for 2 s", "settle.screen is 'Step 100'", within=20)

    @two_cores
    def test_a_settling_of_which_one_rank_stops_is_found(self):
        process, out = self.settling("stopped", "--set", "pile.settle_s=60", "--ranks", "2")
        deadline = time.time() + 60
        while len(self.pids(out, "dipper-liggghts")) < 2 and time.time() < deadline:
            time.sleep(0.05)
        time.sleep(2)
        os.kill(self.pids(out, "dipper-liggghts")[-1], signal.SIGSTOP)
        self.assert_ended(process, out, 3, "settling the pile failed: LIGGGHTS hangs", within=20)

    def test_a_settling_that_is_slow_but_gets_on_lives(self):
        process, out = self.settling(
            "slow", "--ranks", "1",
            instead='for k in 1 2 3 4; do echo "Step $k" >> "$screen"; sleep 1; done; '
                    f'exec {DIPPER.parent / "dipper-liggghts"} "$@"')
        _, err = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 0, err)

    def test_a_full_disk(self):
        # A file system of a few MiB, in a mount namespace of its own.
        disk = self.folder / "disk"
        disk.mkdir()
        if os.geteuid() != 0 or os.system(f"mount -t tmpfs -o size=4m tmpfs {disk}") != 0:
            self.skipTest("needs to mount a small file system")
        self.addCleanup(os.system, f"umount -l {disk}")
        process = self.start(disk / "run", "--ranks", "1", "--set", "output.dump_every_s=0.003")
        _, err = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 3, err)
        self.assertIn("dipper: ", err)
        self.assertEqual(processes(disk), [])


if __name__ == "__main__":
    unittest.main()
