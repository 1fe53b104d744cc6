"""What containers take away: shared memory, and the memory of other processes."""

import ctypes
import os
import pathlib
import struct
import subprocess
import unittest

from runs import DIPPER, PATIENCE_S, RunTest, TINY, two_cores

SHORT = ("--ranks", "2", "--set", "end_s=0.06")
SMALL_SHM = ["unshare", "--map-root-user", "--mount", "--", "sh", "-c",
             'mount -t tmpfs -o size=16m none /dev/shm && exec "$@"', "sh"]
BPF_LOAD_NUMBER, BPF_EQUAL, BPF_RETURN = 0x20, 0x15, 0x06
ALLOW, REFUSE = 0x7FFF0000, 0x00050000 | 1  # EPERM
READV, WRITEV = 310, 311  # process_vm_*, x86-64
PR_SET_SECCOMP, PR_SET_NO_NEW_PRIVS = 22, 38


def refuse_memory_of_others():
    """From here on, as Docker's profile of older kernels."""
    libc = ctypes.CDLL(None, use_errno=True)
    rows = b"".join(struct.pack("HBBI", *row) for row in (
        (BPF_LOAD_NUMBER, 0, 0, 0), (BPF_EQUAL, 2, 0, READV), (BPF_EQUAL, 1, 0, WRITEV), (BPF_RETURN, 0, 0, ALLOW),
        (BPF_RETURN, 0, 0, REFUSE)))
    table = ctypes.create_string_buffer(rows, len(rows))
    program = ctypes.create_string_buffer(struct.pack("HxxxxxxP", len(rows) // 8, ctypes.addressof(table)))
    if libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) or libc.prctl(PR_SET_SECCOMP, 2, program, 0, 0):
        raise OSError(ctypes.get_errno(), "seccomp")


class Container(RunTest):
    def dipper(self, *words, before=(), prepare=None):
        done = subprocess.run([*before, DIPPER, *map(str, words)], text=True, capture_output=True, timeout=PATIENCE_S,
                              preexec_fn=prepare)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout + done.stderr

    @two_cores
    @unittest.skipIf(subprocess.run([*SMALL_SHM, "true"], capture_output=True).returncode, "no mount namespaces here")
    def test_a_small_dev_shm(self):
        room = subprocess.run([*SMALL_SHM, "df", "-h", "/dev/shm"], capture_output=True, text=True).stdout
        self.assertIn("16M", room)
        self.dipper("run", TINY, *SHORT, "--out", self.folder / "run", before=SMALL_SHM)

    @two_cores
    @unittest.skipUnless(os.uname().machine == "x86_64", "the filter is of x86-64")
    def test_memory_of_others_refused(self):
        said = self.dipper("run", TINY, *SHORT, "--out", self.folder / "run", prepare=refuse_memory_of_others)
        logs = [said, *(f.read_text(errors="replace") for f in pathlib.Path(self.folder / "run/logs").glob("*.log"))]
        for log in logs:
            self.assertNotIn("process_vm_readv", log)
            self.assertNotIn("Read -1, expected", log)


if __name__ == "__main__":
    unittest.main()
