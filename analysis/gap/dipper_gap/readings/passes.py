"""The passes that an analysis compares: those that are there, to train on, and held out."""
from dipper_run.findings import BadInput

NEED_PASSES = 2  # one to train on and one to hold out


def common_passes(measured, folders):
    """Numbers of the passes that are both measured and in every run.

    Throws BadInput when they are too few.
    """
    common = set(p.number for p in measured.passes)
    for m in folders:
        common &= set(p.number for p in m.passes)
    if len(common) < NEED_PASSES:
        raise BadInput([f"{len(common)} passes are both measured and simulated; {NEED_PASSES} or more "
                        "are needed, one to train on and one to hold out"])
    return sorted(common)


def split(numbers):
    """Training and hold-out passes: the second of every three is held out; of two, the last.

    The first and the last of three stay in training: some effects only show there.
    """
    held = [n for i, n in enumerate(numbers) if i % 3 == 1]
    return tuple(n for n in numbers if n not in held), tuple(held)
