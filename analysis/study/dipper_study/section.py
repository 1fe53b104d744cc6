"""Maps of a YAML file, read key by key; what is wrong is found at its line, and unknown keys are errors."""
import yaml

from dipper_run.text_file import number, said


class Section:
    """One map. `name` is what stands before its keys in a finding."""

    def __init__(self, node, file, found, name=""):
        self.node, self.file, self.found, self.name = node, file, found, name
        self.line = node.start_mark.line + 1
        self._all, self._read = {}, set()
        for key, value in node.value:
            if not isinstance(key, yaml.ScalarNode):
                self.wrong("key", f"is {said(key)}", "a word, or a text in quotes", key)
                continue
            if key.value in self._all:
                self.wrong(key.value, "is given twice", "give it once", key)
            self._all[key.value] = (key, value)

    def wrong(self, key, what, right, node=None):
        """Adds a finding about a key, at `node`, else where the key stands, else at the map."""
        node = node or (self._all[key][0] if key in self._all else None)
        line = node.start_mark.line + 1 if node else self.line
        self.found.add(self.file, line, f"{self.name}{key}", what, right)

    def keys(self):
        return list(self._all)

    def get(self, key):
        """The node of a key, or None; it counts as known."""
        self._read.add(key)
        return self._all[key][1] if key in self._all else None

    def line_of(self, key):
        return self._all[key][0].start_mark.line + 1

    def end(self, required=()):
        """To be called once everything that is known has been read."""
        for key in self._all:
            if key not in self._read:
                self.wrong(key, "unknown key", f"one of {', '.join(sorted(self._read))}")
        for key in required:
            if key not in self._all:
                self.wrong(key, "is missing", "give it")

    def section(self, key):
        """The map of a key, or None."""
        node = self.get(key)
        if node is not None and not isinstance(node, yaml.MappingNode):
            self.wrong(key, f"is {said(node) or 'empty'}", "a map")
            return None
        return node and Section(node, self.file, self.found, f"{self.name}{key}.")

    def filled(self, key, what):
        """The map of a key, which may not be empty; None without the key, or after a finding."""
        inner = self.section(key)
        if inner is not None and not inner.node.value:
            self.wrong(key, "is an empty map", what)
            return None
        return inner

    def text(self, key, default=None):
        node = self.get(key)
        if node is None:
            return default
        if not isinstance(node, yaml.ScalarNode) or not node.value:
            self.wrong(key, f"is {said(node) or 'empty'}", "text")
            return default
        return node.value

    def one_of(self, key, names, default):
        value = self.text(key, default)
        if value not in names:
            self.wrong(key, f"is {value}", f"one of {', '.join(names)}")
            return default
        return value

    def whole(self, key, low, high, default):
        """A whole number from low to high."""
        value = self.number(key, low, high, default)
        if value is not default and value != int(value):
            self.wrong(key, f"is {value:g}", "a whole number")
            return default
        return value if value is None else int(value)

    def number(self, key, low, high, default):
        node = self.get(key)
        if node is None:
            return default
        value = number(node.value) if isinstance(node, yaml.ScalarNode) else None
        if value is None or not low <= value <= high:
            self.wrong(key, f"is {said(node) or 'empty'}", f"a number, {low:g} to {high:g}")
            return default
        return value

    def items(self, key, what):
        """The nodes of a list that is not empty; () after a finding."""
        node = self.get(key)
        if node is None:
            return ()
        if not isinstance(node, yaml.SequenceNode) or not node.value:
            is_list = isinstance(node, yaml.SequenceNode)
            self.wrong(key, f"is {'an empty list' if is_list else said(node) or 'empty'}", f"a list of {what}: [...]")
            return ()
        return node.value
