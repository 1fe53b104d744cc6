"""What a study's columns say of a run: objectives, constraints."""
import re
from dataclasses import dataclass

# Column: what it is. Of a run of many passes the mean over them, the largest for peaks.
COLUMNS = {
    "payload_t": "rock in the dipper after the dig",
    "truck_t": "rock that came into the truck",
    "fill_factor": "payload by what the struck volume holds at the settled pile's density",
    "fill_factor_load": "payload by what the struck volume holds at the load's own density",
    "dig_force_mean_MN": "mean dig force from first contact to the dump",
    "dig_phases_force_mean_MN": "mean dig force from penetrate to breakout",
    "dig_force_peak_MN": "largest dig force",
    "dig_work_MJ": "work of hoist and crowd while it digs",
}
OBJECTIVE = re.compile(r"(\w+)(?:\s*([-/])\s*(\w+))?")


@dataclass(frozen=True)
class Objective:
    """A column, the ratio or the difference of two."""

    text: str
    first: str
    how: str = None
    second: str = None

    def value_in(self, row):
        """Its value in a row of a study; nan where a column is missing, and for a run that ended within a pass."""
        if row.get("status") == "unfinished":
            return float("nan")
        a = row.get(self.first, float("nan"))
        if self.how is None:
            return a
        b = row.get(self.second, float("nan"))
        if self.how == "-":
            return a - b
        return a / b if b else float("nan")


@dataclass(frozen=True)
class Constraint:
    objective: Objective
    at_most: float = None
    at_least: float = None

    def margin(self, value):
        """How far inside the bound a value is; negative outside."""
        return self.at_most - value if self.at_least is None else value - self.at_least

    def __str__(self):
        bound = f"at most {self.at_most:g}" if self.at_least is None else f"at least {self.at_least:g}"
        return f"{self.objective.text} {bound}"


def read_objective(section, key, text=None):
    """The Objective that a key of a Section says (or `text`, which is the key itself)."""
    text = text or section.text(key, "")
    found = OBJECTIVE.fullmatch(text.strip())
    if not found:
        section.wrong(key, f"is {text or 'no text'}", "a column, or two with / or - between")
        return None
    for name in (found[1], found[3]):
        if name and name not in COLUMNS:
            section.wrong(key, f"{name} is no column", f"of {', '.join(COLUMNS)}")
    return Objective(text.strip(), *found.groups())
