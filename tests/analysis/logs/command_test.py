"""`dipper import` as a command: what it writes, when it writes nothing, and that the case it makes is sound."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import ugly_log
from dipper_import.__main__ import main

ROOT = ugly_log.ROOT
DIPPER = os.environ.get("DIPPER", str(ROOT / "build/release/bin/dipper"))
LOG, MAP = ROOT / "docs/data/import/shift.csv", ROOT / "docs/data/import/shift.yaml"


def dipper(*words, status=0):
    done = subprocess.run([DIPPER, *map(str, words)], capture_output=True, text=True, timeout=100)
    assert done.returncode == status, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.fixture
def case(tmp_path):
    folder = tmp_path / "cases/shift"
    shutil.copytree(ROOT / "cases/screening", folder)
    shutil.copytree(ROOT / "cases/rock", tmp_path / "cases/rock")
    for part in ("meshes", "mbs"):
        (tmp_path / part).symlink_to(ROOT / part)
    return folder


def files(folder):
    return sorted(str(f.relative_to(folder)) for f in Path(folder).rglob("*") if f.is_file())


def test_a_case_with_the_imported_motion_is_sound(case):
    said = dipper("import", LOG, "--map", MAP, "--out", case)
    assert "3 passes that end with a dump" in said
    assert {"import.png", "import.txt", "measured/channels.yaml", "measured/passes.csv", "measured/signals.csv",
            "motion.csv"} <= set(files(case))
    assert (case / "import.txt").read_text() in said
    assert (case / "import.png").read_bytes().startswith(b"\x89PNG")
    assert "is sound" in dipper("check", case)


def test_cases_quick_with_the_imported_motion_passes_check(tmp_path):
    for case in ("quick", "rock"):
        shutil.copytree(ROOT / "cases" / case, tmp_path / "cases" / case)
    for part in ("meshes", "mbs"):
        (tmp_path / part).symlink_to(ROOT / part)
    dipper("import", LOG, "--map", MAP, "--out", tmp_path / "cases/quick")
    assert "is sound" in dipper("check", tmp_path / "cases/quick")


def test_dry_writes_the_plot_alone(tmp_path):
    said = dipper("import", LOG, "--map", MAP, "--out", tmp_path / "out", "--dry")
    assert files(tmp_path) == ["out/import.png"] and str(tmp_path / "out/import.png") in said
    assert "gap of 1 s" in said


def without_measures(folder):
    """The tutorial's map without forces and masses."""
    file = folder / "motion.yaml"
    lines, measures = MAP.read_text().replace("../../..", str(ROOT)).splitlines(), ("hoist_f", "crowd_f", "truck_")
    file.write_text("\n".join(line for line in lines if not line.lstrip().startswith(measures)))
    return file


def test_a_measured_folder_of_an_earlier_log_is_not_left_beside_a_new_motion(tmp_path, capsys):
    out, map_file = tmp_path / "out", without_measures(tmp_path)
    assert main([str(LOG), "--map", str(map_file), "--out", str(out)]) == 0
    assert main([str(LOG), "--map", str(MAP), "--out", str(out)]) == 0
    before = {name: (out / name).read_bytes() for name in files(out)}
    assert main([str(LOG), "--map", str(map_file), "--out", str(out)]) == 2
    assert f"{out}/measured: is of an earlier log, and this one has no forces and no masses by its map; remove it, " \
        "or choose another --out" in capsys.readouterr().err
    assert before == {name: (out / name).read_bytes() for name in files(out)}
    assert main([str(LOG), "--map", str(map_file), "--out", str(out), "--dry"]) == 0


def test_what_users_add_to_channels_is_kept(tmp_path, capsys):
    out = tmp_path / "out"
    assert main([str(LOG), "--map", str(MAP), "--out", str(out)]) == 0
    file = out / "measured/channels.yaml"
    added = "face_m: {unit: m, role: response, sigma: 0.05, common_sigma: 0.03}\n"
    sound = re.sub("(truck_mass_t: .*)}", r"\1, drift_sigma: 0.01}", file.read_text()) + added
    file.write_text(sound)
    profile = out / "measured/profile.csv"
    profile.write_text("pass,x_m,z_m\n" + "".join(f"1,{x},{x - 10}\n" for x in range(10, 16)))
    faces = profile.read_bytes()
    capsys.readouterr()
    assert main([str(LOG), "--map", str(MAP), "--out", str(out)]) == 0
    note = "measured/channels.yaml: truck_mass_t.drift_sigma, face_m kept, as an earlier one had them"
    assert note in capsys.readouterr().out and note in (out / "import.txt").read_text()
    assert file.read_text() == sound and profile.read_bytes() == faces


