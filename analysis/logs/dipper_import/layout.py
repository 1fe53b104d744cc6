"""How a log lays its readings out: a column a channel; a time column beside each; or a row a reading, with its tag."""
import re
from collections import Counter
from dataclasses import dataclass

from dipper_run.csv_text import decimal_number, find_decimal
from dipper_run.text_file import nearest

from .phrases import some_names
from .units import other_unit, unit_in_name, unit_said

QUALITY = re.compile(r"qualit|calidad|status|valid|good|confiden|flag|\bqual\b|\bqc\b|_qc?$|\bok\b|_ok$", re.IGNORECASE)
UNSOUND = re.compile(r"\bbad|uncertain|questionable|invalid|fail|error|stale|comm\b|time.?out|false", re.IGNORECASE)
FEWER_WORDS = 4  # beside the time: good, bad and two between
GOOD_CODE = "192"  # a number that says how good a reading is
OF_UNITS = re.compile(r"unit|uom|^eu$|einheit|unidad", re.IGNORECASE)
OF_MACHINE = re.compile(r"eqmt|equip|machine|shovel|asset|unit|\bid\b", re.IGNORECASE)  # of a row
SHARE = 0.2  # of the rows, of the machine with the second most: a log of one has no such other
FEW_WORDS = 8  # different cells: a column beside a reading with more says something else than how good it is
ROWS_LOOKED_AT = 5000  # of a log with a row a reading: where tags and numbers are looked for


@dataclass(frozen=True)
class Group:
    """Channels that share their rows: a line, a stamp's text and a cell of each channel a row."""

    lines: list
    stamps: list
    cells: dict      # {channel: list}
    quality: dict    # {channel: list}, of the channels whose quality is logged

    def only(self, rows):
        take = lambda cells: [cells[k] for k in rows]
        return Group(take(self.lines), take(self.stamps), {n: take(c) for n, c in self.cells.items()},
                     {n: take(c) for n, c in self.quality.items()})


def find_layout(what, path, header_line, names, between, rows, found, notes):
    """The log's Groups; None after a finding. `between`: rows between the header and the readings."""
    header = _Header(what, path, header_line, names, found)
    missing = [n for n, c in what.channels.items() if c.column not in names]
    if len(missing) == len(what.channels) and rows:
        tags = _column_of_tags(what, names, rows)
        if tags is not None:
            return _long(header, rows, tags, notes)
        like = _like_tags(what, names, rows)
        found.add(what.path, what.time.line, "channels",
                  f"none of their columns is in the header of {path.name}, line {header_line}",
                  (like or f"file.header_line, if that is not the header; it has {some_names(names)}")
                  + ("" if len(names) > 1 else
                     "; columns are parted by , ; | or a tab (file.delimiter), not by blanks"))
        return None
    return _wide(header, between, rows, notes)


class _Header:
    """Where the map's columns stand in the header."""

    def __init__(self, what, path, line, names, found):
        self.what, self.path, self.line, self.names, self.found = what, path, line, names, found

    def place(self, column, key, line, right_of=None):
        """Index of a column; None after a finding. Of columns of one name the next to the left of `right_of`, or to
        the right where the first reading has none to its left."""
        places = [k for k, n in enumerate(self.names) if n == column]
        if right_of is not None and len(places) > 1:
            first = min(k for k, n in enumerate(self.names) if n in {c.column for c in self.what.channels.values()})
            places = [k for k in places if k < right_of][-1:] if places[0] < first else \
                [k for k in places if k > right_of][:1]
        if len(places) == 1:
            return places[0]
        if places:
            wrong, right = f"'{column}' is the name of {len(places)} columns", "names that differ"
        else:
            like = nearest(column, self.names)
            wrong = f"'{column}' is no column of {self.path.name} (line {self.line})"
            right = (f"'{like}', perhaps? " if like else "") + f"it has {some_names(self.names)}"
        self.found.add(self.what.path, line, key, wrong, right)
        return None

    def check_units(self, name, said):
        """Finding about the first of the (line, unit) that the log states for a channel and that is not the map's."""
        channel = self.what.channels[name]
        units = dict.fromkeys(unit for _, unit in said if unit)
        for line, unit in said:
            if other := other_unit(unit, name, channel):
                self.found.add(self.path, line, channel.column,
                               f"is in {other[0]} here, and in {channel.unit} by the map",
                               other[1] if len(units) == 1 else f"one unit in all of the log, not {', '.join(units)}")
                return

    def time(self, right_of=None):
        what = self.what.time
        return [self.place(c, "time.column", what.line, right_of) for c in what.columns]

    def quality(self, name):
        channel = self.what.channels[name]
        return None if channel.quality is None else \
            self.place(channel.quality, f"channels.{name}.quality", channel.line)


