"""dipper survey CLOUD --case CASE [--origin E,N,Z] [--azimuth DEG] [--rear X] [--out FILE]

Exit status: 0 done; 2 bad input, nothing written; 4 interrupted.
"""
import argparse
import math
import os
import sys
from pathlib import Path

from dipper_run.exit_status import end_interrupted, exit_status

if __name__ == "__main__":  # the imports below take a second
    end_interrupted("survey")

from dipper_run.findings import BadInput
from dipper_run.out_folder import check_not_over
from dipper_run.program import check_json
from dipper_run.text_file import number

from .report import plot, to_csv, to_stl, words
from .site import Site
from .surface import Box
from .survey import survey

REPLACED = "toe_x_m, height_m, crest_depth_m, face_angle_deg"  # coupler/case/pile_profile.hpp
MARGIN_m = 1.0  # of the rear wall to the domain's end


def arguments(given):
    parser = argparse.ArgumentParser(prog="dipper survey", description=__doc__.split("\n")[0])
    parser.add_argument("cloud", metavar="CLOUD", type=Path)  # what they are: coupler/cli/python_command.cpp
    parser.add_argument("--case", metavar="DIR", type=Path, required=True)
    parser.add_argument("--origin", metavar="E,N,Z")
    parser.add_argument("--azimuth", metavar="DEG")
    parser.add_argument("--rear", metavar="X")
    parser.add_argument("--out", metavar="FILE", type=Path)
    return parser.parse_args(given)


def read_case(case):
    """The values of a case whose pile.profile may still be to be made; BadInput of any other fault."""
    answer = check_json(case)
    faults = [f for f in answer["findings"] if not f["key"].startswith("pile")]
    if faults or "values" not in answer:
        raise BadInput([f"{f['file']}:{f['line']}: {f['key']}: {f['message']}" for f in faults or answer["findings"]])
    return answer["values"]


def numbers_of(text, n, option, right):
    read = [number(t) for t in text.split(",")]
    if len(read) != n or None in read:
        raise BadInput([f"{option}: is '{text}'; {right}"])
    return read


def site_of(values, args):
    origin, azimuth = values["site.origin_m"], values["site.azimuth_deg"]
    if args.origin is not None:
        origin = numbers_of(args.origin, 3, "--origin", "easting, northing and elevation in m: "
                            "--origin 512345.2,7443210.9,182.4")
    if args.azimuth is not None:
        azimuth, = numbers_of(args.azimuth, 1, "--azimuth", "degrees clockwise from grid north")
        if abs(azimuth) > 360:
            raise BadInput([f"--azimuth: is {azimuth:g}; degrees clockwise from grid north, -360 to 360"])
    return Site(tuple(origin), azimuth)


def box_of(values, rear):
    """The part of W where the case's bench is to be: from the shovel to the rear wall."""
    x0 = values["machine.base_position_m" if "machine.base_position_m" in values else "domain.min_m"][0]
    most = values["domain.max_m"][0] - MARGIN_m
    x1 = most
    if "pile.toe_x_m" in values:
        slope = values["pile.height_m"] / math.tan(math.radians(values["pile.face_angle_deg"]))
        x1 = min(most, values["pile.toe_x_m"] + slope + values["pile.crest_depth_m"])
    if rear is not None:
        x1, = numbers_of(rear, 1, "--rear", "x of the rear wall in W, m")
        if not x0 + 1 < x1 <= most:
            raise BadInput([f"--rear: is {x1:g}; between {x0 + 1:g} and {most:g} m, within the case's domain"])
    return Box(x0, x1, values["pile.width_m"] / 2, values["domain.max_m"][2])


def main(given=None):
    args = arguments(given)
    return exit_status("survey", lambda: run(args))


def run(args):
    out = args.out or args.case / "face.stl"
    if out.suffix.lower() not in (".stl", ".csv"):
        raise BadInput([f"--out: is '{out}'; a surface, FILE.stl, or a section, FILE.csv"])
    outputs = [out, *map(out.with_suffix, (".png", ".txt"))]
    check_not_over({"the scan": args.cloud}, outputs)
    values = read_case(args.case)
    check_not_over({f"the case's {key}": args.case / file for key, file in values.items()
                    if key != "pile.profile" and isinstance(file, str)}, outputs)
    made = survey(args.cloud, site_of(values, args), box_of(values, args.rear), args.rear is not None)
    said = words(made, args.cloud)
    print("\n".join(said), flush=True)
    write(made, said, args.cloud.name, out)
    print("\n".join(next_step(args.case, out, values)))


def write(made, said, name, out):
    """The picture first: it is to be looked at before anything is run."""
    picture = out.with_suffix(".png")
    plot(made, name, picture)
    print(f"survey: {picture}")
    draft = out.with_name(f".{out.name}.part")
    draft.write_bytes(to_stl(made.surface) if out.suffix.lower() == ".stl" else to_csv(made.surface.section()).encode())
    os.replace(draft, out)
    print(f"survey: {out}")
    out.with_suffix(".txt").write_text("\n".join(said) + "\n")
    print(f"survey: {out.with_suffix('.txt')}")


def next_step(case, out, values):
    """What the case makes of the file: what `dipper check` says where it names it, else what to write."""
    profile = values.get("pile.profile")
    if profile and (case / profile).resolve() == out.resolve():
        answer = check_json(case)
        if answer["sound"]:
            return [f"check: {answer['case']} is sound with it: about {answer['size']['rocks']:.0f} rocks; look at "
                    f"{out.stem}.png, and at dipper preview {case}"]
        errors = [f"{f['key']}: {f['message']}" for f in answer["findings"]]
        return ["check: the case has these errors with it:", *errors]
    path = os.path.relpath(out, case)
    return [f"in {case / 'case.yaml'}, in place of {REPLACED}:",
            f"pile: {{profile: {path}, width_m: {values['pile.width_m']:g}, settle_s: {values['pile.settle_s']:g}, "
            f"relax_s: {values['pile.relax_s']:g}}}"]


if __name__ == "__main__":
    sys.exit(main())
