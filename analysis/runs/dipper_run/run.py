"""A run's folder as numpy arrays.

    run = dipper_run.read("runs/quick")
    run.time_s, run["machine/hoist_force"]       # record.h5
    run.summary["passes"][0]["payload_kg"]       # summary.json; run.metrics is report/metrics.json
    run.table("frames")["in_dipper_kg"]          # report/frames.csv
    run.frames[-1].rocks["radius"]               # the last of dumps/rocks_*.dump.gz
"""
import csv
import functools
import gzip
import io
import json
import re
import zlib
from pathlib import Path

import h5py
import numpy as np

from .file_hash import sha256_of

RUN_MANIFEST = "manifest.sha256"
FRAME = re.compile(r"rocks_(\d+)\.dump(\.gz)?")


class NotARun(ValueError):
    """The folder, or the file asked for, is not what a run leaves; the message says what would make it."""


def read(folder):
    """The Run in `folder`. Raises NotARun where there is no record of one."""
    return Run(folder)


class Run:
    """What `dipper run` (and `dipper report`) left in a folder; everything is read when it is asked for.

    Raises NotARun for what is not there, or is not what the run wrote (manifest.sha256).
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        if not any((self.folder / name).is_file() for name in ("record.h5", "summary.json")):
            raise NotARun(f"{folder}: no record.h5 and no summary.json; give the folder of a `dipper run`")

    @functools.cached_property
    def summary(self):
        """summary.json as a dict; a run writes it at its end. NotARun while a resumed run has not ended again."""
        found = self._json("summary.json", "a run writes it when it ends")
        if (self.folder / "record.h5").is_file() and "sim_s" in found:
            with self._record() as record:
                end_s = float(record["time_s"][-1])
            if abs(found["sim_s"] - end_s) > 1e-6:
                raise NotARun(f"{self.folder / 'summary.json'}: is of an earlier end, at {found['sim_s']:g} s; the run "
                              f"was resumed, has come to {end_s:g} s, and writes it anew when it ends")
        return found

    @functools.cached_property
    def metrics(self):
        """report/metrics.json as a dict (docs/metrics.md)."""
        return self._json("report/metrics.json", f"`dipper report {self.folder}` writes it")

    @functools.cached_property
    def case(self):
        """{key: value as text} of the case as it ran."""
        with self._record() as record:
            text = record.attrs["case"]
        text = text.decode() if isinstance(text, bytes) else text
        return dict(line.split("=", 1) for line in text.splitlines() if "=" in line)

    @functools.cached_property
    def channels(self):
        """{name: (unit, frame)} of every channel of record.h5."""
        found = {}

        def see(name, item):
            if isinstance(item, h5py.Dataset):
                found[name] = (_text(item.attrs.get("unit", "")), _text(item.attrs.get("frame", "")))

        with self._record() as record:
            record.visititems(see)
        return found

    @functools.cached_property
    def rows(self):
        """Sync steps that every channel holds: the channels of a run that was killed may differ by some."""
        with self._record() as record:
            return min(len(record[name]) for name in self.channels)

    def __getitem__(self, channel):
        """A channel of record.h5: one row a sync step, at time_s; in the unit and frame that `channels` gives."""
        if channel not in self.channels:
            raise KeyError(f"{channel}; the record has {', '.join(sorted(self.channels))}")
        with self._record() as record:
            return record[channel][:self.rows]

    @property
    def time_s(self):
        return self["time_s"]

    def table(self, name):
        """{column: array} of report/NAME.csv: frames, passes, phases, stages, pile, sizes. Text stays text."""
        file = self._file(f"report/{name}.csv", f"`dipper report {self.folder}` writes it")
        with open(file, newline="") as f:
            text = f.read()
        header, *rows = csv.reader(io.StringIO(text)) if text else [[]]
        if not (header and text.endswith("\n")) or any(len(row) != len(header) for row in rows):
            raise NotARun(f"{file}: cut short; `dipper report {self.folder}` writes it again")
        return {column: _values(cells) for column, cells in zip(header, zip(*rows) if rows else [()] * len(header))}

    @functools.cached_property
    def frames(self):
        """The rock at the times of the dumps: [Frame], in order."""
        found = [(int(m[1]), file) for file in self.folder.glob("dumps/rocks_*.dump*")
                 if (m := FRAME.fullmatch(file.name))]
        timestep_s = float(self.case["dem.timestep_s"]) if found else 0.0
        return [Frame(step, step * timestep_s, file) for step, file in sorted(found)]

    def _json(self, name, makes):
        try:
            return json.loads(self._file(name, makes).read_text())
        except ValueError as e:
            raise NotARun(f"{self.folder / name}: {e}") from e

    def _record(self):
        file = self._file("record.h5", "`dipper run` writes it; a study may keep summaries only (`keep: summary`)")
        try:
            return h5py.File(file, "r", locking=False)  # the run may still be writing
        except OSError as e:
            raise NotARun(f"{file}: cannot be opened: {e}") from e

    def _file(self, name, makes):
        file = self.folder / name
        if not file.is_file():
            raise NotARun(f"{file}: is not there; {makes}")
        if name in self._damaged:
            raise NotARun(f"{file}: is not what the run wrote ({RUN_MANIFEST})")
        return file

    @functools.cached_property
    def _damaged(self):
        """Names in the manifest whose files are there and have other sums."""
        manifest = self.folder / RUN_MANIFEST
        rows = [line.split(None, 1) for line in manifest.read_text().splitlines()] if manifest.is_file() else []
        return {name for listed, name in rows
                if (self.folder / name).is_file() and sha256_of(self.folder / name) != listed}


class Frame:
    """The rock at one time: `rocks` are the columns of a dump, one entry a sphere (docs/results.md)."""

    def __init__(self, step, time_s, file):
        self.step, self.time_s, self.file = step, time_s, file

    @functools.cached_property
    def rocks(self):
        """{column: array}, in W and SI: id, type, x, y, z, vx, ..., radius.

        Raises NotARun for a dump that was cut short: the run is writing it, or ended while it did.
        """
        try:
            with (gzip.open if self.file.suffix == ".gz" else open)(self.file, "rt") as f:
                count = 0
                for line in f:
                    if line.startswith("ITEM: NUMBER OF ATOMS"):
                        count = int(next(f))
                    if line.startswith("ITEM: ATOMS"):
                        break
                else:
                    raise NotARun(f"{self.file}: no ITEM: ATOMS; not a dump of spheres")
                names, text = line.split()[2:], f.read()
        except (EOFError, zlib.error, gzip.BadGzipFile) as e:
            raise NotARun(f"{self.file}: cut short or damaged: {e}") from e
        numbers = text.split()
        if text[-1:] not in ("", "\n") or len(numbers) != count * len(names):
            raise NotARun(f"{self.file}: cut short: not the {count} spheres that it names")
        return dict(zip(names, np.array(numbers, float).reshape(count, len(names)).T))


def _values(cells):
    """Numbers where all cells are (an empty one is nan), else text."""
    try:
        return np.array([float(c) if c else np.nan for c in cells])
    except ValueError:
        return np.array(cells)


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)
