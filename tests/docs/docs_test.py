"""The docs' own promises: the commands of the tutorials as they stand there; links."""
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import yaml

ROOT = Path(__file__).resolve().parents[2]


def commands(page):
    """The shell blocks of a page, in order."""
    return re.findall(r"^```sh\n(.*?)^```$", page.read_text(), re.M | re.S)


class Tutorials(unittest.TestCase):
    def follow(self, page, here, *parts):
        """Runs every command of a page in a folder with these parts of the repository; what they print."""
        for part in ("meshes", "mbs", *parts):
            shutil.copytree(ROOT / part, here / part)
        program = Path(os.environ["DIPPER"]).resolve().parent
        (here / "build/release").mkdir(parents=True)
        (here / "build/release/bin").symlink_to(program)
        script = "set -eu\n" + "\n".join(commands(ROOT / "docs" / page))
        run = subprocess.run(["bash", "-c", script], cwd=here, capture_output=True, text=True, timeout=900)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        return run.stdout + run.stderr

    def test_every_command_of_the_first_case_leaves_what_the_page_says(self):
        with tempfile.TemporaryDirectory() as folder:
            here = Path(folder) / "dipper"
            said = self.follow("tutorial_first_case.md", here, "cases/quick", "cases/rock", "docs/data")
            summary = json.loads((here / "mine/look/summary.json").read_text())
            self.assertEqual(summary["status"], "complete")
            self.assertGreater(summary["passes"][0]["payload_kg"], 10_000)
            self.assertGreater(summary["passes"][0]["truck_kg"], 10_000)  # to the end: the load is dumped
            self.assertIn("limited,1,72.9,", said)
            self.assertIn(f'"fill_factor_load": {summary["passes"][0]["fill_factor_load"]}', said)
            page = here / "mine/look/report/report.html"
            self.assertGreater(page.stat().st_size, 100_000)
            self.assertTrue((here / "mine/look/report/metrics.json").exists())
            self.assertTrue((here / "mine/look/report/run.pvd").exists())

    def test_every_command_of_the_import_says_what_the_page_says(self):
        with tempfile.TemporaryDirectory() as folder:
            here = Path(folder) / "dipper"
            said = self.follow("tutorial_import.md", here, "cases/screening", "cases/rock", "docs/data/import")
            page = (ROOT / "docs/tutorial_import.md").read_text()
            listed = [line for line in re.findall(r"^    (.*)$", page, re.M)
                      if line.strip() and not line.startswith(("dipper ", "Shovel ", "Date;"))]
            self.assertGreater(len(listed), 10)
            for line in listed:
                self.assertIn(line, said)
            for file in ("motion.csv", "import.png", "import.txt", "measured/signals.csv"):
                self.assertTrue((here / "mine/shift" / file).exists())
            self.assertFalse((here / "mine/wrong").exists())


class MachinePage(unittest.TestCase):
    """docs/machine_file.md and its drawing against the machine's file, whose keys are the reader's, all of them."""

    def setUp(self):
        data = yaml.safe_load((ROOT / "mbs/bucyrus495.yaml").read_text())
        self.unit = {"machine": data.pop("machine")["unit"]}
        self.unit |= {f"{group}.{key}": e["unit"] for group, entries in data.items() for key, e in entries.items()}

    def test_every_key_has_its_row_with_its_unit(self):
        rows = re.findall(r"^\| `([\w.]+)` \| (.+?) \|", (ROOT / "docs/machine_file.md").read_text(), re.M)
        self.assertEqual(dict(rows), self.unit)
        self.assertEqual([key for key, _ in rows], list(self.unit))

    def test_drawing_shows_every_length_and_angle(self):
        with tempfile.TemporaryDirectory() as folder:
            drawn = Path(folder) / "drawn.svg"
            subprocess.run([ROOT / "scripts/machine_drawing", ROOT / "mbs/bucyrus495.yaml", drawn], check=True)
            text = drawn.read_text()
            self.assertEqual(text, (ROOT / "docs/images/machine.svg").read_text(), "drawn anew by the command above")
            for key, unit in self.unit.items():
                if unit in ("m", "deg"):
                    self.assertRegex(text, key.removeprefix("limits.").replace(".", r"\."))


class Links(unittest.TestCase):
    def test_every_relative_link_of_the_docs_leads_somewhere(self):
        for page in [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").glob("*.md"))]:
            for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", page.read_text()):
                if "://" not in target:
                    self.assertTrue((page.parent / target).exists(), f"{page.name}: {target}")

    def test_every_file_that_contributing_names_is_there(self):
        for name in re.findall(r"`([\w.]+/[\w./]+)`", (ROOT / "CONTRIBUTING.md").read_text()):
            if "NAME" not in name and not name.startswith("build/"):
                self.assertTrue((ROOT / name).exists(), name)

    def test_every_page_is_reached_from_the_way_in(self):
        way_in = (ROOT / "docs/README.md").read_text()
        for page in sorted((ROOT / "docs").glob("*.md")):
            if page.name != "README.md":
                self.assertIn(f"({page.name})", way_in)


if __name__ == "__main__":
    unittest.main()
