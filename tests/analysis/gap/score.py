#!/usr/bin/python3
"""Scores blind cases: what the workflow said against truths that were sealed before it looked.

    FOLDER/sealed.csv              case,sha256            of each truth file, written before any analysis
    FOLDER/truth/CASE.yaml         {kind, effects: {NAME: strength or null}, times_limit, reference, salt}
    FOLDER/results/CASE/gap.json   what `dipper gap` said
    FOLDER/nulls.csv               case,verdict,omnibus_p: data sets in which nothing is hidden (optional)

kind: effect (one of the catalogue), pair (two of it), outside (none of it), control (no effect),
decoy (only nuisances differ), null (the model itself with fresh noise). A strength is null
where the truth's implementation has no strength in the catalogue's unit; times_limit is the strength in
detection limits of the model.

usage: score.py seal FOLDER            writes sealed.csv (refuses to write it over)
       score.py FOLDER [TABLE [CSV]]   checks the seals, scores, prints the table, writes it to TABLE, rates to CSV
"""
import csv
import hashlib
import json
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yaml
from scipy.stats import binomtest

KINDS = ("effect", "pair", "outside", "control", "decoy", "null")
# measure: (what it is called in the CSV, smallest and largest rate that meets the target)
TARGETS = {"false alarms": ("false_alarm", 0.0, 0.05), "a gap where nothing is": ("null", 0.0, 0.05),
           "wrong name": ("wrong_name", 0.0, 0.05), "right name at the limit": ("at_limit", 0.75, 1.0),
           "right name at twice the limit": ("at_twice", 0.90, 1.0),
           "right name or class": ("name_or_class", 0.90, 1.0),
           "abstains outside": ("outside", 0.80, 1.0), "interval coverage": ("coverage", 0.80, 0.97),
           "hold-out closure 60 %": ("closure", 0.90, 1.0)}


class SealBroken(ValueError):
    """A truth is not the one that was sealed."""


@dataclass(frozen=True)
class Row:
    case: str
    kind: str
    truth: str
    verdict: str
    said: str
    outcome: str       # right | class | wrong | abstained | false alarm | quiet
    covered: object    # True, False, or None where there is nothing to cover
    closure: object
    times: float = 1.0  # the truth's strength, in detection limits
    reference: bool = False  # earlier trucks were given


def sha256(file):
    return hashlib.sha256(file.read_bytes()).hexdigest()


def seal(folder):
    target = folder / "sealed.csv"
    if target.exists():
        raise SealBroken(f"{target} is there already: truths are sealed once")
    rows = [(f.stem, sha256(f)) for f in sorted((folder / "truth").glob("*.yaml"))]
    target.write_text("case,sha256\n" + "".join(f"{c},{h}\n" for c, h in rows))
    return len(rows)


def outcome(kind, effects, a):
    """What a verdict is worth, given the truth."""
    named, members = a["verdict"] == "named", a["class"] if a["verdict"] == "class" else []
    if kind in ("effect", "pair"):
        if named:
            return "right" if a["effect"] in effects else "wrong"
        if members:
            return "class" if set(members) & set(effects) else "wrong"
        return "abstained"
    if kind == "outside":
        return "wrong" if named or members else "abstained"
    loud = a["verdict"] != "no-gap" if kind == "null" else named or bool(members)
    return "false alarm" if loud else "quiet"


def score_case(folder, case):
    truth = yaml.safe_load((folder / "truth" / f"{case}.yaml").read_text())
    if truth["kind"] not in KINDS:
        raise ValueError(f"{case}: kind is {truth['kind']}; one of {', '.join(KINDS)}")
    effects = truth.get("effects") or {}
    a = json.loads((folder / "results" / case / "gap.json").read_text())
    result = outcome(truth["kind"], effects, a)
    covered = closure = None
    if result == "right":
        strength = effects[a["effect"]]
        if strength is not None:
            low, high = a["parameter"]["interval90"]
            covered = bool(low <= strength <= high)
        closure = a["gap"]["holdout_closure"]
    said = a["effect"] or ", ".join(a["class"])
    return Row(case, truth["kind"], ", ".join(effects) or "-", a["verdict"], said or "-", result, covered, closure,
               float(truth.get("times_limit", 1.0)), bool(truth.get("reference", False)))


def null_rows(folder):
    """(data sets called anything but no gap, data sets)."""
    file = folder / "nulls.csv"
    if not file.is_file():
        return 0, 0
    with open(file) as f:
        rows = list(csv.DictReader(f))
    return sum(r["verdict"] != "no-gap" for r in rows), len(rows)


