#!/usr/bin/python3
"""Stands in for `dipper`: checks and runs a case in which payload, force and work are a known function of rake, toe
and seed. Beside it: `calls` (a line a run that began), `fail` (seeds whose runs fail), `slow` (seconds a run takes),
`short` (seeds whose runs end within the pass), `poses` (there: runs have no passes), `warnings` (of every run, SEED
for its seed), `steep` (the rake above which a toe beyond 0.5 m is no sound case), `hold` (a command, and the number of
motions made from which it takes a minute; then `held` is there), `real` (the program that writes pages)."""
import hashlib
import json
import os
import pathlib
import random
import sys
import time

import yaml

HERE = pathlib.Path(__file__).resolve().parent
KEYS = {"machine.rake_angle_deg": (0, 90), "pile.toe_x_m": (-100, 100), "seed": (0, 2**31), "dem.ranks": (1, 64),
        "output.dump_every_s": (0, 1e9), "output.checkpoint_every_s": (0, 1e9), "flat": (0, 1)}


def read(name, otherwise):
    file = HERE / name
    return file.read_text().strip() if file.exists() else otherwise


def settings(words):
    return dict(words[k + 1].split("=", 1) for k, w in enumerate(words) if w == "--set")


def check(words):
    keys, findings = settings(words), []
    for key, value in keys.items():
        if key in ("bodies.dipper", "machine.motion", "machine.operator", "machine.plan"):
            continue
        low, high = KEYS.get(key, (1, 0))
        if key not in KEYS:
            findings.append((key, "unknown key"))
        elif not low <= float(value) <= high:
            findings.append((key, f"{value} is out of range; allowed is {low} ... {high}"))
    if float(keys.get("machine.rake_angle_deg", 0)) > float(read("steep", "inf")) and float(keys["pile.toe_x_m"]) > 0.5:
        findings.append(("pile.toe_x_m", "the dipper is in the pile"))
    case = pathlib.Path(words[words.index("--json") + 1]) / "case.yaml"
    text = case.read_text() + json.dumps(keys, sort_keys=True)
    print(json.dumps({"findings": [{"file": "--set", "line": 0, "key": k, "message": m} for k, m in findings],
                      "case_hash": hashlib.sha256(text.encode()).hexdigest(), "source_hash": "s",
                      "values": {"title": "A made-up shovel", "machine.rake_angle_deg": 60, "pile.toe_x_m": 0},
                      "cost": {"wall_s": 5, "disk_B": 9e6, "record_B": 4e6, "dumps_B": 3e6}}))
    return 2 if findings else 0


def model(keys, seed):
    """(payload_t, dig_force_peak_MN, dig_work_MJ): best rake 64 and toe 1, where a seed moves all points alike."""
    rake, toe = float(keys.get("machine.rake_angle_deg", 60)), float(keys.get("pile.toe_x_m", 0))
    shared, own = random.Random(seed), random.Random(f"{seed} {rake:.6f} {toe:.6f} {keys.get('bodies.dipper')}")
    payload = 70 + shared.gauss(0, 3) + own.gauss(0, 0.5) + (5 if keys.get("bodies.dipper") == "wide.stl" else 0)
    if float(keys.get("flat", 0)) == 0:
        payload -= 0.5 * (rake - 64) ** 2 + 2 * (toe - 1) ** 2
    if keys.get("machine.operator") == "plan":
        payload += yaml.safe_load(pathlib.Path(keys["machine.plan"]).read_text())["passes"][0]["cut"]["depth_m"]
    elif "machine.motion" in keys:
        payload += json.loads(pathlib.Path(keys["machine.motion"]).read_text())["depth_m"]
    return payload, 8 + 0.5 * (rake - 60) + own.gauss(0, 0.1), 20.0


def run(words):
    out, seed = pathlib.Path(words[words.index("--out") + 1]), int(words[words.index("--seed") + 1])
    with open(HERE / "calls", "a") as f:
        f.write(f"{seed} {' '.join(words)}\n")
    try:
        time.sleep(float(read("slow", "0")))
    except KeyboardInterrupt:
        return 4
    if str(seed) in read("fail", "").split():
        print("no rock")
        return 3
    payload, peak, work = model(settings(words), seed)
    (out / "dumps").mkdir(parents=True)
    (out / "dumps/rocks_0.dump").write_text("x" * 1000)
    (out / "record.h5").write_text("a record")
    one = {"payload_kg": payload * 1e3, "truck_kg": payload * 990, "fill_factor": 0.8,
           "fill_factor_load": 0.7, "dig_force_mean_N": 2.5e6,
           "dig_phases_force_mean_N": 3e6, "dig_force_peak_N": peak * 1e6,
           "dumped": str(seed) not in read("short", "").split()}
    warnings = read("warnings", "").replace("SEED", str(seed)).splitlines()
    passes = [] if (HERE / "poses").exists() else [one]
    (out / "summary.json").write_text(json.dumps({"passes": passes, "dem": {"cpu_s": 5, "wall_s": 7},
                                                  "mbs": {"cpu_s": 1}, "warnings": warnings}))
    (out / "work").write_text(str(work))
    return 0


def motion(words):
    """A motion is its plan's only cut; no machine digs deeper than 5 m, nor, as `check` finds, above the ground."""
    file, out = (pathlib.Path(words[words.index(option) + 1]) for option in ("--plan", "--out"))
    cut = yaml.safe_load(file.read_text())["passes"][0]["cut"]
    with open(HERE / "motions", "a") as f:
        f.write(f"{json.dumps(cut)}\n")
    if cut["depth_m"] > 5:
        print("dipper: the plan: the dipper is under the ground", file=sys.stderr)
        return 2
    if cut["depth_m"] < 0:
        print("warning: case.yaml:2: seed: is odd\ncase.yaml:1: domain.max_m: the dipper leaves the domain\n1 error")
        return 2
    out.write_text(json.dumps(cut))
    return 0


def report(words):
    out = pathlib.Path(words[0])
    (out / "report").mkdir()
    work = float((out / "work").read_text())
    metrics = {} if (HERE / "poses").exists() else {"passes": [{"dig_work_J": work * 1e6}]}
    (out / "report/metrics.json").write_text(json.dumps(metrics))
    (out / "report/report.html").write_text("a page")
    return 0


if __name__ == "__main__":
    hold, *after = read("hold", "none").split()
    if sys.argv[1] == hold and len(read("motions", "").splitlines()) >= int(*after):
        (HERE / "held").touch()
        time.sleep(60)
    if sys.argv[1] == "page":
        os.execv(read("real", ""), sys.argv)
    sys.exit({"check": check, "run": run, "motion": motion, "report": report}[sys.argv[1]](sys.argv[2:]))
