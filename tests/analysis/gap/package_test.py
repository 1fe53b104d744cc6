"""The package installs with what Debian has, without a network, and brings its data along."""
import shutil
import subprocess
import sys
from pathlib import Path

ANALYSIS = Path(__file__).resolve().parents[3] / "analysis"


def test_pip_installs_it(tmp_path):
    for name in ("runs", "gap", "logs", "survey"):
        shutil.copytree(ANALYSIS / name, tmp_path / name)
        made = subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps",
                               "--no-build-isolation", "--target", str(tmp_path / "site"), str(tmp_path / name)],
                              capture_output=True, text=True)
        assert made.returncode == 0, made.stderr
    words = ("from dipper_gap.decision.next_experiment import propose; print(propose({'liners': 1, 'carry_back': 1})); "
             "from dipper_import.__main__ import main; import dipper_survey.__main__; main(['--help'])")
    said = subprocess.run([sys.executable, "-c", words], capture_output=True, text=True, cwd=tmp_path,
                          env={"PYTHONPATH": str(tmp_path / "site")})
    assert said.returncode == 0 and "tare" in said.stdout and "MAP.yaml" in said.stdout, said.stderr
