"""Maps of a YAML file, read key by key; every fault has its line, and unknown keys are errors."""
import yaml

from .text_file import nearest, number, said


class Section:
    """One map; false where there is none. `name` is what stands before its keys in a finding.

    A method that reads a key marks it as known. It returns the default where the key is missing,
    and after a finding. `right` says what the value should be.
    """

    def __init__(self, node, file, found, name="", line=1):
        self.file, self.found, self.name, self.line = file, found, name, line
        self._there = node is not None
        self._all, self._known = {}, set()
        for key, value in node.value if self._there else []:
            if not isinstance(key, yaml.ScalarNode):
                self.wrong("key", f"is {said(key)}", "a word, or a text in quotes", key)
                continue
            if key.value in self._all:
                self.wrong(key.value, "given twice", "keep one", key)
            self._all[key.value] = (key, value)

    def __bool__(self):
        return self._there

    def __contains__(self, key):
        return key in self._all

    def wrong(self, key, what, right, node=None):
        """Adds a finding about a key, at `node`, else where the key stands, else at the map."""
        line = node.start_mark.line + 1 if node else self.line_of(key)
        self.found.add(self.file, line, f"{self.name}{key}", what, right)

    def keys(self):
        return list(self._all)

    def get(self, key):
        """The node of a key, or None."""
        self._known.add(key)
        return self._all[key][1] if key in self._all else None

    def line_of(self, key):
        """Of the key, or of the map where the key is missing."""
        return self._all[key][0].start_mark.line + 1 if key in self._all else self.line

    def end(self, required=()):
        """To be called once everything that is known has been read."""
        for key in self._all:
            if key not in self._known:
                like = nearest(key, self._known)
                hint = f"{like}, perhaps? " if like else ""
                self.wrong(key, "unknown key", f"{hint}one of {', '.join(sorted(self._known))}")
        for key in required:
            if key not in self._all:
                self.wrong(key, "missing", "give it")

    def section(self, key, right="a map"):
        """The map of a key; a false section where the key is missing, or after a finding."""
        node = self.get(key)
        if node is not None and not isinstance(node, yaml.MappingNode):
            self.wrong(key, f"is {said(node) or 'empty'}", right)
            node = None
        return Section(node, self.file, self.found, f"{self.name}{key}.", self.line_of(key))

    def filled(self, key, right):
        """The map of a key, which may not be empty."""
        inner = self.section(key)
        if inner and not inner.keys():
            self.wrong(key, "is an empty map", right)
        return inner

    def text(self, key, default=None, right="text", needed=False):
        """One word or phrase."""
        node = self.get(key)
        if node is None:
            if needed:
                self.wrong(key, "missing", right)
            return default
        if not isinstance(node, yaml.ScalarNode) or not node.value:
            self.wrong(key, f"is {said(node) or 'empty'}", right)
            return default
        return node.value

    def one_of(self, key, names, default=None, needed=False):
        right = f"one of {', '.join(names)}"
        value = self.text(key, default, right, needed)
        if value != default and value not in names:
            self.wrong(key, f"is {value}", right)
            return default
        return value

    def number(self, key, default=None, right="a number", needed=False, allowed=lambda x: True):
        node = self.get(key)
        if node is None:
            if needed:
                self.wrong(key, "missing", right)
            return default
        value = number(node.value) if isinstance(node, yaml.ScalarNode) else None
        if value is None or not allowed(value):
            self.wrong(key, f"is {said(node) or 'empty'}", right)
            return default
        return value

    def between(self, key, low, high, default):
        """A number from low to high."""
        return self.number(key, default, f"a number, {low:g} to {high:g}", allowed=lambda x: low <= x <= high)

    def whole(self, key, low, high, default):
        """A whole number from low to high."""
        value = self.between(key, low, high, default)
        if value is not default and value != int(value):
            self.wrong(key, f"is {value:g}", "a whole number")
            return default
        return value if value is None else int(value)

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

    def texts(self, key, right, needed=False):
        """A list of texts, or one text alone."""
        node = self.get(key)
        if isinstance(node, yaml.SequenceNode) and all(isinstance(n, yaml.ScalarNode) for n in node.value):
            return [n.value for n in node.value]
        one = self.text(key, None, right, needed)
        return [] if one is None else [one]

    def numbers(self, key, right, needed=False):
        """A list of numbers, or one alone; None after a finding."""
        texts = self.texts(key, right, needed)
        values = [number(t) for t in texts]
        if None in values:
            self.wrong(key, f"is {', '.join(texts)}", right)
            return None
        return values
