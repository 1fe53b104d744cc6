"""The files of an answer: gap.json, report.html and, where effects were found, the case with them."""
import hashlib

from .decision.law_effect import effect_text
from .decision.patch import write_patched_case
from .gap_json import as_json, write_json
from .report import write_report


def write_answer(out, catalogue, simulator, measured, folder, reference=None):
    """Writes the outcome `out` into `folder`, making it; the files. `measured`, `reference`: the mine's folders."""
    folder.mkdir(parents=True, exist_ok=True)
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
