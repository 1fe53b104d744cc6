"""dipper study STUDY.yaml [--out DIR]

Exit status: 0 done; 2 bad input, nothing started; 3 a run failed (the others are made and reported); 4 interrupted: the
same command continues from the finished runs.
"""
import argparse
import json
import os
import signal
import sys
from pathlib import Path

import dipper_run
from dipper_run.exit_status import of_fault
from dipper_run.findings import BadInput
from dipper_run.out_folder import check_writable, make_cache, out_folder
from dipper_run.page_data import finite
from dipper_run.program import ProgramFailed, program
from dipper_run.run_cache import cache_folder

from .executor import executor_of
from .plan import Planner
from .progress import Progress
from .report import write_page
from .results import row_of, warned, warnings_of, write_csv, write_hdf5
from .slurm import Detached
from .statement import statement
from .study_file import read_study


def arguments(words):
    parser = argparse.ArgumentParser(prog="dipper study", description=__doc__.split("\n")[0])
    parser.add_argument("study", metavar="STUDY", type=Path)  # what they are: coupler/cli/python_command.cpp
    parser.add_argument("--out", metavar="DIR", type=Path)
    parser.add_argument("--detach", action="store_true")
    parser.add_argument("--cancel", action="store_true")
    return parser.parse_args(words)


def say(text):
    print(text, flush=True)


class Session:
    """A study under way: makes runs, and writes what is known of all runs asked for so far."""

    def __init__(self, study, planner, executor, out):
        self.study, self.planner, self.executor, self.out = study, planner, executor, out
        self.runs, self.failed = {}, {}  # {(point, seed): PlannedRun}, {folder: what was said}

    def make(self, runs):
        """Makes what is not kept of these runs, after telling what that takes; rows of all of them.

        Points that are the same case share a run: it is made once, and each has a row of it.
        """
        self.runs.update(((r.point, r.seed), r) for r in runs)
        own = list({r.job.folder: r for r in runs}.values())
        todo = [r for r in own if not self.executor.kept(r.job.folder, r.job.drop)]
        say(statement(self.study, self.planner, self.executor, runs, len(own), todo))
        if todo:
            jobs = [r.job for r in todo]
            progress = Progress(len(own), jobs, self.planner.seconds(todo[0]), self.executor.at_once)
            try:
                failures = self.executor.make(jobs, progress)
            finally:
                progress.close()
            self.failed.update((job.folder, str(error)) for job, error in failures)
        return [self._row(r) for r in runs]

    def _row(self, run):
        facts = self.executor.kept(run.job.folder, run.job.drop)
        return row_of(run, self.study.names, facts, self.failed.get(run.job.folder))

    def write(self, answer=None):
        """study.csv, study.h5, report.html, links to the runs and the answer, in place of earlier ones; returns the
        rows."""
        self.out.mkdir(parents=True, exist_ok=True)
        rows, names = [self._row(r) for r in self.runs.values()], self.study.names
        write_csv(rows, names, self.out / "study.csv")
        write_hdf5(rows, names, self.out / "study.h5", self.study.text)
        _link_all(self.out / "runs", {run.name: run.folder for run, row in zip(self.runs.values(), rows)
                                      if row["status"] in ("complete", "unfinished")})
        if answer:
            (self.out / "optimum.json").write_text(json.dumps(finite(answer), indent=1) + "\n")
        else:
            (self.out / "optimum.json").unlink(missing_ok=True)
        title = next((self.planner.checked(r.point)["values"].get("title") for r in self.runs.values()), None)
        write_page(self.study, rows, self.failures(), answer, self.out / "report.html", self.warnings(rows), title)
        return rows

    def failures(self):
        """What was said of each run that failed."""
        return [f"{r}: {self.failed[r.job.folder]}" for r in self.runs.values() if r.job.folder in self.failed]

    def warnings(self, rows):
        """What the runs warn of, each once with how many say so; first that some have ended within a pass."""
        made = [(run, row) for run, row in zip(self.runs.values(), rows) if "warnings" in row]
        said = warned(warnings_of(dipper_run.read(run.folder)) for run, row in made if row["warnings"])
        unfinished = sum(row["status"] == "unfinished" for _, row in made)
        first = [f"{unfinished} of {len(made)} runs are unfinished: they end before the load is dumped, or have no "
                 "pass; they are left out of every figure (a later end_s lets them go on)"] if unfinished else []
        return first + [f"in {n} of {len(made)} runs: {text}" for text, n in said]


