"""scripts/check_rooms, on small trees that each break one rule."""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = pathlib.Path(__file__).resolve().parents[2] / "scripts/check_rooms"


class CheckRooms(unittest.TestCase):
    def setUp(self):
        self.root = pathlib.Path(tempfile.mkdtemp(prefix="dipper-rooms-"))
        self.addCleanup(shutil.rmtree, self.root)
        subprocess.run(["git", "init", "-q", self.root], check=True)
        self.write("common/CMakeLists.txt", "add_library(dipper_common frames.cpp)")
        self.write("common/frames.cpp", '#include "common/frames.hpp"')
        self.write("common/frames.hpp")
        self.write("machine/CMakeLists.txt", "add_library(dipper_machine motion.cpp)\n"
                   "target_link_libraries(dipper_machine PUBLIC dipper_common)")
        self.write("machine/motion.cpp", '#include "machine/motion.hpp"\n#include "common/frames.hpp"')
        self.write("machine/motion.hpp")

        self.write("analysis/runs/pyproject.toml", '[project]\nname = "dipper-run"\n'
                   '[tool.setuptools]\npackages = ["dipper_run"]')
        self.write("analysis/runs/dipper_run/__init__.py", "from .run import read")
        self.write("analysis/runs/dipper_run/run.py", "import h5py")
        self.write("analysis/gap/pyproject.toml", '[project]\nname = "dipper-gap"\ndependencies = ["dipper-run"]\n'
                   '[tool.setuptools]\npackages = ["dipper_gap", "dipper_gap.readings", "dipper_gap.statistics"]')
        self.write("analysis/gap/dipper_gap/workflow.py", "from .statistics import match\nfrom dipper_run import read")
        self.write("analysis/gap/dipper_gap/statistics/match.py", "from ..readings.measured import MASS")
        self.write("analysis/gap/dipper_gap/readings/measured.py", "from dipper_run.run import read")

    def write(self, file, text=""):
        file = self.root / file
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text + "\n")

    def check(self, *wrong):
        done = subprocess.run([PROGRAM, self.root], capture_output=True, text=True)
        self.assertEqual(done.stdout.splitlines()[:-1], list(wrong), done.stderr)
        self.assertEqual(done.returncode, 1 if wrong else 0)

    def test_passes_a_tree_in_order(self):
        self.check()

    def test_an_arrow_up(self):
        self.write("common/frames.hpp", '#include "machine/motion.hpp"')
        self.check("common/frames.hpp: includes machine/motion.hpp, but dipper_common does not link dipper_machine",
                   "common/frames.hpp: includes machine/motion.hpp, but machine is above common")

    def test_a_file_in_no_room(self):
        self.write("attic/old.cpp")
        self.check("attic/old.cpp: in no room; scripts/check_rooms lists them")

    def test_a_link_not_declared(self):
        self.write("machine/CMakeLists.txt", "add_library(dipper_machine motion.cpp)")
        self.check("machine/motion.cpp: includes common/frames.hpp, but dipper_machine does not link dipper_common")

    def test_a_link_through_a_third(self):
        self.write("common/mesh/CMakeLists.txt", "add_library(dipper_mesh stl.cpp)\n"
                   "target_link_libraries(dipper_mesh PUBLIC dipper_common)")
        self.write("common/mesh/stl.cpp", '#include "common/mesh/stl.hpp"')
        self.write("common/mesh/stl.hpp", '#include "common/frames.hpp"')
        self.write("machine/CMakeLists.txt", "add_library(dipper_machine motion.cpp)\n"
                   "target_link_libraries(dipper_machine PUBLIC dipper_mesh)")
        self.check("machine/motion.cpp: includes common/frames.hpp, but dipper_machine does not link dipper_common")

    def test_a_library_not_declared(self):
        self.write("machine/motion.hpp", "#include <fmt/format.h>")
        self.check("machine/motion.hpp: includes fmt/format.h, but dipper_machine does not link fmt::fmt")

    def test_a_link_that_only_a_header_without_a_source_file_needs(self):
        self.write("machine/motion.cpp", '#include "machine/limits.hpp"')
        self.write("machine/limits.hpp", "#include <Eigen/Core>")
        self.check("machine/limits.hpp: includes Eigen/Core, but dipper_machine does not link Eigen3::Eigen")

    def test_twins_that_know_each_other(self):
        self.write("mbs/main.cpp", '#include "dem/hold.hpp"')
        self.write("dem/hold.hpp")
        self.check("mbs/main.cpp: includes dem/hold.hpp, but dem is above mbs",
                   "mbs/main.cpp: includes dem/hold.hpp, but mbs and dem must not use each other")

    def test_a_library_behind_another_adapter(self):
        self.write("coupler/run/run.cpp", "#include <lammps.h>")
        self.check("coupler/run/run.cpp: includes lammps.h, which belongs to another room's library")

    def test_an_import_that_runs_up(self):
        top, low = "analysis/gap/dipper_gap/workflow.py", "analysis/gap/dipper_gap/readings/measured.py"
        for text in ("from ..workflow import analyse", "from .. import workflow", "import dipper_gap.workflow",
                     "def read():\n    from dipper_gap.workflow import analyse"):
            self.write(low, text)
            self.check(f"{low}: imports {top}, but analysis/gap/dipper_gap is above "
                       "analysis/gap/dipper_gap/readings")

    def test_packages_that_know_each_other(self):
        runs, statistics = ("analysis/gap/dipper_gap/" + name for name in ("simulation", "statistics"))
        self.write("analysis/gap/pyproject.toml", '[project]\ndependencies = ["dipper-run"]\n[tool.setuptools]\n'
                   'packages = ["dipper_gap", "dipper_gap.readings", "dipper_gap.simulation", "dipper_gap.statistics"]')
        self.write(f"{runs}/plan.py")
        self.write(f"{statistics}/match.py", "from ..simulation.plan import split")
        self.check(f"{statistics}/match.py: imports {runs}/plan.py, "
                   f"but {statistics} and {runs} must not use each other")

    def test_a_python_file_in_no_room(self):
        self.write("analysis/attic/old.py")
        self.check("analysis/attic/old.py: in no room; scripts/check_rooms lists them")

    def test_a_room_that_is_not_installed(self):
        self.write("analysis/gap/dipper_gap/decision/decide.py")
        self.check("analysis/gap/pyproject.toml: packages lacks dipper_gap.decision")

    def test_a_package_that_is_not_declared(self):
        self.write("analysis/study/pyproject.toml", '[tool.setuptools]\npackages = ["dipper_study"]')
        self.write("analysis/study/dipper_study/plan.py", "from dipper_run import read")
        self.check("analysis/study/pyproject.toml: dependencies lacks dipper-run, which analysis/study imports")


if __name__ == "__main__":
    unittest.main()
