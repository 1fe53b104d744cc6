"""Where an entry of the cache is, by what decides it."""
from pathlib import Path

from dipper_run.run_cache import entry_of

TOLD = {"case_hash": "c", "source_hash": "s", "cost": {}}


def test_an_entry_is_named_by_case_sources_and_what_else_decides_it():
    first = entry_of(Path("cache"), TOLD, 1, "")
    assert first == entry_of(Path("cache"), {**TOLD, "cost": {"wall_s": 3}}, "1", "") and first.parent == Path("cache")
    others = {entry_of(Path("cache"), TOLD, 2, ""), entry_of(Path("cache"), {**TOLD, "source_hash": "t"}, 1, ""),
              entry_of(Path("cache"), {**TOLD, "case_hash": "d"}, 1, "")}
    assert len(others) == 3 and first not in others