def _link_all(folder, runs):
    """Links to the runs {name: folder}, and no others: an earlier study's may be there."""
    folder.mkdir(exist_ok=True)
    for link in folder.iterdir():
        if link.is_symlink() and runs.get(link.name) != Path(os.readlink(link)):
            link.unlink()
    for name, to in runs.items():
        if not (folder / name).is_symlink():
            (folder / name).symlink_to(to)


def main(words=None):
    args = arguments(words)
    out = out_folder(args.out, f"study-{args.study.stem}")
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # also where the shell has them ignored
        signal.signal(number, signal.default_int_handler)
    try:
        study = read_study(args.study)
        planner = Planner(study, program(), cache_folder("study"))
        points = first_points(study)
        planner.check(points)
        executor = executor_of(study, program(), out)
        if (args.detach or args.cancel) and study.executor != "slurm":
            raise BadInput([f"{study.file}: --detach and --cancel are for executor: slurm"])
        check_writable(out)
        make_cache(cache_folder("study"))
    except BadInput as e:
        print(e.counted(), file=sys.stderr)
        return 2
    except ProgramFailed as e:
        print(f"study: {e}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return interrupted()
    try:
        return conduct(Session(study, planner, executor, out), points, args)
    except OSError as e:  # a full disk, a file in the way, nobody who reads: the runs that are made are kept
        return of_fault(e)


def interrupted():
    print("study: interrupted; the same command continues from the finished runs", file=sys.stderr)
    return 4


def first_points(study):
    """What `check` is asked before a study starts: its points, or the ends of an optimisation's ranges."""
    return [study.point_at(c) for c in corners(study.optimise)] if study.optimise else study.points()


def corners(optimise):
    """The ends of every range, the others in the middle."""
    middle = [(r.low + r.high) / 2 for r in optimise.ranges]
    found = [middle]
    for k, r in enumerate(optimise.ranges):
        found += [[*middle[:k], end, *middle[k + 1:]] for end in (r.low, r.high)]
    return found


def conduct(session, points, args):
    try:
        if args.cancel:
            say(f"study: {session.executor.cancel()} jobs cancelled")
            return 0
        session.executor.detach = args.detach
        rows = session.write(made(session, points))
    except Detached as e:
        say(f"study: {e}; the same command without --detach watches and collects")
        return 0
    except KeyboardInterrupt:
        if session.runs:
            session.write()
        return interrupted()
    except ProgramFailed as e:
        print(f"study: {e}", file=sys.stderr)
        return 3
    except BadInput as e:
        print("\n".join(e.findings), file=sys.stderr)
        return 2
    say(f"study: {session.out / 'report.html'}, {session.out / 'study.csv'}, {session.out / 'study.h5'}")
    for text in session.warnings(rows):
        say(f"study: warning: {text}")
    for text in session.failures():
        print(f"study: {text}", file=sys.stderr)
    return 3 if session.failed else 0


def made(session, points):
    """Makes the runs; the answer of an optimisation, else None. What was run before a failure is written."""
    if not session.study.optimise:
        session.make(session.planner.runs(points, session.study.seeds))
        return None
    from .optimise import search  # scikit-learn takes a second to start, which other studies need not wait
    try:
        return search(session, say)
    except ProgramFailed:
        if session.runs:
            session.write()
        raise


if __name__ == "__main__":
    sys.exit(main())
