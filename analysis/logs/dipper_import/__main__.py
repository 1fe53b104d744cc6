"""dipper import LOG --map MAP.yaml [--out DIR] [--dry]

Exit status: 0 done; 2 bad input, nothing written; 4 interrupted.
"""
import argparse
import shutil
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

from dipper_run.exit_status import end_interrupted, exit_status

if __name__ == "__main__":  # the imports below take a second
    end_interrupted("import")

from dipper_gap.readings.measured import read_measured, write_measured
from dipper_run.findings import BadInput, Findings
from dipper_run.out_folder import check_not_over, check_writable

from .build import build, motion_text
from .clock import order_rows
from .earlier import copy_faces, with_earlier
from .import_map import read_map
from .log_file import read_log
from .report import plot, words


WRITTEN = ("motion.csv", "import.png", "import.txt", "measured/channels.yaml", "measured/passes.csv",
           "measured/signals.csv")


def arguments(given):
    parser = argparse.ArgumentParser(prog="dipper import", description=__doc__.split("\n")[0])
    parser.add_argument("log", metavar="LOG", type=Path)  # what they are: coupler/cli/python_command.cpp
    parser.add_argument("--map", metavar="FILE", type=Path, required=True)
    parser.add_argument("--out", metavar="DIR", type=Path)
    parser.add_argument("--dry", action="store_true")
    return parser.parse_args(given)


def read(log, map_file):
    """(Imported, ImportMap, report lines); throws BadInput."""
    what = read_map(map_file)
    found, notes = Findings(), []
    raw = read_log(log, what, found, notes)
    _stop_if_any(found, notes)
    rows = order_rows(raw, what, log, found, notes)
    _stop_if_any(found, notes)
    made = build(rows, what, log, found, notes)
    _stop_if_any(found, notes)
    return made, what, words(made, what, log, notes)


def _stop_if_any(found, notes):
    """Says the warnings before it throws: one of them may be the cause of a fault."""
    for note in notes if found.all else ():
        if note.startswith("warning: "):
            print(note, file=sys.stderr)
    found.raise_if_any()


def write(made, what, said, log, out, dry):
    """Writes into a folder beside `out`, or in it, first: a fault of the measured folder leaves nothing behind."""
    out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".import-", dir=out if out.is_dir() else out.parent) as folder:
        folder = Path(folder)
        if made.measured:
            write_measured(made.measured, folder / "measured")
            copy_faces(out / "measured", folder / "measured")
            try:
                read_measured(folder / "measured")
            except BadInput as e:
                raise BadInput([f.replace(str(folder), str(out)) for f in e.findings]) from e
        plot(made, what, log.name, folder / "import.png")
        if dry:
            shutil.rmtree(folder / "measured", ignore_errors=True)
        else:
            (folder / "motion.csv").write_text(motion_text(made, what, log.name))
            (folder / "import.txt").write_text("\n".join(said) + "\n")
        out.mkdir(exist_ok=True)
        for made_file in sorted(folder.rglob("*")):
            if made_file.is_file():
                target = out / made_file.relative_to(folder)
                target.parent.mkdir(exist_ok=True)
                shutil.copyfile(made_file, target)
                print(f"import: {target}")


def main(given=None):
    args = arguments(given)
    return exit_status("import", lambda: run(args))


def run(args):
    out = args.out or Path(args.log.stem)
    check_not_over({"the log": args.log, "the map": args.map}, [out / name for name in WRITTEN])
    check_writable(out)
    made, what, said = read(args.log, args.map)
    made = replace(made, measured=with_earlier(made.measured, out / "measured", said)) if not args.dry else made
    print("\n".join(said), flush=True)
    write(made, what, said, args.log, out, args.dry)


if __name__ == "__main__":
    sys.exit(main())