def _wide(header, between, rows, notes):
    """A column a channel, and one time for all of them, or one for each: the next one to the left."""
    what, before = header.what, len(header.found.all)
    place = {n: header.place(c.column, f"channels.{n}.column", c.line) for n, c in what.channels.items()}
    quality = {n: header.quality(n) for n in place}
    if len(header.found.all) > before:
        return None
    for name, at in place.items():
        said = [(header.line, unit_in_name(header.names[at]))]
        header.check_units(name, said + [(i, unit_said(cells[at])) for i, cells in between if at < len(cells)])
    times = {}
    for name, at in place.items():
        own = what.channels[name].time
        cells = [header.place(own, f"channels.{name}.time", what.channels[name].line)] if own else header.time(at)
        if None in cells:
            return None
        times.setdefault(tuple(cells), []).append(name)
    _find_machines(header, rows, next(iter(times)), {*place.values(), *quality.values(), *sum(times, ())}, False)
    if len(header.found.all) > before:
        return None
    if len(times) == 1:
        return [_group(rows, next(iter(times)), place, quality, list(place))]
    notes.append(f"{len(times)} columns of time, each for the readings beside it")
    groups = [_group([r for r in rows if any(r[1][t] for t in at) or any(r[1][place[n]] for n in names)], at, place,
                     quality, names) for at, names in times.items()]
    return _merged([g for g in groups if g.lines] or groups)


def _group(rows, times, place, quality, names):
    return Group([line for line, _ in rows], [" ".join(cells[t] for t in times) for _, cells in rows],
                 {n: [cells[place[n]] for _, cells in rows] for n in names},
                 {n: [cells[quality[n]] for _, cells in rows] for n in names if quality[n] is not None})


def _column_of_tags(what, names, rows):
    """Index of the column in which the channels' names stand; None where there is none."""
    wanted = {c.column for c in what.channels.values()}
    seen = [set() for _ in names]
    for _, cells in rows:
        for k, cell in enumerate(cells):
            if cell in wanted:
                seen[k].add(cell)
    best = max(range(len(names)), key=lambda k: len(seen[k]))
    return best if seen[best] else None


def _like_tags(what, names, rows):
    """Where a column of a log with a row a reading has the channels' names in other letters or with more around them,
    words that say so; None elsewhere."""
    wanted = {c.column.lower() for c in what.channels.values()}
    for k, name in enumerate(names):
        like = sorted({cells[k] for _, cells in rows[:ROWS_LOOKED_AT]
                       if any(w in cells[k].lower() for w in wanted) and not _is_number(cells[k])})
        if like:
            return f"the tags as '{name}' has them, a row a reading: {some_names(like)}"
    return None


def _long(header, rows, tags, notes):
    """A row a reading: its tag, its time, its value."""
    what, found = header.what, header.found
    before = len(found.all)
    times, value = header.time(), _column_of_values(header, rows, tags)
    if len(found.all) > before or value is None:
        return None
    units = [k for k in {*range(len(header.names))} - {tags, value, *times} if OF_UNITS.search(header.names[k])]
    by_tag = {}
    for row in rows:
        by_tag.setdefault(row[1][tags], []).append(row)
    groups = []
    for name, channel in what.channels.items():
        if channel.column not in by_tag:
            found.add(what.path, channel.line, f"channels.{name}.column",
                      f"'{channel.column}' is neither a column of {header.path.name} nor in its '{header.names[tags]}'",
                      f"there are {some_names(by_tag)}")
            continue
        header.check_units(name, [(i, unit_said(cells[k])) for i, cells in by_tag[channel.column] for k in units])
        groups.append(_group(by_tag[channel.column], times, {name: value}, {name: header.quality(name)}, [name]))
        _find_machines(header, by_tag[channel.column], times, {tags, value, *times}, True)
        if len(found.all) > before:
            break
    if len(found.all) > before:
        return None
    notes.append(f"a row a reading: '{header.names[tags]}' says whose, '{header.names[value]}' what")
    return _merged(groups)


