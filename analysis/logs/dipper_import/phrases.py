"""Words about rows of a log."""
LONGEST_SHOWN = 40   # characters of a cell that is quoted


def some_rows(lines, what="row", most=5):
    """How many, and which: "7 rows (lines 3, 4, 5, 9, 12 and 2 more)"."""
    lines = sorted(int(i) for i in lines)
    more = f" and {len(lines) - most} more" if len(lines) > most else ""
    s = "s" if len(lines) > 1 else ""
    return f"{len(lines)} {what}{s} (line{s} {', '.join(map(str, lines[:most]))}{more})"


def some_names(names, most=12):
    """Names in quotes, the first ones of many."""
    names = [n[:LONGEST_SHOWN] for n in names if n]
    return ", ".join(f"'{n}'" for n in names[:most]) + (f" and {len(names) - most} more" if len(names) > most else "")


def longest_of(times):
    """Behind what is said of the longest of several stretches."""
    return f"; {times} times, this one the longest" if times > 1 else ""


def leave_out(name, by_number=True):
    """How a channel's readings that are none are left out; `by_number`: a number stands for them."""
    listed = ", list the number under file.missing" if by_number else ""
    return (f"Leave such cells empty{listed}, or name the column that says which readings are good "
            f"(channels.{name}.quality)")
