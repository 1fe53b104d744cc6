"""dipper gap CASE --measured FOLDER [--reference FOLDER] [--out DIR]; dipper gap CASE --plan [--measured FOLDER]
[--reference FOLDER]

Exit status: 0 an answer was reached; 2 bad input, nothing started; 3 a run failed; 4 interrupted: the same command
continues from the finished runs.
"""
import argparse
import signal
import sys
from dataclasses import replace
from pathlib import Path

from dipper_run import run_cache
from dipper_run.findings import BadInput, Findings
from dipper_run.out_folder import check_writable, make_cache, out_folder
from dipper_run.program import ProgramFailed, check_json, program

from .answer import check_answer_folder, write_answer
from .forecast import as_lines, forecast, write_forecast
from .readings.before import check_channels, check_reference
from .readings.channels import ASSUMED, FACE, FORCES, MASS, MOTION, read_channels
from .readings.fidelity import read_fidelity
from .readings.machine_warnings import machine_warnings, read_machine
from .readings.measured import read_measured
from .readings.motion import compare_motion, read_motion
from .readings.passes import NEED_PASSES
from .simulation.corrected import Corrected
from .simulation.effects import read_catalogue
from .simulation.simulator import JOBS, DipperSimulator, RunFailed, check
from .workflow import analyse


def arguments(words):
    parser = argparse.ArgumentParser(prog="dipper gap", description=__doc__.split("\n")[0])
    parser.add_argument("case", metavar="CASE", type=Path)  # what they are: coupler/cli/python_command.cpp
    parser.add_argument("--measured", metavar="DIR", type=Path)
    parser.add_argument("--plan", action="store_true")
    parser.add_argument("--reference", metavar="DIR", type=Path)
    parser.add_argument("--masses-only", action="store_true")
    parser.add_argument("--jobs", metavar="N", type=int, default=JOBS)
    parser.add_argument("--out", metavar="DIR", type=Path)
    return parser.parse_args(words)


def read_values(case):
    """{key: value} of a sound case, with what it includes; throws BadInput where it cannot be analysed."""
    told, file = check_json(case), case / "case.yaml"
    if told["effects"]:
        raise BadInput([f"{file}: effects: the case has some already ({', '.join(told['effects'])}); give the case "
                        "without them"])
    if "machine.motion" not in told["values"]:
        raise BadInput([f"{file}: machine.kind: has no motion of a shovel's drives, whose forces are compared; give a "
                        "case with machine.kind: shovel"])
    if told["values"].get("machine.operator") == "plan":
        raise BadInput([f"{file}: machine.operator: is plan, so each run digs where its operator chooses; give the "
                        "case the measured motion, and motion here"])
    return told["values"]


def usable(catalogue, simulator):
    """The effects this case can take at the strengths to be run, and a line for each that it cannot.

    Effects are checked together, as far as they change other keys; those of a set that fails are checked half by half.
    """
    faults, left_out = {}, []
    for some in _apart(catalogue):
        faults.update(_faults([(n, s) for n, s in some if n not in faults], simulator))
    for name in (n for n in catalogue if n in faults):
        left_out.append(f"effect {name} is left out, as the case cannot take it: {faults[name].splitlines()[0]}")
        say(f"gap: {left_out[-1]}")
    return {n: e for n, e in catalogue.items() if n not in faults}, left_out


def _apart(catalogue):
    """Sets of (effect, strength), all of those to be run, in each of which no two change the same key."""
    out = []
    for name, effect in catalogue.items():
        keys = {key for key, *_ in effect.overlay} | {name}
        for strength in effect.strengths(False):
            free = next((some for some in out if not keys & some[1]), None)
            if free is None:
                out.append(free := ([], set()))
            free[0].append((name, strength))
            free[1].update(keys)
    return [some for some, _ in out]


def _faults(some, simulator):
    """{effect: what `dipper check` has against it} of a set of (effect, strength)."""
    bad = check(simulator.program, simulator.case, some) if some else ""
    if not bad or len(some) == 1:
        return {some[0][0]: bad} if bad else {}
    middle = len(some) // 2
    return {**_faults(some[:middle], simulator), **_faults(some[middle:], simulator)}


def say(text):
    print(text, flush=True)


