"""The fraternal twin of the case in screening/: the same machine, motion and place, another rock.

What differs from the model in every truth: finer rock (coarse graining 2.6 for 3.0) of other shapes, packed by
other seeds and settled for other times, stiffer contacts, another time step and sync step. A mine differs
from any model in this way; a tool that names an effect for it raises a false alarm.
"""
import copy
import json
import shutil
import struct
import subprocess
from pathlib import Path

import numpy as np
import yaml

ROOT = Path(__file__).resolve().parents[4]
SCREENING = Path(__file__).resolve().parent / "screening"
RATE_HZ = 20.0  # of the signals the mine's own drives and sensors are played on, before the logger
SHAPES = ["chunk", "column", "shard"]


def model_case():
    """The case in screening/ with paths from anywhere."""
    case = yaml.safe_load((SCREENING / "case.yaml").read_text())
    for section, key in (("machine", "model"), ("machine", "motion"), ("rock", "shape_folder"),
                         ("bodies", "dipper"), ("bodies", "door"), ("truck", "mesh")):
        case[section][key] = str((SCREENING / case[section][key]).resolve())
    return case


def twin_case():
    case = model_case()
    case["title"] = "fraternal twin of screening"
    case["rock"]["coarse_graining"] = 2.6
    for size_class in case["rock"]["classes"]:
        if size_class["shapes"] != ["sphere"]:
            size_class["shapes"] = list(SHAPES)
    case["contact"]["normal_scale"] = 0.0013
    case["dem"]["timestep_s"] = 9e-4
    case["coupling"]["sync_steps"] = 3
    case["pile"].update(settle_s=3.0, relax_s=2.5)
    case["output"].update(dump_every_s=100000, checkpoint_every_s=0)
    return case


def run(case, seed, folder, program):
    """Runs a case in `folder`/run, once; returns that folder. Throws RuntimeError with the log's place."""
    out = folder / "run"
    if not (folder / "done").exists():
        shutil.rmtree(out, ignore_errors=True)
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "case.yaml").write_text(yaml.safe_dump(case, sort_keys=False))
        with open(folder / "run.log", "w") as log:
            status = subprocess.run([program, "run", folder, "--out", out, "--ranks", "1", "--seed", str(seed)],
                                    stdout=log, stderr=subprocess.STDOUT).returncode
        if status != 0:
            raise RuntimeError(f"{folder}: run ended with status {status}; see run.log there")
        for heavy in ("dumps", "checkpoints"):
            shutil.rmtree(out / heavy, ignore_errors=True)
        (out / "events.lcmlog").unlink(missing_ok=True)
        (folder / "done").touch()
    return out


def signals(run_folder, program):
    """{name: values} at RATE_HZ with time_s, and the passes' rows [pass, start, end, tonnes]."""
    seen = run_folder.parent / "fast"
    if not seen.exists():
        subprocess.run([program, "observe", run_folder, "--set", f"observation.rate_Hz={RATE_HZ}", "--out", seen],
                       check=True, capture_output=True)
    header = (seen / "signals.csv").open().readline().strip().split(",")
    table = np.loadtxt(seen / "signals.csv", delimiter=",", skiprows=1)
    passes = np.loadtxt(seen / "passes.csv", delimiter=",", skiprows=1)
    return dict(zip(header, table.T)), passes[passes[:, 3] > 0]


def provenance(run_folder):
    """What was run, for the stored folder: seed, version and the case's text as changed."""
    summary = json.loads((run_folder / "summary.json").read_text())
    return {"seed": summary["seed"], "version": summary["version"]}


# --- meshes, for effects that change the dipper ----------------------------------------------------

def read_stl(file):
    """(n, 3, 3) corners of a text or binary STL."""
    data = Path(file).read_bytes()
    if data[:5] == b"solid" and b"facet" in data[:400]:
        numbers = [line.split()[1:] for line in data.decode().splitlines() if line.strip().startswith("vertex")]
        return np.array(numbers, float).reshape(-1, 3, 3)
    count = struct.unpack("<I", data[80:84])[0]
    facets = np.frombuffer(data[84:], dtype=[("n", "<3f4"), ("v", "<9f4"), ("a", "<u2")], count=count)
    return facets["v"].reshape(-1, 3, 3).astype(float)


def write_stl(file, corners):
    lines = ["solid dipper"]
    for a, b, c in corners:
        n = np.cross(b - a, c - a)
        n = n / max(np.linalg.norm(n), 1e-300)
        lines += [" facet normal {:.6g} {:.6g} {:.6g}".format(*n), "  outer loop"]
        lines += ["   vertex {:.9g} {:.9g} {:.9g}".format(*p) for p in (a, b, c)]
        lines += ["  endloop", " endfacet"]
    Path(file).write_text("\n".join(lines + ["endsolid dipper", ""]))


def changed(case, **sections):
    """A deep copy with sections updated: changed(case, pile={"height_m": 7})."""
    out = copy.deepcopy(case)
    for section, values in sections.items():
        out.setdefault(section, {}).update(values)
    return out
