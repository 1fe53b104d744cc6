"""What the tests of the installation share: a tree in a folder of its own, and an ordinary user."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["DIPPER_BUILD"])
PROGRAMS = ["bin/dipper", *(f"libexec/dipper/{p}"
                            for p in ("dipper-dem", "dipper-mbs", "dipper-liggghts", "bench-cut", "place-rocks"))]
NOBODY = 65534


class InstallationTest(unittest.TestCase):
    """A folder that everybody may enter, with a home for a user who owns nothing else."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="dipper-install-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.folder.chmod(0o755)
        cls.home = cls.folder / "home"
        cls.home.mkdir()
        if os.geteuid() == 0:
            os.chown(cls.home, NOBODY, NOBODY)

    def as_user(self, *command, status=0):
        """Runs as an ordinary user, in a home of its own, with what a log-in gives and no more; its output."""
        words = ["env", "-i", f"HOME={self.home}", "PATH=/usr/bin:/bin", *map(str, command)]
        if os.geteuid() == 0:
            words = ["setpriv", f"--reuid={NOBODY}", f"--regid={NOBODY}", "--clear-groups", *words]
        done = subprocess.run(words, cwd=self.home, capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout + done.stderr

    def assert_knows_no_source(self, prefix):
        for program in PROGRAMS:
            content = (prefix / program).read_bytes()
            for folder in (SOURCE, BUILD):
                self.assertNotIn(str(folder).encode(), content, f"{program} has {folder} compiled in")
