"""The scorer: what each verdict is worth, that a seal holds, and the rates it reports."""
import json
import subprocess
import sys
from pathlib import Path

import pytest

import score

ANSWER = {"verdict": "named", "effect": "fines", "class": ["fines"], "gap": {"holdout_closure": 0.8},
          "parameter": {"interval90": [0.1, 0.3]}}


def answer(verdict, effect=None, members=()):
    return {**ANSWER, "verdict": verdict, "effect": effect, "class": list(members)}


@pytest.mark.parametrize("kind, truth, said, expected", [
    ("effect", ["fines"], answer("named", "fines"), "right"),
    ("effect", ["fines"], answer("named", "liners", ["liners"]), "wrong"),
    ("effect", ["fines"], answer("class", None, ["liners", "fines"]), "class"),
    ("effect", ["fines"], answer("class", None, ["liners"]), "wrong"),
    ("effect", ["fines"], answer("unknown"), "abstained"),
    ("pair", ["fines", "liners"], answer("named", "liners"), "right"),
    ("outside", [], answer("named", "liners"), "wrong"),
    ("outside", [], answer("class", None, ["a", "b"]), "wrong"),
    ("outside", [], answer("unknown"), "abstained"),
    ("control", [], answer("unknown"), "quiet"),
    ("control", [], answer("named", "fines"), "false alarm"),
    ("decoy", [], answer("class", None, ["a", "b"]), "false alarm"),
    ("null", [], answer("unknown"), "false alarm"),
    ("null", [], answer("no-gap"), "quiet")])
def test_outcome(kind, truth, said, expected):
    assert score.outcome(kind, truth, said) == expected


@pytest.fixture
def blind(tmp_path):
    cases = {"a": ("effect", {"fines": 0.2}, ANSWER), "b": ("effect", {"fines": 0.5}, ANSWER),
             "c": ("null", {}, answer("no-gap")), "d": ("outside", {}, answer("named", "fines", ["fines"]))}
    (tmp_path / "truth").mkdir()
    for case, (kind, effects, said) in cases.items():
        (tmp_path / "truth" / f"{case}.yaml").write_text(json.dumps(
            {"kind": kind, "effects": effects, "times_limit": 2.0 if case == "b" else 1.0, "reference": case == "b",
             "salt": case * 8}))
        (tmp_path / "results" / case).mkdir(parents=True)
        (tmp_path / "results" / case / "gap.json").write_text(json.dumps(said))
    assert score.seal(tmp_path) == 4
    return tmp_path


def test_rates(blind):
    rows = score.score(blind)
    r = score.rates(rows)
    assert r["right name at the limit"] == (1, 1) and r["right name at twice the limit"] == (1, 1)
    assert r["a gap where nothing is"] == (0, 0)
    assert r["wrong name"] == (1, 3) and r["false alarms"] == (0, 1)
    assert r["interval coverage"] == (1, 2) and r["hold-out closure 60 %"] == (2, 2)
    assert r["abstains outside"] == (0, 1)
    text = score.table(rows)
    assert "| wrong name | 1 | 3 | 0.33 |" in text
    assert "| b | effect | fines | 2 | yes | named | fines | right | no |" in text
    assert "\nwrong_name,1,3,<= 0.05,0,1\n" in score.rates_csv(rows)
    assert score.missed("interval coverage", 1, 1) and not score.missed("interval coverage", 9, 10)


def test_a_truth_changed_after_sealing_is_refused(blind, capsys):
    file = blind / "truth" / "a.yaml"
    file.write_text(file.read_text().replace("0.2", "0.3"))
    with pytest.raises(score.SealBroken, match="a.yaml: not the truth that was sealed"):
        score.score(blind)
    assert score.main([str(blind)]) == 2 and "a.yaml" in capsys.readouterr().err


def test_a_truth_added_later_has_no_seal(blind):
    (blind / "truth" / "z.yaml").write_text("{kind: null}")
    with pytest.raises(score.SealBroken, match="no seal"):
        score.score(blind)


def test_truths_are_sealed_once(blind):
    with pytest.raises(score.SealBroken, match="sealed once"):
        score.seal(blind)


ROOT = Path(score.__file__).resolve().parents[3]
BLIND = Path(score.__file__).parent / "blind"


# What is missed, and why: docs/gap_evidence.md
@pytest.mark.parametrize("folder, rates, missed", [
    ("blind", "gap_blind_first.csv", {"wrong name", "right name at the limit", "right name at twice the limit",
                                      "right name or class", "abstains outside", "interval coverage"}),
    ("blind_second", "gap_blind.csv", {"wrong name", "right name at the limit", "right name at twice the limit",
                                       "right name or class"})])
def test_the_stored_blind_cases_score_what_the_table_says(folder, rates, missed):
    folder = BLIND.parent / folder
    rows, nulls = score.score(folder), score.null_rows(folder)
    assert score.table(rows, nulls) == (folder / "table.md").read_text()
    assert len(rows) == len(list((folder / "measured").iterdir())) >= 40
    assert score.rates_csv(rows, nulls) == (ROOT / "docs/data" / rates).read_text()
    assert {name for name, (hits, of) in score.rates(rows, nulls).items() if score.missed(name, hits, of)} == missed


def test_the_analysing_script_starts():
    done = subprocess.run([sys.executable, "-B", BLIND / "analyse.py"], capture_output=True, text=True)
    assert done.returncode == 2 and "usage: analyse.py" in done.stderr
