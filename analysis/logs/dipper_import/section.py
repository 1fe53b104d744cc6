"""A map within a YAML file, read key by key; every fault is a finding with its line."""
import yaml

from dipper_run.text_file import number, said

from .units import nearest


class Section:
    """The keys of a YAML map. Asking for one gives its value, or its default after a finding."""

    def __init__(self, file, node, name, keys, found):
        self.file, self.name, self.found = file, name, found
        self.line = node.start_mark.line + 1 if node is not None else 0
        self.nodes, self.lines = {}, {}
        if node is not None and not isinstance(node, yaml.MappingNode):
            found.add(file, self.line, name, f"is {said(node)}", "a map of " + ", ".join(keys))
            return
        for key, value in node.value if node is not None else []:
            word, line = said(key), key.start_mark.line + 1
            if word not in keys:
                like = nearest(word, keys)
                found.add(file, line, self.path(word), "unknown key",
                          (f"{like}, perhaps? " if like else "") + "one of " + ", ".join(keys))
            elif word in self.nodes:
                found.add(file, line, self.path(word), "given twice", "keep one")
            self.nodes[word], self.lines[word] = value, line

    def path(self, key):
        return f"{self.name}.{key}" if self.name else key

    def has(self, key):
        return key in self.nodes

    def fault(self, key, wrong, right):
        self.found.add(self.file, self.lines.get(key, self.line), self.path(key), wrong, right)

    def keys(self):
        return list(self.nodes)

    def section(self, key, keys):
        return Section(self.file, self.nodes.get(key), self.path(key), keys, self.found)

    def text(self, key, right, default=None, needed=False):
        """One word or phrase; `right` says what would be."""
        node = self.nodes.get(key)
        if node is None:
            if needed:
                self.fault(key, "missing", right)
            return default
        if not isinstance(node, yaml.ScalarNode) or not node.value:
            self.fault(key, f"is {said(node) or 'empty'}", right)
            return default
        return node.value

    def word(self, key, words, default=None, needed=False):
        """One of `words`."""
        text = self.text(key, "one of " + ", ".join(words), default, needed)
        if text is not None and text != default and text not in words:
            self.fault(key, f"is '{text}'", "one of " + ", ".join(words))
            return default
        return text

    def number(self, key, right, default=None, needed=False, allowed=lambda x: True):
        text = self.text(key, right, None, needed)
        if text is None:
            return default
        value = number(text)
        if value is None or not allowed(value):
            self.fault(key, f"is {text}", right)
            return default
        return value

    def texts(self, key, right, needed=False):
        """A list of texts, or one text alone."""
        node = self.nodes.get(key)
        if isinstance(node, yaml.SequenceNode) and all(isinstance(n, yaml.ScalarNode) for n in node.value):
            return [n.value for n in node.value]
        one = self.text(key, right, needed=needed)
        return [] if one is None else [one]

    def numbers(self, key, right, needed=False):
        """A list of numbers, or one alone; None after a finding."""
        texts = self.texts(key, right, needed)
        values = [number(t) for t in texts]
        if None in values:
            self.fault(key, f"is {', '.join(texts)}", right)
            return None
        return values
