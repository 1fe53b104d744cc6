"""The sealed set: what it holds, that its seals are those of its truths, and that no folder shows what is hidden."""
import hashlib
import json
import sys
import zipfile
from collections import Counter
from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import fidelity  # noqa: E402
import make  # noqa: E402
from effects import CATALOGUE, NUISANCE, OUTSIDE  # noqa: E402
from shovel_test import MOTION, a_dig  # noqa: E402


@pytest.fixture
def runs(tmp_path):
    """Stored digs of eight benches that differ in their load, and of two whose face is nearer."""
    for name, seeds in (("base", range(1, 9)), ("standoff_0.5", (21, 22))):
        for seed in seeds:
            folder = tmp_path / "runs" / name / str(seed)
            folder.mkdir(parents=True)
            material = {"density": 0.98 * make_density()}
            (folder / "run.json").write_text(json.dumps({"keys": {"density": 1.0}, "material": material}))
            for k in range(3):
                dig = a_dig(kg=50e3 + 1e3 * seed, number=k)
                np.savetxt(folder / f"pass_{k + 1}.csv.gz", dig.table, delimiter=",", header="h", comments="")
                np.savetxt(folder / f"face_{k + 1}.csv", dig.face, delimiter=",", header="h", comments="")
    return tmp_path / "runs"


def make_density():
    from rock import Material
    return Material().density


LIMITS = {n: 0.2 * most for n, (_, most) in make.LAID.items()}


def test_it_holds_every_kind(runs):
    plans = make.plans(make.rng_of("a secret", "plans"), runs, LIMITS)
    kinds = Counter(p.kind for p in plans)
    assert len(plans) >= 40 and kinds["pair"] >= 6 and kinds["outside"] >= 8
    assert kinds["control"] + kinds["decoy"] >= 8
    for p in plans:
        known = {"effect": CATALOGUE, "pair": CATALOGUE, "outside": OUTSIDE, "decoy": NUISANCE, "control": ()}[p.kind]
        assert set(p.hidden) <= set(known)
    for name in make.LAID:
        assert sorted(round(p.times) for p in plans if p.kind == "effect" and name in p.hidden) == [1, 2]
    assert [p.runs for p in plans if "standoff" in p.hidden] == ["standoff_0.5"]


def test_strengths_are_limits_times(runs):
    rng = make.rng_of("a secret", "strengths")
    s, times = make.strength("crowd_friction", 2.0, rng, 60.0)
    assert s == pytest.approx(120, rel=0.1) and times == pytest.approx(s / 60)
    assert make.strength("crowd_friction", 2.0, rng, 300.0) == (360.0, 1.2)                      # within its bounds
    s, times = make.strength("crowd_friction", 1.0, rng, None)
    assert s == pytest.approx(250, rel=0.1) and times == 0


def test_what_is_sealed_is_what_is_true(runs, tmp_path, monkeypatch):
    monkeypatch.setattr(make, "plans", lambda *_: [make.Plan("effect", {"truck_spillage": 0.3}, 1.5),
                                                   make.Plan("control", {}, 0.0)])
    monkeypatch.setattr(make, "limits", dict)
    assert make.main([str(tmp_path / "set"), "a secret", str(runs)]) == 0
    seals = dict(line.split(",") for line in (tmp_path / "set/sealed.csv").read_text().split()[1:])
    with zipfile.ZipFile(tmp_path / "set/truth.zip") as box:
        truths = {Path(n).stem: box.read(n) for n in box.namelist()}
    assert {c: hashlib.sha256(t).hexdigest() for c, t in truths.items()} == seals
    truth = json.loads(truths["m01"])
    assert truth["effects"] == {"truck_spillage": 0.3} and len(truth["seeds"]) == 4
    assert sorted(f.name for f in (tmp_path / "set/reference").iterdir()) == ["m01", "m02"]
    for file in (tmp_path / "set/measured").rglob("*.*"):
        assert "spill" not in file.read_text()
    masses = np.loadtxt(tmp_path / "set/measured/m01/passes.csv", delimiter=",", skiprows=1)
    ratio = masses[masses[:, 0] == 3, 3].mean() / masses[masses[:, 0] < 3, 3].mean()
    assert ratio == pytest.approx(0.7, abs=0.04)
    assert make.main([str(tmp_path / "set"), "another", str(runs)]) == 2      # sealed once


def test_trucks_of_now_and_before_share_no_bench(runs):
    base = make.complete(runs / "base")
    now, before = make.halves(base, make.rng_of("s", "x"))
    assert len(now) == len(before) == 4 and not set(now) & set(before)
    trucks = make.drawn_trucks(now, make.rng_of("s", "y"))
    assert all(len({t[k].seed for t in trucks}) == 4 for k in range(3))


def test_fidelity_of_a_known_load(runs, tmp_path, monkeypatch):
    """Digs of 51 to 58 t, of rock 2 % too light: means of 55.6 t beside the model's passes."""
    monkeypatch.setattr(fidelity, "HERE", runs.parent)
    monkeypatch.setattr(fidelity.Motion, "read", lambda file: MOTION)
    assert fidelity.main([str(tmp_path / "t.csv")]) == 0
    rows = [line.split(",") for line in (tmp_path / "t.csv").read_text().splitlines() if line[0] != "#"]
    payload = [r for r in rows if r[:3] == ["1", "dig to dump", "payload_t"]]
    assert float(payload[0][3]) == pytest.approx(54.5 / 0.98, rel=0.002)
    assert payload[0][5] == "8" and payload[0][8] == "16"
    assert {r[1] for r in rows[1:]} == {*fidelity.PHASES, "dig to dump"}
