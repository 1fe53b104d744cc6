"""`cmake --install`: the tree runs from where it is moved to, by anybody, without the repository."""
import json
import shutil
import subprocess
import unittest

from installation import BUILD, SOURCE, InstallationTest


class AMovedTree(InstallationTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        first = cls.folder / "first"
        subprocess.run(["cmake", "--install", BUILD, "--prefix", first], check=True, stdout=subprocess.DEVNULL)
        cls.prefix = first.rename(cls.folder / "moved tree")
        cls.dipper = cls.prefix / "bin/dipper"

    def test_has_no_source_path_compiled_in(self):
        self.assert_knows_no_source(self.prefix)

    def test_has_cases_that_find_their_files(self):
        cases = sorted((self.prefix / "share/dipper/cases").glob("*/case.yaml"))
        self.assertTrue(cases)
        for case in cases:
            self.as_user(self.dipper, "check", case.parent)

    def test_knows_the_effects(self):
        quick = self.prefix / "share/dipper/cases/quick"
        self.as_user(self.dipper, "check", quick, "--set", "effects.crowd_friction=80")
        said = self.as_user(self.dipper, "check", quick, "--set", "effects.crowd_frictoin=80", status=2)
        self.assertIn("crowd_friction", said)

    def test_digs_and_reports(self):
        case = self.home / "tiny"
        shutil.copytree(SOURCE / "tests/coupler/run/tiny", case)
        text = (case / "case.yaml").read_text()
        (case / "case.yaml").write_text(text.replace("../../../../", f"{self.prefix}/share/dipper/"))
        run = self.home / "run"
        self.as_user(self.dipper, "run", case, "--ranks", "1", "--set", "end_s=0.3", "--set",
                     "pile.settle_s=0.2", "--out", run)
        summary = json.loads((run / "summary.json").read_text())
        self.assertEqual(summary["status"], "complete")
        self.assertEqual(summary["version"], self.as_user(self.dipper, "--version").strip())
        self.as_user(self.dipper, "report", run)
        self.assertTrue((run / "report/report.html").is_file())

    def test_has_the_python_part(self):
        self.assertIn("--measured", self.as_user(self.dipper, "gap", "--help"))
        self.assertIn("--detach", self.as_user(self.dipper, "study", "--help"))
        self.assertIn("--map", self.as_user(self.dipper, "import", "--help"))

    def test_takes_its_data_from_the_folder_given(self):
        alone = self.folder / "alone"
        shutil.copy(self.dipper, alone)
        quick = self.prefix / "share/dipper/cases/quick"
        words = ["check", quick, "--set", "effects.crowd_friction=80"]
        self.as_user("env", f"DIPPER_DATA={self.prefix}/share/dipper", alone, *words)
        self.assertIn("DIPPER_DATA", self.as_user(alone, *words, status=2))
        run = self.home / "nothing"
        plain = ["run", quick, "--out", run]
        self.assertIn("DIPPER_DATA", self.as_user(alone, *plain, status=2))
        self.assertFalse(run.exists())


if __name__ == "__main__":
    unittest.main()
