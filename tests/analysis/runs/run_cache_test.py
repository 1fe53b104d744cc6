"""Where an entry of the cache is, by what decides it; who may make it."""
import errno
import fcntl
from pathlib import Path

import pytest
from dipper_run.findings import BadInput
from dipper_run.run_cache import cache_folder, entry_of, locked

FACTS = {"case_hash": "c", "source_hash": "s", "cost": {}}


def test_an_entry_is_named_by_case_sources_and_what_else_decides_it():
    first = entry_of(Path("cache"), FACTS, 1, "")
    assert first == entry_of(Path("cache"), {**FACTS, "cost": {"wall_s": 3}}, "1", "") and first.parent == Path("cache")
    others = {entry_of(Path("cache"), FACTS, 2, ""), entry_of(Path("cache"), {**FACTS, "source_hash": "t"}, 1, ""),
              entry_of(Path("cache"), {**FACTS, "case_hash": "d"}, 1, "")}
    assert len(others) == 3 and first not in others


def test_the_cache_is_where_the_program_has_its_own(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("HOME", "/home/somebody")
    monkeypatch.delenv("XDG_CACHE_HOME", raising=False)
    assert cache_folder("gap") == Path("/home/somebody/.cache/dipper/gap")
    monkeypatch.setenv("XDG_CACHE_HOME", "near")
    assert cache_folder("gap") == tmp_path / "near/dipper/gap", "from the working directory"
    monkeypatch.delenv("XDG_CACHE_HOME")
    monkeypatch.delenv("HOME")
    with pytest.raises(BadInput, match="set XDG_CACHE_HOME to a folder"):
        cache_folder("gap")


@pytest.mark.parametrize("error", [errno.ENOSYS, errno.ENOLCK, errno.EOPNOTSUPP, errno.EINVAL])
def test_one_at_a_time_where_the_file_system_has_no_locks(monkeypatch, tmp_path, error):
    def refuse(*_):
        raise OSError(error, "flock")
    monkeypatch.setattr(fcntl, "flock", refuse)
    held = tmp_path / "entry.lock.held"
    with locked(tmp_path / "entry", lambda: False):
        assert held.exists()
        looks = iter([False, True])
        with locked(tmp_path / "entry", lambda: next(looks)):  # ends only because it is stopped
            pass
        assert held.exists(), "the one that had to wait takes nothing away"
    assert not held.exists()


def test_any_other_error_of_a_lock_is_raised(monkeypatch, tmp_path):
    def fail(*_):
        raise OSError(errno.EIO, "flock")
    monkeypatch.setattr(fcntl, "flock", fail)
    with pytest.raises(OSError, match="flock"), locked(tmp_path / "entry", lambda: False):
        pass
