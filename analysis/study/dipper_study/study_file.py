"""STUDY.yaml, validated whole; docs/study.md has its keys."""
import itertools
import os
from dataclasses import dataclass
from pathlib import Path

import yaml

from dipper_run.findings import Findings
from dipper_run.section import Section
from dipper_run.text_file import number, read_text, read_yaml, said

from .goal import Constraint, Objective, read_objective
from .results import FIGURES

KEEPS = ("summary", "record", "all")
EXECUTORS = ("local", "slurm")
MOST_RANKS = 100_000
DUMPS = "output.dump_every_s"
ON_DUMPS = "fill_factor_load"  # the column that a run without dumps does not have
TABLE_COLUMNS = ("run", "seed", "status", *FIGURES)  # of study.csv, beside the parameters


@dataclass(frozen=True)
class Setting:
    """KEY=VALUE as `--set` takes it, and the line of the study that says so."""

    key: str
    text: str
    line: int

    def __str__(self):
        return f"{self.key}={self.text}"


@dataclass(frozen=True)
class Value:
    """One value of a parameter. `number` is None where its name is none."""

    name: str
    settings: tuple
    number: float = None


@dataclass(frozen=True)
class Parameter:
    name: str
    values: tuple


@dataclass(frozen=True)
class Point:
    """One setting of all parameters."""

    values: tuple        # a Value a parameter
    settings: tuple      # of them and of `set`

    def __str__(self):
        return ", ".join(v.name for v in self.values) or "the case"


@dataclass(frozen=True)
class Slurm:
    partition: str = None
    time_limit_min: int = 60
    retries: int = 2
    at_once: int = None       # tasks of the array that may run at a time
    options: tuple = ()       # of sbatch, as they are


@dataclass(frozen=True)
class Range:
    """A case key between two numbers."""

    key: str
    low: float
    high: float
    line: int


@dataclass(frozen=True)
class Optimise:
    objective: Objective
    maximise: bool
    constraints: tuple
    ranges: tuple
    start: int           # points before the first model
    points: int          # points in all
    batch: int           # chosen at a time
    confirm_seeds: tuple

    def uses(self, column):
        goals = [self.objective, *(c.objective for c in self.constraints)]
        return any(column in (goal.first, goal.second) for goal in goals if goal)


@dataclass(frozen=True)
class Study:
    file: Path
    text: str            # of the file as it was read: it may be edited while runs go on
    case: Path
    seeds: tuple
    fixed: tuple         # Settings of every run
    parameters: tuple
    ranks: int
    jobs: int            # at a time; None: as many as the cores take
    keep: str
    executor: str
    slurm: Slurm
    optimise: Optimise = None

    @property
    def names(self):
        return [p.name for p in self.parameters] or [r.key for r in self.optimise.ranges if self.optimise]

    @property
    def dumps(self):
        """Whether runs write dumps while the dipper digs."""
        return self.keep == "all" or any(s.key == DUMPS for s in self.fixed)

    def points(self):
        """Every combination of values, the last parameter running fastest."""
        return [Point(values, self.fixed + tuple(s for v in values for s in v.settings))
                for values in itertools.product(*(p.values for p in self.parameters))]

    def point_at(self, numbers):
        """The Point of an optimisation at these numbers, one a range."""
        values = tuple(Value(f"{x:.6g}", (Setting(r.key, f"{x:.9g}", r.line),), float(x))
                       for r, x in zip(self.optimise.ranges, numbers))
        return Point(values, self.fixed + tuple(s for v in values for s in v.settings))


def read_study(file):
    """The Study of a file; raises BadInput with everything that is wrong with it."""
    file, found = Path(file), Findings()
    root = read_yaml(file, found, "a study: case, seeds, parameters; see docs/study.md")
    found.raise_if_any()
    top = Section(root, file, found)
    case = top.text("case")
    study = Study(file, read_text(file, found), _beside(file, case or ""), _seeds(top, "seeds"), _fixed(top),
                  _parameters(top), top.whole("ranks", 1, MOST_RANKS, 1), top.whole("jobs", 1, MOST_RANKS, None),
                  top.one_of("keep", KEEPS, "record"), top.one_of("executor", EXECUTORS, "local"), _slurm(top),
                  _optimise(top))
    if case and not (study.case / "case.yaml").is_file():
        top.wrong("case", f"{study.case} has no case.yaml", "the folder of a case, seen from the study's file")
    top.end(required=("case", "seeds"))
    if not study.optimise and "parameters" not in top.keys():
        top.wrong("parameters", "missing", "give them, or optimise")
    if study.optimise and study.parameters:
        top.wrong("parameters", "beside optimise", "one of the two; optimise has parameters of its own")
    if study.optimise and study.optimise.uses(ON_DUMPS) and not study.dumps:
        top.wrong("keep", f"is {study.keep}", f"all, or set: {{{DUMPS}: 0.5}}, where optimise has {ON_DUMPS}, which is "
                  "measured on the dumps")
    _set_once(study, top)
    found.raise_if_any()
    return study


def _beside(file, case):
    """The folder that a study's `case` names; "..", behind a link, leads as the system follows it."""
    there = file.parent / case
    plain = Path(os.path.normpath(there))
    return plain if plain.resolve() == there.resolve() else there.resolve()


