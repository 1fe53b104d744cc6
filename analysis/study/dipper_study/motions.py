"""`plan.KEY` in a study: the case's motion, planned anew with another number in its plan.yaml (docs/motion.md)."""
import os
import subprocess
from pathlib import Path

import yaml

from dipper_run.file_hash import sha256_of
from dipper_run.findings import BadInput, Findings
from dipper_run.program import ProgramFailed, check_json
from dipper_run.run_cache import entry_of
from dipper_run.text_file import read_yaml

from .study_file import Setting

PREFIX = "plan."
FACE_FILES = "face"  # names a file beside the plan, or the pile


class Motions:
    """Motions of the case's plan with other numbers, each made once by `dipper motion`, in a folder named by the hash
    of the plan with its faces, the case with all its files, and the program's sources.

    They are planned for the case as it is: what else a point sets (a rake, a distance) is not what the operator knew.
    """

    def __init__(self, case, program, folder):
        self.case, self.program, self.folder = Path(case).resolve(), program, Path(folder)
        self._checked = None  # of the case, by `dipper check`

    def resolved(self, study_file, settings):
        """The settings, with those of the plan replaced by the one of the motion they make, and, for an operator who
        plans, the one of the plan. Raises BadInput."""
        planned = [s for s in settings if s.key.startswith(PREFIX)]
        if not planned:
            return tuple(settings)
        file = self._file(settings)
        plan = self._plan(file, study_file, planned[0])
        for s in planned:
            number, holder, key = self._find(plan, file, study_file, s)
            holder[key] = number
        folder = self._made(study_file, planned, plan)
        made = {"machine.motion": folder / "motion.csv"}
        if self._operator_plans(settings):
            made["machine.plan"] = folder / "plan.yaml"
        return tuple(s for s in settings if s not in planned) + tuple(
            Setting(key, str(of), planned[0].line) for key, of in made.items())

    def own(self, key, settings=()):
        """The number that the case's plan has at `plan.KEY`, with these settings of every run; None where there is
        none."""
        try:
            holder, last = _walk(_read_plan(self._file(settings)), key)
            return float(holder[last])
        except (KeyError, IndexError, TypeError, ValueError):
            return None

    def _case(self):
        """What `dipper check` says of the case as it is. Raises BadInput."""
        if self._checked is None:
            checked = check_json(self.case, of=self.program)
            if checked["findings"]:
                raise BadInput(f"{f['file']}:{f['line']}: {f['key']}: {f['message']}" for f in checked["findings"])
            self._checked = checked
        return self._checked

    def _says(self, key, settings):
        """The text of a key of the case, with these settings."""
        return next((s.text for s in reversed(settings) if s.key == key), self._case()["values"].get(key))

    def _operator_plans(self, settings):
        return self._says("machine.operator", settings) == "plan"

    def _file(self, settings):
        """The plan that a run goes by: an operator's own, else that of the case's motion."""
        return self.case / (self._operator_plans(settings) and self._says("machine.plan", settings) or "plan.yaml")

    def _plan(self, file, study_file, setting):
        if not file.is_file():
            raise BadInput([f"{study_file}:{setting.line}: {setting.key}: {file.parent} has no {file.name}; "
                            "a case whose motion is planned (docs/motion.md)"])
        plan = _read_plan(file)
        for cut in _cuts(plan):
            face = cut.get(FACE_FILES)
            if isinstance(face, str) and face != "pile":
                cut[FACE_FILES] = os.path.join(file.parent, face)
        return plan

    def _find(self, plan, file, study_file, setting):
        where = f"{study_file}:{setting.line}: {setting.key}"
        try:
            holder, last = _walk(plan, setting.key)
            found = holder[last]
        except (KeyError, IndexError, TypeError, ValueError):
            raise BadInput([f"{where}: {file} has no such key; "
                            "plan.cycle_s, plan.passes.0.cut.depth_m or the like"]) from None
        if isinstance(found, bool) or not isinstance(found, (int, float)):
            raise BadInput([f"{where}: is no number in {file}; a key that is one"])
        try:
            return float(setting.text), holder, last
        except ValueError:
            raise BadInput([f"{where}: is {setting.text}; a number"]) from None

    def _made(self, study_file, planned, plan):
        """The folder with this plan and its motion."""
        text = yaml.safe_dump(plan, sort_keys=False)
        faces = [Path(face) for cut in _cuts(plan) if isinstance(face := cut.get(FACE_FILES), str)]
        folder = entry_of(self.folder, self._case(), text, *(sha256_of(f) for f in faces if f.is_file()))
        motion = folder / "motion.csv"
        if motion.exists():
            return folder
        folder.mkdir(parents=True, exist_ok=True)
        (folder / "plan.yaml").write_text(text)
        words = ["motion", self.case, "--plan", folder / "plan.yaml", "--out", motion, "--page", folder / "motion.html"]
        try:
            made = subprocess.run([self.program, *map(str, words)], capture_output=True, text=True)
        except OSError as e:
            raise ProgramFailed(f"{self.program}: {e.strerror}; build it, or set DIPPER to it") from e
        if made.returncode:
            said = ", ".join(map(str, planned))
            raise BadInput([f"{study_file}:{planned[0].line}: {said}: {_reason(made)}"])
        return folder


def _reason(made):
    """The first line that says why `dipper motion` refuses: what `dipper check` finds is on its standard output."""
    lines = [*made.stderr.splitlines(), *made.stdout.splitlines()]
    return next((line for line in lines if line.strip() and not line.startswith("warning: ")),
                f"exit status {made.returncode}")


def _read_plan(file):
    """The map in a plan.yaml. Raises BadInput."""
    found = Findings()
    read_yaml(file, found, "a plan; docs/motion.md has its keys")
    found.raise_if_any()
    try:
        return yaml.safe_load(file.read_text())
    except (yaml.YAMLError, ValueError) as e:  # a key that is a list, a date that is none
        raise BadInput([f"{file}: YAML: {str(e).splitlines()[0]}; a plan; docs/motion.md has its keys"]) from e


def _cuts(plan):
    """The maps `cut` of a plan's passes; what else stands there is for `dipper motion` to refuse."""
    passes = plan.get("passes")
    cuts = [one.get("cut") for one in passes if isinstance(one, dict)] if isinstance(passes, list) else []
    return [cut for cut in cuts if isinstance(cut, dict)]


def _walk(plan, key):
    """(map or list, key or index) that `plan.a.0.b` names in a plan."""
    *way, last = key[len(PREFIX):].split(".")
    for part in way:
        plan = plan[int(part)] if isinstance(plan, list) else plan[part]
    return plan, int(last) if isinstance(plan, list) else last
