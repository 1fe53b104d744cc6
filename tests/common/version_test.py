"""common/version.cmake: the version says which commit, and is written anew only when it changes."""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "common/version.cmake"


class Version(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="dipper-version-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.source = self.folder / "source"
        self.source.mkdir()
        self.file = self.source / "file"
        self.file.write_text("one")
        self.out = self.folder / "version.cpp"

    def git(self, *words):
        who = ["-c", "user.name=a", "-c", "user.email=a@b"]
        return subprocess.run(["git", "-C", self.source, *who, *words], check=True, capture_output=True,
                              text=True).stdout.strip()

    def commit(self):
        self.git("init", "-q")
        self.git("add", "file")
        self.git("commit", "-q", "-m", "one")

    def version(self, source=None):
        subprocess.run(["cmake", "-D", f"SOURCE={source or self.source}", "-D", "VERSION=1.2.3", "-D",
                        f"OUT={self.out}", "-P", SCRIPT], check=True)
        return re.search(r'return "(.*)"', self.out.read_text()).group(1)

    def test_of_a_tarball(self):
        self.assertEqual(self.version(), "1.2.3")

    def test_of_a_commit(self):
        self.commit()
        self.assertEqual(self.version(), "1.2.3+g" + self.git("rev-parse", "--short=7", "HEAD"))

    def test_of_changed_files(self):
        self.commit()
        self.file.write_text("two")
        self.assertTrue(self.version().endswith(".dirty"))

    def test_of_a_tarball_in_another_repository(self):
        self.commit()
        inner = self.source / "inner"
        inner.mkdir()
        self.assertEqual(self.version(inner), "1.2.3")

    def test_is_written_when_it_changes_only(self):
        self.commit()
        self.version()
        os.utime(self.out, (1, 1))
        self.version()
        self.assertEqual(self.out.stat().st_mtime, 1)
        self.file.write_text("two")
        self.version()
        self.assertNotEqual(self.out.stat().st_mtime, 1)


if __name__ == "__main__":
    unittest.main()
