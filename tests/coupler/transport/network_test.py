"""Whole runs of the tiny case on networks that lose, flood, lie or are not private."""

import json
import os
import pathlib
import pwd
import shutil
import stat
import subprocess
import sys
import time
import unittest

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "run"))

from runs import DIPPER, PATIENCE_S, TINY, RunTest, processes  # noqa: E402

GROUP = "239.255.76.67"
SHORT = ("--set", "end_s=1.2")  # 400 windows, some 1600 packets: where time is measured


def inside(pid, *command):
    """`command` in the network of the process."""
    user = [] if os.geteuid() == 0 else ["-U", "--preserve-credentials"]
    return ["nsenter", "-t", str(pid), *user, "-n", *map(str, command)]


def wait_for_sides(process, out):
    """Until the machine side is there: the run is in its network then."""
    while process.poll() is None and "dipper-mbs" not in [name for _, name in processes(out)]:
        time.sleep(0.01)


class Network(RunTest):
    reference = None

    def start(self, out, *arguments, **how):
        return super().start(out, "--ranks", "1", *arguments, **how)  # two would wait for each other

    def setUp(self):
        super().setUp()
        if Network.reference is None:  # once: the hash of an undisturbed run
            self.run_case(self.folder / "pile", "--set", "end_s=0.03")
            self.run_case(self.folder / "quiet")
            Network.reference = self.summary(self.folder / "quiet")["state_hash"]

    def assert_same_result(self, out, reference=None):
        summary = self.summary(out)
        self.assertEqual(summary["status"], "complete")
        self.assertEqual(summary["state_hash"], reference or self.reference)
        return summary["coupling"]

    def programs(self):
        """A folder with `dipper` whose two sides are reached through relay.py."""
        real = pathlib.Path(DIPPER).parent
        folder = self.folder / "bin"
        if folder.exists():
            return folder
        folder.mkdir()
        for program in real.iterdir():
            (folder / program.name).symlink_to(program)
        (folder / "dipper").unlink()
        shutil.copy2(DIPPER, folder / "dipper")  # a program finds its sides beside itself
        for side in ("dipper-mbs", "dipper-dem"):
            (folder / side).unlink()
            (folder / side).write_text(f'#!/bin/sh\nexec {HERE / "relay.py"} {real / side} "$@"\n')
            (folder / side).chmod(0o755)
        return folder

    def through(self, name, *arguments, reference=None, **faults):
        """Runs the case through a relay; how long it took."""
        out = self.folder / name
        began = time.monotonic()
        done = subprocess.run([self.programs() / "dipper", "run", TINY, "--ranks", "1", *arguments, "--out", out],
                              text=True, capture_output=True, timeout=PATIENCE_S,
                              env={**os.environ, "RELAY": json.dumps(faults),
                                   "DIPPER_DATA": str(pathlib.Path(DIPPER).parents[1] / "share" / "dipper")})
        took = time.monotonic() - began
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        counts = self.assert_same_result(out, reference)
        print(f"{name}: {took:.1f} s, resends {counts['resends']}")
        return took, counts

    def test_a_tenth_of_all_packets_lost_costs_less_than_twice_the_time_again(self):
        """In turn with what the relay itself takes. The quickest of each count: other work on the machine only adds."""
        carried, lost = [], []
        self.run_case(self.folder / "short", *SHORT)
        reference = self.summary(self.folder / "short")["state_hash"]
        for seed in (1, 2, 3):
            took, counts = self.through(f"carried{seed}", *SHORT, reference=reference)
            carried.append(took)
            self.assertEqual(counts["resends"], 0)
            took, counts = self.through(f"loss{seed}", *SHORT, reference=reference, drop=0.1, seed=seed)
            lost.append(took)
            self.assertGreater(counts["resends"], 20)
        self.assertLess(min(lost), 3 * min(carried))

    def test_lost_doubled_swapped_and_late(self):
        self.through("all", drop=0.1, double=0.2, swap=0.2, late=0.1, late_s=0.1)

    def test_a_flood_of_lies_changes_nothing(self):
        out = self.folder / "flood"
        process = self.start(out)
        wait_for_sides(process, out)
        stranger = subprocess.Popen(inside(process.pid, HERE / "stranger.py", 40000, 1))
        try:
            text = process.communicate(timeout=PATIENCE_S)
        finally:
            process.kill()
            stranger.kill()
            stranger.wait()
        self.assertEqual(process.returncode, 0, text)
        self.assertGreater(self.assert_same_result(out)["foreign_messages"], 10000)

    def test_a_hung_side_is_found_in_time_in_a_flood(self):
        out = self.folder / "hang"
        process = self.start(out, "--set", "end_s=4.5", "--set", "coupling.timeout_s=2")
        self.wait_until_digging(process, out)
        stranger = subprocess.Popen(inside(process.pid, HERE / "stranger.py", 40000, 2))
        try:
            time.sleep(0.5)
            machine = next(pid for pid, name in processes(out) if name == "dipper-mbs")
            os.kill(machine, 19)
            began = time.monotonic()
            _, err = process.communicate(timeout=20)
            self.assertIn("no answer for 2 s", err)
            # Up to 3 s to end both sides; 2 for a busy machine.
            self.assertLess(time.monotonic() - began, 2 + 1 + 3 + 2)
        finally:
            process.kill()
            stranger.kill()
            stranger.wait()

    def test_a_loaded_machine_does_not_fail_a_healthy_start(self):
        busy = [subprocess.Popen(["sh", "-c", "while :; do :; done"]) for _ in range(20)]
        try:
            self.run_case(self.folder / "busy", "--set", "end_s=0.03")
        finally:
            for process in busy:
                process.kill()
                process.wait()

    @unittest.skipUnless(os.geteuid() == 0, "needs a second user")
    def test_another_user_does_not_reach_the_run(self):
        nobody = pwd.getpwnam("nobody")

        def become_nobody():
            os.setgroups([])
            os.setgid(nobody.pw_gid)
            os.setuid(nobody.pw_uid)

        out = self.folder / "alone"
        process = self.start(out)
        wait_for_sides(process, out)
        subprocess.run(["ip", "route", "replace", "239.255.76.0/24", "dev", "lo"], check=False)
        # From where the user is, with the same address; then from inside, where the user may not go.
        outside = subprocess.Popen([sys.executable, "-c", (HERE / "stranger.py").read_text(), "5000", "3"],
                                   preexec_fn=become_nobody, cwd=HERE, stderr=subprocess.DEVNULL)
        refused = [subprocess.run(["nsenter", "-t", str(process.pid), *how, "-n", "true"], capture_output=True,
                                  preexec_fn=become_nobody).returncode for how in ([], ["-U"])]
        text = process.communicate(timeout=PATIENCE_S)
        outside.kill()
        outside.wait()
        self.assertEqual(process.returncode, 0, text)
        self.assertNotIn(0, refused)
        self.assertEqual(self.assert_same_result(out)["foreign_messages"], 0)

    def test_without_a_network_of_its_own_a_run_says_so_and_keeps_its_secrets(self):
        out = self.folder / "shared"
        # A user namespace that grants no further networks.
        ready = ("echo 0 > /proc/sys/user/max_net_namespaces; ip link set lo up; "
                 f"ip route add 239.255.76.0/24 dev lo; exec {DIPPER} run {TINY} --ranks 1 --out {out}")
        process = subprocess.Popen(["unshare", "-Urn", "sh", "-c", ready], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        wait_for_sides(process, out)
        # The other run's messages, say: an authentic recording, played here.
        said = b""
        for pid, _ in processes(out):
            said += pathlib.Path(f"/proc/{pid}/cmdline").read_bytes()
        text = process.communicate(timeout=PATIENCE_S)
        self.assertEqual(process.returncode, 0, text)
        self.assertIn("the kernel refuses this run a network of its own", text[1])
        self.assert_same_result(out)
        secret = json.loads((out / "logs" / "dem.json").read_text())["secret"].encode()
        self.assertEqual(len(secret), 64)
        self.assertNotIn(secret, said)  # which ps shows
        self.assertNotIn(secret, (out / "events.lcmlog").read_bytes())
        for path in (out / "events.lcmlog", out / "logs", out / "logs" / "dem.json"):
            self.assertEqual(stat.S_IMODE(path.stat().st_mode) & 0o077, 0, path)


if __name__ == "__main__":
    unittest.main()