def test_bad_input_writes_nothing(tmp_path):
    broken = tmp_path / "map.yaml"
    sound = MAP.read_text().replace("../../..", str(ROOT))
    broken.write_text(sound.replace("Swing cw", "Schwenk"))
    said = dipper("import", LOG, "--map", broken, "--out", tmp_path / "out", status=2)
    assert f"{broken}:7: channels.swing.column: 'Schwenk' is no column of shift.csv" in said and "Traceback" not in said
    broken.write_text(sound.replace("{acceleration: 1.5}", "{speed: 0.1}"))
    said = dipper("import", LOG, "--map", broken, "--out", tmp_path / "out", status=2)
    assert "Crowd %: crowd goes at up to 0.7" in said and "0.1 m/s (limits): unit or scale" in said
    for words in ((tmp_path / "none.csv", "--map", MAP), (LOG, "--map", tmp_path / "none.yaml"), (LOG,),
                  (LOG, "--map", MAP, "--outt", "x")):
        assert "Traceback" not in dipper("import", *words, "--out", tmp_path / "out", status=2)
    assert files(tmp_path) == ["map.yaml"]


@pytest.mark.parametrize("name, what", [("motion.csv", "log"), ("measured/signals.csv", "log"), ("import.txt", "map")])
def test_an_input_is_not_overwritten(tmp_path, capsys, name, what):
    log, map_file = (tmp_path / name if what == w else f for w, f in (("log", LOG), ("map", MAP)))
    (tmp_path / name).parent.mkdir(exist_ok=True)
    shutil.copy(LOG if what == "log" else MAP, tmp_path / name)
    before = (tmp_path / name).read_bytes()
    assert main([str(log), "--map", str(map_file), "--out", str(tmp_path)]) == 2
    assert f"--out: {tmp_path / name} is the {what}; choose another --out" in capsys.readouterr().err
    assert (tmp_path / name).read_bytes() == before and files(tmp_path) == [name]


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_cannot_be_written_names_the_option(tmp_path, capsys):
    (tmp_path / "shut").mkdir(mode=0o500)
    assert main([str(LOG), "--map", str(MAP), "--out", str(tmp_path / "shut/out")]) == 2
    assert "shut/out: cannot be written (Permission denied); choose another --out" in capsys.readouterr().err


def test_a_parent_that_is_a_file_names_the_option(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    assert main([str(LOG), "--map", str(MAP), "--out", str(tmp_path / "file/out")]) == 2
    assert "file/out: cannot be written" in (said := capsys.readouterr().err) and "choose another --out" in said


def test_help():
    said = dipper("import", "--help")
    assert "--map" in said and "dipper import shift.csv" in said
    assert "import" in dipper("--help")


def test_the_current_folder_and_a_user_s_packages_are_no_part_of_it(tmp_path):
    """A csv.py beside the logs is not run, a user's own numpy not taken, a user's settings are for other programs."""
    here, home = tmp_path / "here", tmp_path / "home"
    site = home / f".local/lib/python3.{sys.version_info.minor}/site-packages"
    for folder, names in ((here, ("csv", "numpy", "yaml")), (site, ("numpy",))):
        folder.mkdir(parents=True)
        for name in names:
            (folder / f"{name}.py").write_text(f"raise SystemExit('{name}.py of {folder} was run')\n")
    (here / "matplotlibrc").write_text("text.usetex: True\nfont.size: 60\nbackend: TkAgg\n")
    environment = {**os.environ, "HOME": str(home), "PYTHONPATH": str(here), "PYTHONHOME": str(here),
                   "PYTHONOPTIMIZE": "2", "PYTHONINSPECT": "1", "PYTHONPLATLIBDIR": "none", "PYTHONHASHSEED": "x",
                   "MPLBACKEND": "module://matplotlib_inline.backend_inline"}
    for name in ("PYTHONNOUSERSITE", "PYTHONSAFEPATH"):
        environment.pop(name, None)
    done = subprocess.run([DIPPER, "import", LOG, "--map", MAP, "--out", tmp_path / "out", "--dry"], cwd=here,
                          env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=100)
    assert done.returncode == 0 and "was run" not in done.stdout + done.stderr, done.stderr
