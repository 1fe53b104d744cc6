"""A run's folder read as arrays: what is there, what is not, and what is damaged."""
import gzip
import hashlib
import json
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

import dipper_run
from dipper_run.findings import BadInput
from dipper_run.out_folder import check_writable

SOURCE = Path(__file__).resolve().parents[3] / "analysis/runs"
DUMP = """ITEM: TIMESTEP
5
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS ff ff ff
0 1
0 1
0 1
ITEM: ATOMS id type x y z radius
1 1 0 0 0.5 0.2
2 1 1 0 0.5 0.3
"""


@pytest.fixture
def folder(tmp_path):
    with h5py.File(tmp_path / "record.h5", "w") as f:
        f.attrs["case"] = "dem.timestep_s=0.001\nseed=3\n"
        for name, unit, values in (("time_s", "s", [0.1, 0.2, 0.3]), ("machine/hoist_force", "N", [1.0, 2.0])):
            f[name] = np.array(values)
            f[name].attrs.update(unit=unit, frame="")
    (tmp_path / "summary.json").write_text(json.dumps({"sim_s": 0.3, "passes": [{"payload_kg": 5e4}]}))
    (tmp_path / "report").mkdir()
    (tmp_path / "report/metrics.json").write_text('{"format": 1}')
    (tmp_path / "report/phases.csv").write_text("pass,phase,t_start_s\n1,fill,2.5\n1,dump,\n")
    (tmp_path / "dumps").mkdir()
    for step in (50, 5, 0):
        (tmp_path / f"dumps/rocks_{step}.dump").write_text(DUMP)
    return tmp_path


def test_everything_is_an_array(folder):
    run = dipper_run.read(folder)
    assert run.channels["machine/hoist_force"] == ("N", "")
    assert run.summary["passes"][0]["payload_kg"] == 5e4 and run.metrics == {"format": 1}
    assert run.case == {"dem.timestep_s": "0.001", "seed": "3"}
    phases = run.table("phases")
    assert list(phases["phase"]) == ["fill", "dump"] and phases["t_start_s"][0] == 2.5
    assert np.isnan(phases["t_start_s"][1])
    assert [f.time_s for f in run.frames] == [0, 0.005, 0.05]
    np.testing.assert_array_equal(run.frames[0].rocks["radius"], [0.2, 0.3])


@pytest.mark.parametrize("text", ["", "\n", "phase,t_start_s", "phase,t_start_s\nfill,2.5\ndu",
                                  "phase,t_start_s\nfill,2.5\ndump\n", "phase,t_start_s\nfill,2.5\ndump,3.",
                                  "phase,t_start_s\nfill,2.5,1\n"])
def test_a_table_that_was_cut_short_is_reported(folder, text):
    (folder / "report/phases.csv").write_text(text)
    with pytest.raises(dipper_run.NotARun, match="report/phases.csv: cut short; `dipper report"):
        dipper_run.read(folder).table("phases")


def test_a_table_may_be_without_rows(folder):
    (folder / "report/phases.csv").write_text("phase,t_start_s\n")
    assert {name: len(cells) for name, cells in dipper_run.read(folder).table("phases").items()} == {
        "phase": 0, "t_start_s": 0}


@pytest.mark.parametrize("ends", ["1 1 0 0 0.5 0.2\n", "0.5 0.3\n", " 0.3\n", "\n", "ITEM: ATOMS"])
def test_a_dump_that_was_cut_short_is_reported(folder, ends):
    (folder / "dumps/rocks_5.dump").write_text(DUMP[:DUMP.index(ends)])
    with pytest.raises(dipper_run.NotARun, match="rocks_5.dump"):
        dipper_run.read(folder).frames[1].rocks


def test_a_gzipped_dump_is_read_and_reported_when_it_was_cut_short(folder):
    (folder / "dumps/rocks_5.dump").unlink()
    file = folder / "dumps/rocks_5.dump.gz"
    packed = gzip.compress(DUMP.encode())
    file.write_bytes(packed)
    frames = dipper_run.read(folder).frames
    assert [f.step for f in frames] == [0, 5, 50]
    np.testing.assert_array_equal(frames[1].rocks["radius"], [0.2, 0.3])
    for damaged in (packed[:-12], packed[:40], b"", DUMP.encode()):
        file.write_bytes(damaged)
        with pytest.raises(dipper_run.NotARun, match="rocks_5.dump.gz"):
            dipper_run.read(folder).frames[1].rocks


def test_a_dump_may_be_without_rock(folder):
    text = DUMP[:DUMP.index("1 1 0 0")].replace("ATOMS\n2", "ATOMS\n0")
    (folder / "dumps/rocks_5.dump").write_text(text)
    assert len(dipper_run.read(folder).frames[1].rocks["radius"]) == 0


def test_channels_of_a_killed_run_are_cut_to_the_same_length(folder):
    run = dipper_run.read(folder)
    np.testing.assert_array_equal(run.time_s, [0.1, 0.2])
    np.testing.assert_array_equal(run["machine/hoist_force"], [1, 2])


def test_what_is_missing_is_reported_with_what_makes_it(folder):
    shutil.rmtree(folder / "report")
    run = dipper_run.read(folder)
    with pytest.raises(dipper_run.NotARun, match="dipper report"):
        run.metrics
    with pytest.raises(KeyError, match="hoist_farce.*machine/hoist_force"):
        run["machine/hoist_farce"]
    with pytest.raises(dipper_run.NotARun, match="no record.h5"):
        dipper_run.read(folder / "dumps")


def test_a_file_that_is_not_what_the_run_wrote_is_not_read(folder):
    digest = hashlib.sha256((folder / "summary.json").read_bytes()).hexdigest()
    (folder / "manifest.sha256").write_text(f"{digest}  summary.json\n# files: 1\n")
    assert dipper_run.read(folder).summary
    (folder / "summary.json").write_text('{"passes": []}')
    with pytest.raises(dipper_run.NotARun, match="not what the run wrote"):
        dipper_run.read(folder).summary


def test_the_summary_of_an_earlier_end_is_not_that_of_a_run_that_goes_on(folder):
    with h5py.File(folder / "record.h5", "a") as f:
        del f["time_s"]
        f["time_s"] = np.array([0.1, 0.2, 0.3, 0.4])
    with pytest.raises(dipper_run.NotARun, match="earlier end, at 0.3 s.*come to 0.4 s"):
        dipper_run.read(folder).summary


def test_an_answers_folder_that_cannot_be_made_is_reported_and_nothing_is_made(tmp_path):
    (tmp_path / "file").write_text("in the way")
    (tmp_path / "nowhere").symlink_to(tmp_path / "gone")
    for folder in (tmp_path / "file/out", tmp_path / "nowhere", tmp_path / "nowhere/out"):
        with pytest.raises(BadInput, match="cannot be written .*another --out"):
            check_writable(folder)
    check_writable(tmp_path / "new/out")
    assert not (tmp_path / "new").exists()


def test_pip_installs_it(tmp_path):
    shutil.copytree(SOURCE, tmp_path / "source")
    made = subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps",
                           "--no-build-isolation", "--target", str(tmp_path / "site"), str(tmp_path / "source")],
                          capture_output=True, text=True)
    assert made.returncode == 0, made.stderr
    said = subprocess.run([sys.executable, "-c", "import dipper_run; print(dipper_run.__file__)"], cwd=tmp_path,
                          env={"PYTHONPATH": str(tmp_path / "site")}, capture_output=True, text=True)
    assert said.stdout.startswith(str(tmp_path / "site")), said.stderr
