"""The docs' own promises: the commands of docs/tutorial_first_case.md as they stand there; links."""
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/tutorial_first_case.md"


def commands(page):
    """The shell blocks of a page, in order."""
    return re.findall(r"^```sh\n(.*?)^```$", page.read_text(), re.M | re.S)


class FirstCase(unittest.TestCase):
    def test_every_command_works_and_leaves_what_the_page_says(self):
        with tempfile.TemporaryDirectory() as folder:
            here = Path(folder) / "dipper"
            for part in ("cases/quick", "meshes", "mbs"):
                shutil.copytree(ROOT / part, here / part)
            program = Path(os.environ["DIPPER"]).resolve().parent
            (here / "build/release").mkdir(parents=True)
            (here / "build/release/bin").symlink_to(program)
            script = "set -eu\n" + "\n".join(commands(PAGE))
            run = subprocess.run(["bash", "-c", script], cwd=here, capture_output=True, text=True, timeout=500)
            self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
            summaries = [json.loads((here / f"mine/{name}/summary.json").read_text()) for name in ("look", "wide")]
            for summary in summaries:
                self.assertEqual(summary["status"], "complete")
                self.assertGreater(summary["passes"][0]["payload_kg"], 10_000)
            page = here / "mine/look/report/report.html"
            self.assertGreater(page.stat().st_size, 100_000)
            self.assertTrue((here / "mine/look/report/metrics.json").exists())
            self.assertTrue((here / "mine/look/report/run.pvd").exists())


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
