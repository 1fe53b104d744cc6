"""What is wrong with an input, all of it at once."""

FEW = 3  # faults of one kind that are listed one by one


class BadInput(ValueError):
    """Carries every finding, one a line: `file:line: what: what is wrong; what would be right`."""

    def __init__(self, findings):
        self.findings = list(findings)
        super().__init__("\n".join(self.findings))

    def counted(self):
        """Every finding, and a last line with their number: what a command ends with."""
        return f"{self}\n{len(self.findings)} error{'s' * (len(self.findings) != 1)}"


class Findings:
    """Collects findings, so that a user sees all of them in one go."""

    def __init__(self):
        self.all = []

    def add(self, file, line, what, wrong, right):
        where = f"{file}:{line}" if line else f"{file}"
        self.all.append(f"{where}: {what}: {wrong}; {right}")

    def add_rows(self, file, faults):
        """Faults (line, what, wrong, right) of a table's rows. Of more than FEW with the same what and right the
        first stands for all: one cause has one line."""
        alike = {}
        for line, what, wrong, right in faults:
            alike.setdefault((what, right), []).append((line, wrong))
        for (what, right), rows in alike.items():
            many = len(rows) > FEW
            for line, wrong in rows[:1] if many else rows:
                more = f", and the same in {len(rows) - 1} more lines" if many else ""
                self.add(file, line, what, wrong + more, right)

    def raise_if_any(self):
        if self.all:
            raise BadInput(self.all)
