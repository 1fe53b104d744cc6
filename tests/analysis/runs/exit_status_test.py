"""How a command of Python ends."""
import subprocess
import sys
from pathlib import Path

import pytest

RUNS = Path(__file__).resolve().parents[3] / "analysis/runs"
COMMAND = """
import sys
sys.path.insert(0, {runs!r})
from dipper_run.exit_status import exit_status
sys.exit(exit_status("x", lambda: {work}))
"""


def ended(work, closed=True):
    """(status, standard error) of a command whose output nobody reads, or somebody does."""
    done = subprocess.Popen([sys.executable, "-B", "-c", COMMAND.format(runs=str(RUNS), work=work)],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    if closed:
        done.stdout.close()
    return done.wait(60), done.stderr.read()


@pytest.mark.parametrize("work", ["print(1)", "print(1, flush=True)", "print('x' * 1000000)"])
def test_a_closed_pipe_ends_a_command_without_a_word(work):
    assert ended(work) == (141, "")


def test_another_broken_pipe_is_a_fault():
    status, said = ended("(_ for _ in ()).throw(BrokenPipeError(32, 'Broken pipe', 'a.fifo'))", closed=False)
    assert (status, said) == (2, "a.fifo: Broken pipe\n")
