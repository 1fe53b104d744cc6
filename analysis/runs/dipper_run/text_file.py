"""Text and numbers of a user's files, with each fault found at its line."""
import math
import re
from difflib import get_close_matches

import yaml

BOM = b"\xef\xbb\xbf"
UTF_16 = (b"\xff\xfe", b"\xfe\xff")
# As the program reads numbers (common/numbers.hpp): Python's float() takes 1_000 and digits of other scripts, too.
NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
RIGHT = "save it as plain text in UTF-8"


def read_text(file, found):
    """The text of a file, without a byte-order mark; None after a finding."""
    try:
        data = file.read_bytes()
    except OSError as e:
        found.add(file, 0, "file", f"cannot be read: {e.strerror}", "a file that may be read")
        return None
    if data.startswith(UTF_16):
        found.add(file, 1, "encoding", "is UTF-16", RIGHT)
        return None
    if b"\0" in data:
        found.add(file, _line(data, data.index(b"\0")), "encoding", "a zero byte: not text, or UTF-16", RIGHT)
        return None
    data = data[len(BOM):] if data.startswith(BOM) else data
    try:
        return data.decode()
    except UnicodeDecodeError as e:
        found.add(file, _line(data, e.start), "encoding", f"byte 0x{data[e.start]:02X} is not UTF-8", RIGHT)
        return None


def _line(data, at):
    return data.count(b"\n", 0, at) + 1


def read_yaml(file, found, what):
    """The root node of a YAML map; None after a finding, which says that `what` belongs there."""
    text = read_text(file, found)
    if text is None:
        return None
    try:
        root = yaml.compose(text)
    except yaml.YAMLError as e:
        mark = getattr(e, "problem_mark", None)
        found.add(file, mark.line + 1 if mark else 0, "YAML", getattr(e, "problem", None) or e.reason, what)
        return None
    except RecursionError:
        found.add(file, 0, "YAML", "lists within lists without end", what)
        return None
    if not isinstance(root, yaml.MappingNode):
        found.add(file, 1, "YAML", "not a map", what)
        return None
    return root


def said(node):
    """What a YAML node says, in words that fit after `is`."""
    if isinstance(node, yaml.SequenceNode):
        return "a list"
    return "a map" if isinstance(node, yaml.MappingNode) else node.value


def number(text):
    """The finite number a text says; None when it says none."""
    if not isinstance(text, str) or not NUMBER.fullmatch(text.strip()):
        return None
    value = float(text)
    return value if math.isfinite(value) else None


def nearest(word, words):
    """The one of `words` that is most like `word`, or None."""
    lower = {w.lower(): w for w in words}
    found = get_close_matches(word.lower(), lower, 1, 0.5)
    return lower[found[0]] if found else None
