"""Runs of the tiny case whose two ranks are on two hosts, and what becomes of them when one goes."""

import signal
import subprocess
import time
import unittest

from hosts import Hosts
from runs import DIPPER, PATIENCE_S, TINY, RunTest

SHORT = [word for setting in ("pile.settle_s=0.03", "pile.relax_s=0.015", "output.checkpoint_every_s=0.03",
                              "coupling.timeout_s=3") for word in ("--set", setting)]


class TwoHosts(RunTest):
    @classmethod
    def setUpClass(cls):
        try:
            cls.hosts = cls.enterClassContext(Hosts())
        except OSError as e:
            raise unittest.SkipTest(f"network namespaces are not permitted here: {e}") from e

    def start(self, out, *arguments, case=TINY, dipper=DIPPER):
        words = self.hosts.command("h1", [dipper, "run", case, "--out", out, "--ranks", "2", *arguments])
        return subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def test_two_hosts_give_what_one_gives(self):
        few = [*SHORT, "--set", "end_s=0.03"]
        said, _ = self.run_case(self.folder / "one", *few)
        self.assertIn("network: the run's own, as all ranks are on this host\n", said)
        said, _ = self.run_case(self.folder / "here", *few, "--mpirun",
                                "--host 10.77.0.1:2 --bind-to none --mca mpi_yield_when_idle 1")
        self.assertIn("network: the run's own", said)
        said, _ = self.run_case(self.folder / "two", *few, "--mpirun", self.hosts.options)
        self.assertIn("network: the host's, which MPI needs, as ranks are on h1 (1 rank), h2 (1 rank).", said)
        one, here, two = (self.summary(self.folder / name) for name in ("one", "here", "two"))
        self.assertEqual(one["state_hash"], two["state_hash"])
        self.assertEqual(one["state_hash"], here["state_hash"])
        self.assertGreater(two["dem"]["cpu_s"], 0.5 * here["dem"]["cpu_s"])  # which yields, too

    def test_a_host_that_goes_ends_the_run_which_then_goes_on(self):
        out = self.folder / "run"
        process = self.start(out, *SHORT, "--mpirun", self.hosts.options)
        self.wait_until_digging(process, out, 0.04)
        self.hosts.kill("h2")
        self.assert_failed(process)
        process = self.start(out, "--resume")  # on the same hosts
        self.wait_until_digging(process, out, self.soon_after(out, 3))
        self.hosts.plug("h2", "down")
        try:
            self.assert_failed(process, "(no answer for 3 s|mpirun has lost the host)")
        finally:
            self.hosts.plug("h2", "up")
        self.hosts.kill("h2")
        self.run_case(out, "--resume", "--set", f"end_s={self.soon_after(out, 3)}")
        self.assertEqual(self.summary(out)["status"], "complete")

    def assert_failed(self, process, why=""):
        began = time.monotonic()
        try:
            _, said = process.communicate(timeout=PATIENCE_S)
        finally:
            process.send_signal(signal.SIGKILL)
        self.assertLess(time.monotonic() - began, 60)  # some seconds, and 25 where rank 0 waits for a core
        self.assertEqual(process.returncode, 3, said)
        self.assertRegex(said, "the dem side failed at t = .*" + why)
        self.assertIn("last checkpoint: ", said)

    def test_hosts_that_will_not_do_are_bad_input(self):
        out = self.folder / "run"
        for options, why in (("--hostfile /no/hosts", "--mpirun: /no/hosts: cannot be read"),
                             (f"{self.hosts.agent} --host 10.77.0.2:2", "rank 0 is on h2, but must be on this host, "),
                             (f"{self.hosts.agent} --host 10.77.0.1,10.77.0.3", "--mpirun: "),
                             ("--host 10.77.0.1:1", "not enough slots"),
                             ("--nonsense", "unknown option"),
                             ("'", "--mpirun: ")):
            _, said = self.run_case(out, "--mpirun", options, status=2)
            self.assertIn(why, said)
            self.assertFalse(out.exists())


if __name__ == "__main__":
    unittest.main()