def score(folder):
    """Rows of all sealed cases that have a result. Throws SealBroken when a truth was changed."""
    folder = Path(folder)
    with open(folder / "sealed.csv") as f:
        seals = {r["case"]: r["sha256"] for r in csv.DictReader(f)}
    for case, expected in seals.items():
        file = folder / "truth" / f"{case}.yaml"
        if not file.is_file() or sha256(file) != expected:
            raise SealBroken(f"{file}: not the truth that was sealed")
    for file in (folder / "truth").glob("*.yaml"):
        if file.stem not in seals:
            raise SealBroken(f"{file}: has no seal")
    return [score_case(folder, c) for c in sorted(seals) if (folder / "results" / c / "gap.json").is_file()]


def rates(rows, nulls=(0, 0)):
    """{what: (hits, of)}, what the targets are about. Half a limit is beyond what is asked of names."""
    def count(kinds, outcomes, least=0.0, most=np.inf):
        chosen = [r for r in rows if r.kind in kinds and least <= r.times < most]
        return sum(r.outcome in outcomes for r in chosen), len(chosen)

    known = ("effect", "pair")
    covered = [r.covered for r in rows if r.covered is not None]
    closures = [r.closure for r in rows if r.closure is not None]
    return {"false alarms": count(("control", "decoy", "null"), ("false alarm",)),
            "a gap where nothing is": nulls,
            "wrong name": count(known + ("outside",), ("wrong",)),
            "right name at the limit": count(known, ("right",), 0.75, 1.5),
            "right name at twice the limit": count(known, ("right",), 1.5),
            "right name or class": count(known, ("right", "class"), 0.75),
            "abstains outside": count(("outside",), ("abstained",)),
            "interval coverage": (sum(covered), len(covered)),
            "hold-out closure 60 %": (sum(c >= 0.6 for c in closures), len(closures))}


def goal(name):
    low, high = TARGETS[name][1:]
    return f"<= {high:g}" if low == 0 else f">= {low:g}" if high == 1 else f"{low:g} ... {high:g}"


def missed(name, hits, of):
    """Whether a rate is outside its target; not for nothing of nothing."""
    low, high = TARGETS[name][1:]
    return of > 0 and not low <= hits / of <= high


def halves(rows):
    """Rates of the cases with a reference, and of those without."""
    return tuple(rates([r for r in rows if r.reference == before]) for before in (True, False))


def table(rows, nulls=(0, 0)):
    """The scores in Markdown: rates with 95 % intervals beside the targets, then every case."""
    out = ["| measure | hits | of | rate | 95 % interval | target | with a reference | without |",
           "|---|---|---|---|---|---|---|---|"]
    before, alone = halves(rows)
    for name, (hits, of) in rates(rows, nulls).items():
        parts = ["-" if of == 0 else f"{h} of {n}" for h, n in (before[name], alone[name])]
        rate, interval = "-", "-"
        if of:
            ci = binomtest(hits, of).proportion_ci(method="wilson")
            rate, interval = f"{hits / of:.2f}", f"{ci.low:.2f} ... {ci.high:.2f}"
        out.append(f"| {name} | {hits} | {of} | {rate} | {interval} | {goal(name)} | {' | '.join(parts)} |")
    closures = [r.closure for r in rows if r.closure is not None]
    if closures:
        out.append(f"\nMedian hold-out closure of right names: {100 * np.median(closures):.0f} %.")
    out += ["", "| case | kind | truth | times limit | reference | verdict | said | outcome | covered | closure |",
            "|---|---|---|---|---|---|---|---|---|---|"]
    for r in rows:
        covered = {None: "-", True: "yes", False: "no"}[r.covered]
        closure = "-" if r.closure is None else f"{r.closure:.2f}"
        out.append(f"| {r.case} | {r.kind} | {r.truth} | {r.times:.2g} | {'yes' if r.reference else 'no'} | "
                   f"{r.verdict} | {r.said} | {r.outcome} | {covered} | {closure} |")
    return "\n".join(out) + "\n"


def rates_csv(rows, nulls=(0, 0)):
    """measure,hits,of,target and the same of the cases with a reference, a measure a line."""
    before = halves(rows)[0]
    return "measure,hits,of,target,hits_reference,of_reference\n" + "".join(
        f"{TARGETS[name][0]},{hits},{of},{goal(name)},{before[name][0]},{before[name][1]}\n"
        for name, (hits, of) in rates(rows, nulls).items())


def main(words):
    try:
        if len(words) == 2 and words[0] == "seal":
            print(f"{seal(Path(words[1]))} truths sealed")
        elif len(words) in (1, 2, 3):
            scored = score(words[0]), null_rows(Path(words[0]))
            print(table(*scored), end="")
            for file, write in zip(words[1:], (table, rates_csv)):
                Path(file).write_text(write(*scored))
        else:
            print(__doc__, file=sys.stderr)
            return 2
    except (SealBroken, FileNotFoundError, ValueError) as e:
        print(f"score: {e}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