def _seeds(section, key):
    found = []
    for node in section.items(key, "whole numbers"):
        value = number(node.value) if isinstance(node, yaml.ScalarNode) else None
        if value is None or value != int(value) or not 0 <= value < 2**31:
            section.wrong(key, f"has {said(node)}", "whole numbers from 0", node)
        elif int(value) in found:
            section.wrong(key, f"has {int(value)} twice", "each once", node)
        else:
            found.append(int(value))
    return tuple(found)


def _setting(section, key, node):
    """What `--set` takes: a scalar, or a list or map in flow style."""
    if isinstance(node, yaml.ScalarNode):
        return Setting(key, node.value, node.start_mark.line + 1)
    if not node.flow_style:
        section.wrong(key, f"is {said(node)} in lines of its own", "in flow style, [...] or {...}, as --set takes it")
    text = node.start_mark.buffer[node.start_mark.pointer:node.end_mark.pointer]
    return Setting(key, text, node.start_mark.line + 1)


def _settings(section):
    return tuple(_setting(section, key, section.get(key)) for key in section.keys())


def _fixed(top):
    return _settings(top.section("set"))


def _parameters(top):
    section = top.filled("parameters", "a case key with a list of its values, KEY: [...], or more of them")
    return tuple(_parameter(section, name) for name in section.keys())


def _parameter(section, name):
    """A key with a list of its values, or a name with a map {value's name: {key: value}}."""
    if isinstance(section.get(name), yaml.MappingNode):
        inner = section.filled(name, "named values, each some keys: {wide: {bodies.dipper: wide.stl}}")
        values = [_named(inner, key) for key in inner.keys()]
        if name in TABLE_COLUMNS or "/" in name or not name.strip(". "):
            section.wrong(name, "cannot name a column of study.csv",
                          f"a name without /, none of {', '.join(TABLE_COLUMNS)}")
    else:
        values = []
        for node in section.items(name, "values"):
            setting = _setting(section, name, node)
            values.append(Value(setting.text, (setting,), number(setting.text)))
    names = [v.name for v in values]
    for twice in sorted({n for n in names if names.count(n) > 1}):
        section.wrong(name, f"has {twice} twice", "each value once")
    return Parameter(name, tuple(values))


def _named(section, name):
    return Value(name, _settings(section.section(name)), number(name))


def _slurm(top):
    section = top.section("slurm")
    options = tuple(node.value for node in section.items("options", "options of sbatch") if said(node))
    slurm = Slurm(section.text("partition"), section.whole("time_limit_min", 1, 10**6, Slurm.time_limit_min),
                  section.whole("retries", 0, 100, Slurm.retries), section.whole("at_once", 1, 10**6, None), options)
    section.end()
    return slurm


def _optimise(top):
    section = top.section("optimise")
    if not section:
        return None
    goals = [key for key in ("maximise", "minimise") if section.get(key) is not None]
    if len(goals) != 1:
        section.wrong("maximise", "both or none of maximise and minimise", "one of them")
    objective = read_objective(section, goals[0]) if goals else None
    inner = section.filled("parameters", "a case key between two numbers, KEY: {low: ..., high: ...}, or more of them")
    ranges = tuple(r for name in inner.keys() if (r := _range(inner, name)))
    bounds = section.section("constraints")
    constraints = tuple(_constraint(bounds, name) for name in bounds.keys())
    start = section.whole("start", 3, 1000, max(4, 2 * len(ranges) + 1))
    optimise = Optimise(objective, goals == ["maximise"], constraints, ranges, start,
                        section.whole("points", start, 10_000, start + 8), section.whole("batch", 1, 100, 2),
                        _seeds(section, "confirm_seeds"))
    section.end(required=("parameters", "confirm_seeds"))
    if set(optimise.confirm_seeds) & set(_seeds(top, "seeds")):
        section.wrong("confirm_seeds", "has seeds of the search", "fresh ones: others than in seeds")
    if len(optimise.confirm_seeds) < 2 and section.get("confirm_seeds") is not None:
        section.wrong("confirm_seeds", "fewer than 2", "two or more: the answer is compared with their spread")
    if len(_seeds(top, "seeds")) < 2:
        top.wrong("seeds", "fewer than 2", "two or more with optimise, which estimates the noise from them")
    return optimise


def _range(section, name):
    inner = section.section(name)
    if not inner:
        return None
    low, high = (inner.number(key) for key in ("low", "high"))
    inner.end(required=("low", "high"))
    if low is None or high is None:
        return None
    if not low < high:
        section.wrong(name, f"{low:g} is not below {high:g}", "low below high")
    return Range(name, low, high, section.line_of(name))


def _constraint(section, name):
    inner = section.section(name)
    at_most, at_least = (inner.number(k) for k in ("at_most", "at_least"))
    inner.end()
    if inner and (at_most is None) == (at_least is None):
        section.wrong(name, "both or none of at_most and at_least", "one of them")
    return Constraint(read_objective(section, name, name), at_most, at_least)


def _set_once(study, top):
    """No key may be set by two parameters, or by one and `set`."""
    groups = [("set", study.fixed)]
    groups += [(p.name, tuple(s for v in p.values for s in v.settings)) for p in study.parameters]
    owner = {}
    for name, settings in groups:
        for s in {s.key: s for s in reversed(settings)}.values():
            if s.key in ("seed", "dem.ranks"):
                right = "seeds: [...]" if s.key == "seed" else "ranks: N"
                top.found.add(study.file, s.line, s.key, "is the study's own", right)
            if owner.setdefault(s.key, name) != name:
                top.found.add(study.file, s.line, s.key, f"is set by {owner[s.key]} too", "by one of them")