def _find_machines(header, rows, times, used, numbers):
    """Finding about a column that names several machines, where they take turns from time to time and each has its
    share of the rows; how good readings are does not. `numbers`: whether numbers name them in any column."""
    rows = sorted(rows, key=lambda row: [row[1][t] for t in times])
    qualities = {channel.quality for channel in header.what.channels.values()}
    for k in {*range(len(header.names))} - used:
        if header.names[k] in qualities or QUALITY.search(header.names[k]):
            continue
        cells = [row[1][k] for row in rows]
        may_be_numbers = numbers or OF_MACHINE.search(header.names[k])
        count = Counter(cells).most_common(FEW_WORDS + 1)
        if not 1 < len(count) <= FEW_WORDS or \
                any(UNSOUND.search(c) or _is_number(c) and not may_be_numbers for c, _ in count):
            continue
        turns, second = sum(a != b for a, b in zip(cells, cells[1:])), count[1][1]
        if second >= SHARE * len(rows) and turns >= second:
            header.found.add(header.path, rows[0][0], header.names[k], f"says {some_names(sorted(c for c, _ in count))}"
                             f" in turn{', of one tag' if numbers else ''}: several machines in one log?",
                             "one machine's rows: filter the log by that column first")
            return


def _column_of_values(header, rows, tags):
    """Index of file.value, else of the one column whose every cell is a number, as far as there is a reading."""
    what, names = header.what, header.names
    if what.file.value is not None:
        return header.place(what.file.value, "file.value", what.time.line)
    qualities = {c.quality for c in what.channels.values()}
    others = [k for k, n in enumerate(names) if k != tags and n not in what.time.columns and n not in qualities]
    few = rows[:ROWS_LOOKED_AT]
    numbers = [k for k in others if any(_is_number(cells[k]) for _, cells in few)]
    named = [k for k in numbers if names[k].lower() == "value"]
    if len(named or numbers) == 1:
        return (named or numbers)[0]
    header.found.add(what.path, what.time.line, "file.value",
                     f"missing: {header.path.name} has a row a reading, and {len(numbers)} columns of numbers",
                     f"the column of the values, one of {some_names([names[k] for k in numbers or others])}")
    return None


def _is_number(cell):
    return decimal_number(cell, find_decimal([cell])[0]) is not None


def _merged(groups):
    """Groups with the same stamps in the same order become one."""
    out = []
    for g in groups:
        same = next((k for k, o in enumerate(out) if o.stamps == g.stamps), None)
        if same is None:
            out.append(g)
        else:
            o = out[same]
            out[same] = Group(o.lines, o.stamps, {**o.cells, **g.cells}, {**o.quality, **g.quality})
    return out


def unnamed_qualities(what, names, rows, notes):
    """Warns of columns that say what readings are worth, and that the map does not name."""
    used = {*what.time.columns, *(c.column for c in what.channels.values()),
            *(c.quality for c in what.channels.values()), *(c.time for c in what.channels.values())}
    channels = tuple(c.column for c in what.channels.values())
    doubtful = {}
    for k, name in enumerate(names):
        cells = [cells[k] for _, cells in rows]
        words = set(cells)
        beside = {*names[max(k - 1, 0):k + 2]}
        says = GOOD_CODE in words or not any(map(_is_number, words))
        spelt = any(c.isalpha() for c in "".join(words)) or GOOD_CODE in words
        most = FEW_WORDS if name.startswith(channels) or says and names[max(k - 1, 0)] in channels else \
            FEWER_WORDS if says and spelt and beside & {*what.time.columns} else 0
        if name in used or not (QUALITY.search(name) or len(words) <= most and len(cells) > FEW_WORDS):
            continue
        bad = sorted({c for c in words if UNSOUND.search(c)} or (words if len(words) > 1 else ()))
        if bad:
            doubtful[name] = (bad, sum(c in bad for c in cells))
    if doubtful:
        texts = sorted({t for bad, _ in doubtful.values() for t in bad})
        notes.append(f"warning: {some_names(doubtful)} in {sum(n for _, n in doubtful.values())} cells "
                     f"{'say' if len(doubtful) > 1 else 'says'} "
                     f"{some_names([t or 'nothing' for t in texts], 4)}, and "
                     "these readings are taken all the same; channels.NAME.quality names the column that says "
                     "whether a reading is good")
