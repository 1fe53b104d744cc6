"""What is wrong with an input, all of it at once."""


class BadInput(ValueError):
    """Carries every finding, one a line: `file:line: what: what is wrong; what would be right`."""

    def __init__(self, findings):
        self.findings = list(findings)
        super().__init__("\n".join(self.findings))


class Findings:
    """Collects findings, so that a user sees all of them in one go."""

    def __init__(self):
        self.all = []

    def add(self, file, line, what, wrong, right):
        where = f"{file}:{line}" if line else f"{file}"
        self.all.append(f"{where}: {what}: {wrong}; {right}")

    def raise_if_any(self):
        if self.all:
            raise BadInput(self.all)
