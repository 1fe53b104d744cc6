"""The case with the named effects added: a folder that `dipper run` takes as it is."""
import json
import os
import re
import shutil
from pathlib import Path

import yaml

from dipper_run.findings import BadInput

PLAIN = re.compile(r"[\w./-]+")  # of a path that YAML takes without quotes
MARK = "# added by dipper gap"


def overlay(effects):
    """{case key: value}; each is a `--set KEY=VALUE` of `dipper run`."""
    return {f"effects.{name}": float(f"{strength:.6g}") for name, strength in effects.items()}


def write_patched_case(case, effects, out, files=None):
    """Writes out/case.yaml: the case's own text, its paths seen from `out`, and the effects at its end.

    Those of the effects that are the case's own come along, and `files` {effect: text} of those that are in no file.
    """
    case, out = Path(case), Path(out)
    text = (case / "case.yaml").read_text()
    if effects and (yaml.safe_load(text) or {}).get("effects"):
        raise BadInput([f"{case / 'case.yaml'}: effects: the case has some already; "
                        "dipper gap needs a case without effects"])
    for start, end, value in reversed(_paths(text, case)):
        path = os.path.relpath(os.path.realpath(case / value), os.path.realpath(out))
        text = text[:start] + (path if PLAIN.fullmatch(path) else json.dumps(path, ensure_ascii=False)) + text[end:]
    if effects:
        text = _without_effects(text).rstrip("\n") + f"\n\neffects:                     {MARK}\n"
        text += "".join(f"  {name}: {strength:.6g}\n" for name, strength in effects.items())
    out.mkdir(parents=True, exist_ok=True)
    (out / "case.yaml").write_text(text)
    for own in (case / "effects" / f"{name}.yaml" for name in effects):
        if own.exists():
            (out / "effects").mkdir(exist_ok=True)
            shutil.copyfile(own, out / "effects" / own.name)
    for name, effect_text in (files or {}).items():
        (out / "effects").mkdir(exist_ok=True)
        (out / "effects" / f"{name}.yaml").write_text(effect_text)
    return out


def is_patched_case(folder):
    """Whether `write_patched_case` has written it, with effects."""
    file = folder / "case.yaml"
    return file.is_file() and not folder.is_symlink() and MARK in file.read_text(errors="replace")


def remove_patched_case(folder):
    """Removes what `write_patched_case` has written; what else lies in the folder stays."""
    if is_patched_case(folder):
        (folder / "case.yaml").unlink()
        shutil.rmtree(folder / "effects", ignore_errors=True)
        if not any(folder.iterdir()):
            folder.rmdir()


def _without_effects(text):
    """The text without an empty map of effects: a key may be given once."""
    root = yaml.compose(text)
    spans = [(key.start_mark.index, value.end_mark.index) for key, value in root.value if key.value == "effects"]
    for start, end in spans:
        text = text[:start] + text[end:]
    return text


def _paths(text, case):
    """(start, end, value) of every plain scalar that is a path seen from the case folder."""
    found = []

    def walk(node):
        if isinstance(node, yaml.MappingNode):
            for _, value in node.value:
                walk(value)
        elif isinstance(node, yaml.SequenceNode):
            for value in node.value:
                walk(value)
        elif ("/" in node.value or "." in node.value) and (case / node.value).exists():
            found.append((node.start_mark.index, node.end_mark.index, node.value))

    walk(yaml.compose(text))
    return sorted(found)
