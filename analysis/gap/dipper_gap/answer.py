"""The files of an answer: gap.json, report.html and, where effects were found, the case with them."""
import hashlib
import os

from dipper_run.findings import BadInput
from dipper_run.out_folder import check_not_over

from .decision.law_effect import effect_text
from .decision.patch import is_patched_case, remove_patched_case, write_patched_case
from .gap_json import as_json, write_json
from .report import write_report


def check_answer_folder(case, folder):
    """BadInput where an answer in `folder` would overwrite the case, or one that no earlier answer has left there."""
    there = folder / "case"
    check_not_over({"the case": case / "case.yaml"}, [there / "case.yaml"])
    if os.path.lexists(there) and not is_patched_case(there):
        raise BadInput([f"--out: {there} is there, and no earlier answer's; choose another --out"])


def write_answer(out, catalogue, simulator, measured, folder, reference=None):
    """Writes the outcome `out` into `folder`, in place of an earlier one's; the files. `measured`, `reference`: the
    mine's folders. Throws BadInput."""
    check_answer_folder(simulator.case, folder)
    folder.mkdir(parents=True, exist_ok=True)
    remove_patched_case(folder / "case")
    files = [folder / "report.html", folder / "gap.json"]
    hashes = {"case": simulator.case_hash(), "measured": _measured_hash(measured)}
    if reference:
        hashes["reference"] = _measured_hash(reference)
    answer = as_json(out, catalogue, hashes)
    write_json(answer, folder / "gap.json")
    if out.effects:
        write_patched_case(simulator.case, out.effects, folder / "case")
        files.append(folder / "case")
    elif out.added:
        write_patched_case(simulator.case, {out.added.name: 1.0}, folder / "case",
                           {out.added.name: effect_text(out.added)})
        files.append(folder / "case")
    write_report(out, answer, catalogue, folder / "report.html", simulator.case.resolve().name)
    return files


def _measured_hash(folder):
    digest = hashlib.sha256()
    for file in sorted(folder.iterdir()):
        if file.is_file():
            digest.update(file.name.encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()
