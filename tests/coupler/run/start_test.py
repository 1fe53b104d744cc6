"""How a run starts: in a bench cut to a scan, and with the machine where rock is."""

import json
import os
import shutil
import subprocess
import unittest
import unittest.mock

import h5py

from runs import DIPPER, TINY, RunTest, rocks

REPLACED = ("toe_x_m:", "height_m:", "crest_depth_m:", "face_angle_deg:")


class Start(RunTest):
    def scanned_case(self, scan="scan.csv", text="x_m,z_m\n9,0\n9,1.5\n11,3\n14,2.5\n"):
        """The tiny case, of a bench that reaches into the dipper."""
        folder = self.folder / "a" / "b" / "case"
        folder.mkdir(parents=True)
        (folder / scan).write_text(text)
        shutil.copy(TINY / "motion.csv", folder)
        case = (TINY / "case.yaml").read_text().replace("../../../../", f"{TINY.parents[3]}/")
        lines = [line for line in case.splitlines() if not line.strip().startswith(REPLACED)]
        at = next(i for i, line in enumerate(lines) if line.startswith("pile:"))
        lines.insert(at + 1, f"  profile: {scan}")
        (folder / "case.yaml").write_text("\n".join(lines) + "\n")
        return folder

    def test_rock_in_the_machine_is_removed_and_reported(self):
        case = self.scanned_case()
        # One rank and patience: on a busy machine ranks wait for each other.
        settings = ("--ranks", "1", "--set", "coupling.timeout_s=60", "--set", "end_s=0.05",
                    "--set", "output.dump_every_s=1")
        kept, cleared = self.folder / "kept", self.folder / "cleared"
        self.run_case(kept, *settings, case=case)
        out, _ = self.run_case(cleared, *settings, "--set", "pile.clear_machine=on", case=case)

        self.assertNotIn("start", self.summary(kept))
        start = self.summary(cleared)["start"]
        self.assertGreater(start["rocks_removed"], 0)
        self.assertIn(f"start: {start['rocks_removed']:.0f} rocks, ", out)
        self.assertIn("removed", (cleared / "logs" / "dem.log").read_text())
        with h5py.File(kept / "record.h5") as a, h5py.File(cleared / "record.h5") as b:
            self.assertAlmostEqual(a["rock/rock_mass"][0] - b["rock/rock_mass"][0],
                                   start["mass_removed_kg"], delta=1e-6 * a["rock/rock_mass"][0])
            # After the first window; in the row before it no step has been made.
            push = [abs(f["bodies/dipper/wrench_end"][1, 3:]).max() for f in (a, b)]
        self.assertGreater(push[0], 1e4, "rock in steel pushes")
        self.assertLess(push[1], 0.01 * push[0])

        pile = self.summary(cleared)["pile"]
        self.assertIn("below its profile", out)
        self.assertLess(abs(pile["below_profile_mean_m"]), 1)
        self.assertIn("pile: from the cache", out, "how the dig starts is not part of the pile")

    def test_bench_cut_to_a_surface(self):
        case = self.scanned_case("scan.stl", surface(right=2.6, left=0.4))
        settings = ("--ranks", "1", "--set", "coupling.timeout_s=60", "--set", "end_s=0.02",
                    "--set", "output.dump_every_s=1")
        out, _ = self.run_case(self.folder / "first", *settings, case=case)
        pile = self.summary(self.folder / "first")["pile"]
        self.assertLess(abs(pile["below_profile_mean_m"]), 0.5)
        # Higher on the left: the rock is heavier there, and it is another bench of the cache.
        (case / "scan.stl").write_text(surface(right=0.4, left=2.6))
        self.run_case(self.folder / "turned", *settings, case=case)
        side = []
        for name in ("first", "turned"):
            side.append((rocks(self.folder / name / "dumps" / "rocks_0.dump.gz")["y"] > 0).mean())
        self.assertLess(side[0], 0.45)
        self.assertGreater(side[1], 0.55)
        again, _ = self.run_case(self.folder / "again", *settings, case=case)
        self.assertIn("pile: from the cache", again)

    def test_a_folder_that_a_script_or_a_shell_would_misread_is_refused(self):
        for name in ("runs;touch stolen;x", "a$HOME", "a&b", "a`b`", 'a"b', "a*b", "a%b", "a\nb"):
            out = self.folder / name
            _, err = self.run_case(out, "--ranks", "1", status=2)
            self.assertIn("takes letters, digits, blanks", err)
            self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_case_behind_a_link_is_made_of_the_files_its_paths_name(self):
        """The system follows a link before it goes up; beside the link stand other files of the same names."""
        real, decoy = self.folder / "mine/sites/north", self.folder / "decoy/cases"
        for folder in (real, decoy):
            folder.mkdir(parents=True)
        shutil.copytree(TINY, real / "tiny")
        case = real / "tiny/case.yaml"
        case.write_text(case.read_text().replace("../../../../", "../../../"))
        for part in ("mbs", "meshes"):
            shutil.copytree(TINY.parents[3] / part, self.folder / "mine" / part)
            shutil.copytree(TINY.parents[3] / part, self.folder / part)
            for mesh in (self.folder / part).rglob("*.*"):
                if mesh.is_file():
                    mesh.write_text("no file of this case\n")
        (decoy / "north").symlink_to(real / "tiny")
        printed = [json.loads(subprocess.run([DIPPER, "check", "--json", c], capture_output=True, text=True).stdout)
                   for c in (real / "tiny", decoy / "north")]
        self.assertTrue(printed[1]["sound"], printed[1]["findings"])
        self.assertEqual(*(t["case_hash"] for t in printed))
        self.assertIn(str(self.folder / "mine/meshes/dipper.stl"), printed[1]["files"])
        self.run_case(self.folder / "run", "--no-rock", "--set", "end_s=0.05", case=decoy / "north")

    def test_a_folder_that_cannot_be_written_starts_nothing(self):
        printed, err = self.run_case("/proc/run", "--ranks", "4096", status=2)
        self.assertIn("/proc/run: cannot be written", err)
        self.assertIn("warning: dem.ranks: 4096 ranks share ", printed)

    def test_without_a_place_for_the_cache_nothing_starts(self):
        with unittest.mock.patch.dict(os.environ):
            for name in ("HOME", "XDG_CACHE_HOME"):
                os.environ.pop(name, None)
            _, err = self.run_case(self.folder / "run", "--ranks", "1", status=2)
        self.assertIn("set XDG_CACHE_HOME to a folder", err)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_cache_named_from_the_working_directory(self):
        with unittest.mock.patch.dict(os.environ, XDG_CACHE_HOME=os.path.relpath(self.folder / "cache")):
            self.run_case(self.folder / "run", "--ranks", "1", "--set", "end_s=0.03", "--set", "pile.settle_s=0.3",
                          "--set", "pile.relax_s=0.1", case=TINY)
        self.assertTrue(any((self.folder / "cache/dipper/piles").iterdir()))

    def test_blanks_in_the_paths_of_a_run(self):
        """Settled anew, in a cache with a blank: the case, its meshes and the run's folder have one too."""
        case = self.folder / "my mine" / "a" / "run" / "my case"
        shutil.copytree(TINY, case)
        for beside in ("meshes", "mbs", "cases"):  # the case names files there
            (self.folder / beside).symlink_to(TINY.parents[3] / beside)
        out = self.folder / "my run"
        with unittest.mock.patch.dict(os.environ, XDG_CACHE_HOME=str(self.folder / "my cache")):
            self.run_case(out, "--ranks", "1", "--set", "end_s=0.03", "--set", "pile.settle_s=0.3",
                          "--set", "pile.relax_s=0.1", case=case)
        self.assertEqual(json.loads((out / "summary.json").read_text())["status"], "complete")
        self.assertTrue((out / "dumps" / "rocks_0.dump.gz").is_file())

    def test_a_pile_that_flies_apart_is_not_dug(self):
        """Far too soft for its fall: spheres are pressed through each other and thrown out of the box."""
        _, err = self.run_case(self.folder / "soft", "--ranks", "1", "--set", "contact.normal_scale=2e-6",
                               "--set", "dem.timestep_s=1.5e-2", "--set", "coupling.sync_steps=1",
                               "--set", "coupling.timeout_s=60", "--set", "end_s=0.03", status=3)
        self.assertIn("flew away", err)
        self.assertIn("contact.normal_scale", err)


def surface(right, left):
    """STL of a bench from x = 13 to 16 m that is that high on the right (y < 0) and the left."""
    corners = [(x, y, z) for x, f in ((13, 0.5), (16, 1)) for y, z in ((-3, f * right), (3, f * left))]
    facets = "".join("facet normal 0 0 1 outer loop " + " ".join(
        "vertex {} {} {}".format(*corners[k]) for k in facet) + " endloop endfacet\n"
        for facet in ((0, 2, 3), (0, 3, 1)))
    return f"solid bench\n{facets}endsolid bench\n"


if __name__ == "__main__":
    unittest.main()