def main(words=None):
    args = arguments(words)
    bad = check(program(), args.case)
    if bad:
        print(bad, file=sys.stderr)
        return 2
    try:
        values = read_values(args.case)
        catalogue = read_catalogue(args.case)
        measured, before = (None, None) if args.plan else readings(args, values)
        channels, earlier = planned_for(args) if args.plan else ({}, None)
        fidelity = usable_fidelity(args.case, bool(before))
        folder = out_folder(args.out, f"gap-{args.case.resolve().name}")
        check_writable(folder)
        if not args.plan:
            check_answer_folder(args.case, folder)
        make_cache(run_cache.cache_folder("gap"))
    except BadInput as e:
        print(e.counted(), file=sys.stderr)
        return 2
    for number in (signal.SIGINT, signal.SIGTERM):  # also where the shell has them ignored, as after nohup &
        signal.signal(number, signal.default_int_handler)
    first_seed = values["seed"]
    try:
        simulator = DipperSimulator(args.case, catalogue, program(), run_cache.cache_folder("gap"), args.jobs)
        catalogue, left_out = usable(catalogue, simulator)
        if fidelity:
            simulator = Corrected(simulator, fidelity)
            channels = fidelity.compared(channels)
            measured = measured and measured.seen_by(fidelity.compared(measured.channels))
        require_comparable(channels if args.plan else measured.channels, args)
        if args.plan:
            planned = forecast(channels, simulator, catalogue, first_seed, say, earlier)
            folder.mkdir(parents=True, exist_ok=True)
            write_forecast(planned, catalogue, folder / "plan.json")
            say("gap: smallest strength that stands out, and in brackets that is told from every other effect")
            for line in as_lines(planned, catalogue):
                say(line)
            say(f"gap: {folder / 'plan.json'}")
            return 0
        out = analyse(measured, simulator, catalogue, first_seed, say, before)
        out = replace(out, warnings=(*left_out, *out.warnings))
        files = write_answer(out, catalogue, simulator, args.measured, folder, args.reference)
    except KeyboardInterrupt:
        print("gap: interrupted; the same command continues from the finished runs", file=sys.stderr)
        return 4
    except (RunFailed, ProgramFailed) as e:
        print(f"gap: {e}", file=sys.stderr)
        return 3
    except BadInput as e:
        print(f"gap: {e}", file=sys.stderr)
        return 2
    say(f"gap: {', '.join(map(str, files))}")
    return 0


def readings(args, values):
    """The mine's folder, and that of its earlier trucks or None; asks what is doubtful, throws BadInput."""
    if not args.measured:
        raise BadInput(["--measured: not given; a folder with channels.yaml and passes.csv, or --plan for what such "
                        "a folder would show"])
    measured = read_measured(args.measured, NEED_PASSES)
    if not measured.responses() and not args.masses_only:
        raise BadInput([f"{args.measured}: forces: neither hoist_force_kN nor crowd_force_kN is there; "
                        "masses alone are seldom enough to name an effect: give a force, or ask for that with "
                        "--masses-only"])
    machine = read_machine(args.case, values)
    questions = [*measured.questions(), *machine_warnings(measured, machine),
                 *compare_motion(measured, read_motion(args.case, values))]
    before = read_measured(args.reference, NEED_PASSES) if args.reference else None
    if before:
        questions += [f"the reference: {q}" for q in (*before.questions(), *machine_warnings(before, machine))]
        questions += check_reference(measured, before)
    for question in questions:
        say(f"gap: {question}")
    return measured, before


def require_comparable(channels, args):
    """Throws BadInput for channels that leave nothing to compare, or forces without the motion that has the phases."""
    forces = [n for n in FORCES if n in channels]
    folder = args.measured or args.reference
    if not forces and MASS not in channels and FACE not in channels:
        raise BadInput([f"{folder}: channels.yaml: nothing is left to compare; give one of "
                        f"{', '.join((*FORCES, MASS, FACE))}"])
    missing = [n for n in MOTION if n not in channels]
    if forces and missing:
        raise BadInput([f"{folder}: channels.yaml: has {', '.join(forces)} without {', '.join(missing)}, from which "
                        "the phases of a pass are found; declare them"])


def usable_fidelity(case, with_reference):
    """What the case's folder says of the model's errors; None where it says nothing, or a reference takes them out.
    Throws BadInput."""
    fidelity = read_fidelity(case)
    if fidelity and with_reference:
        say(f"gap: {fidelity.file} is not used: what model and mine differ by at all times is in the reference")
        return None
    if fidelity:
        say(f"gap: {fidelity}")
    return fidelity


def planned_for(args):
    """Instruments of the mine to be, of the measured folder or the reference, else assumed ones; the reference or
    None."""
    before = read_measured(args.reference, NEED_PASSES) if args.reference else None
    if args.measured:
        channels, found = read_channels(args.measured / "channels.yaml"), Findings()
        if before:
            check_channels(channels, args.measured, before, found)
            found.raise_if_any()
        return channels, before
    if before:
        return before.channels, before
    say(f"gap: instruments are assumed; those of a folder with a channels.yaml are taken with --measured ({ASSUMED})")
    return read_channels(), None


if __name__ == "__main__":
    sys.exit(main())
