"""`dipper survey` as a command: what it writes, that the case takes it, and when it writes nothing."""
import os
import shutil
import subprocess

import numpy as np
import pytest

import scanned_face

ROOT = scanned_face.ROOT
DIPPER = os.environ.get("DIPPER", str(ROOT / "build/release/bin/dipper"))
AT = ("--origin", ",".join(map(str, scanned_face.ORIGIN)), "--azimuth", str(scanned_face.AZIMUTH))


def dipper(*words, status=0):
    done = subprocess.run([DIPPER, *map(str, words)], capture_output=True, text=True, timeout=300)
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.fixture
def case(tmp_path):
    """cases/quick in a tree of its own."""
    for name in ("quick", "rock"):
        shutil.copytree(ROOT / "cases" / name, tmp_path / "cases" / name)
    for part in ("meshes", "mbs"):
        (tmp_path / part).symlink_to(ROOT / part)
    return tmp_path / "cases/quick"


@pytest.fixture
def cloud(tmp_path):
    file = tmp_path / "scan.csv"
    np.savetxt(file, scanned_face.to_mine(scanned_face.scene(40_000)), fmt="%.2f", delimiter=",", header="E,N,RL")
    return file


def edit(case, *pairs):
    text = (case / "case.yaml").read_text()
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new)
    (case / "case.yaml").write_text(text)


def test_a_case_takes_the_face(case, cloud):
    """Of a case with a bench of its own the command says what to write; once that is there, check is satisfied."""
    before = sorted(case.iterdir())
    said = dipper("survey", cloud, "--case", case, *AT)
    assert {f.name for f in case.iterdir()} - {f.name for f in before} == {"face.stl", "face.png", "face.txt"}
    assert (case / "face.txt").read_text() in said and (case / "face.png").read_bytes().startswith(b"\x89PNG")
    assert "pile: {profile: face.stl, width_m: 12, settle_s: 2.5, relax_s: 1.5}" in said
    assert "x 12." in said and "to 29.6" in said, "to the rear wall of the case's bench"
    text = (case / "case.yaml").read_text()
    begin = text.index("pile:")
    end = text.index("bodies:")
    east, north, up = scanned_face.ORIGIN
    (case / "case.yaml").write_text(
        text[:begin] + "pile: {profile: face.stl, width_m: 12, settle_s: 2.5, relax_s: 1.5}\n"
        f"site: {{origin_m: [{east}, {north}, {up}], azimuth_deg: {scanned_face.AZIMUTH}}}\n" + text[end:])
    assert "is sound" in dipper("check", case)
    first = (case / "face.stl").read_bytes()
    (case / "face.stl").unlink()
    said = dipper("survey", cloud, "--case", case, "--rear", "29.639")
    assert "check: quick is sound with it: about" in said, "place and azimuth of the case, before its face is there"
    assert len((case / "face.stl").read_bytes()) == len(first)


def test_a_section_is_a_profile_too(case, cloud, tmp_path):
    said = dipper("survey", cloud, "--case", case, *AT, "--out", tmp_path / "face.csv")
    assert "profile: ../../face.csv" in said
    table = np.loadtxt(tmp_path / "face.csv", delimiter=",", skiprows=1)
    np.testing.assert_allclose(table[:, 1], scanned_face.height(table[:, 0], 0), atol=0.5)


@pytest.mark.parametrize("words, said", [
    ((), "site.origin_m"), (("--origin", "1,2"), "--origin: is '1,2'"),
    (("--azimuth", "north"), "--azimuth: is 'north'"),
    ((*AT, "--rear", "300"), "--rear: is 300"), ((*AT, "--out", "face.obj"), "--out: is 'face.obj'")])
def test_bad_input_writes_nothing(case, cloud, tmp_path, words, said):
    before = sorted(p for p in tmp_path.rglob("*"))
    printed = dipper("survey", cloud, "--case", case, *words, status=2)
    assert said in printed and printed.endswith("1 error\n")
    assert sorted(p for p in tmp_path.rglob("*")) == before


def test_the_cases_other_files_are_not_overwritten(case, cloud):
    before = (case / "motion.csv").read_bytes()
    printed = dipper("survey", cloud, "--case", case, *AT, "--out", case / "motion.csv", status=2)
    assert f"--out: {case / 'motion.csv'} is the case's machine.motion; choose another --out" in printed
    assert (case / "motion.csv").read_bytes() == before


@pytest.mark.parametrize("scan, out", [("mine.csv", "mine.csv"), ("mine.txt", "mine.stl")])
def test_the_scan_is_not_overwritten(case, cloud, tmp_path, scan, out):
    shutil.copy(cloud, tmp_path / scan)
    printed = dipper("survey", tmp_path / scan, "--case", case, *AT, "--out", tmp_path / out, status=2)
    assert f"--out: {tmp_path / scan} is the scan; choose another --out" in printed
    assert (tmp_path / scan).read_bytes() == cloud.read_bytes()


def test_faults_of_the_case_are_its_own(case, cloud):
    edit(case, ("density_kg_m3: 3747", "density_kg_m3: -1"))
    assert "rock.density_kg_m3" in dipper("survey", cloud, "--case", case, *AT, status=2)
    assert "cannot be read" in dipper("survey", cloud, "--case", case / "none", *AT, status=2)
    assert dipper("survey", case / "none.las", "--case", case, status=2)
