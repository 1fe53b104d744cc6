"""The Debian package that CPack makes: what is in it, what it needs, and that it runs once extracted."""
import subprocess
import unittest

from installation import BUILD, PROGRAMS, InstallationTest


def dpkg_deb(*words):
    return subprocess.run(["dpkg-deb", *words], check=True, capture_output=True, text=True).stdout


class Package(InstallationTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        subprocess.run(["cpack", "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder / "made"],
                       check=True, cwd=cls.folder, stdout=subprocess.DEVNULL)
        cls.package, = (cls.folder / "made").glob("dipper_*.deb")
        cls.tree = cls.folder / "extracted"
        dpkg_deb("--extract", cls.package, cls.tree)

    def test_needs_its_libraries_and_what_it_starts_by_name(self):
        needs = dpkg_deb("--field", self.package, "Depends")
        for name in ("libliggghts", "libsimbody", "liblcm", "libhdf5", "liggghts", "openmpi-bin", "python3-scipy"):
            self.assertIn(name, needs)

    def test_holds_programs_and_data(self):
        for name in [*PROGRAMS, "share/dipper/dem_in/dig.in", "share/dipper/mbs/bucyrus495.yaml",
                     "share/dipper/meshes/rocks/block.stl", "share/doc/dipper/copyright"]:
            self.assertTrue((self.tree / "usr" / name).is_file(), name)

    def test_has_no_source_path_compiled_in(self):
        self.assert_knows_no_source(self.tree / "usr")

    def test_runs_once_extracted(self):
        usr = self.tree / "usr"
        self.as_user(usr / "bin/dipper", "check", usr / "share/dipper/cases/quick")


if __name__ == "__main__":
    unittest.main()
