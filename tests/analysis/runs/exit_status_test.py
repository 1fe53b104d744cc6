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


INTERRUPTED = "x: interrupted; the same command starts anew\n"


def test_an_interrupt_is_status_4():
    assert ended("(_ for _ in ()).throw(KeyboardInterrupt)", closed=False) == (4, INTERRUPTED)


@pytest.mark.parametrize("what, status", [("KeyboardInterrupt", 4), ("ValueError(1)", 1)])
def test_an_interrupt_before_the_work_begins_is_status_4(what, status):
    code = COMMAND.split("sys.exit")[0].format(runs=str(RUNS)).replace("exit_status\n", "end_interrupted\n")
    done = subprocess.run([sys.executable, "-B", "-c", f"{code}end_interrupted('x')\nraise {what}"],
                          stderr=subprocess.PIPE, text=True, timeout=60)
    assert done.returncode == status and (done.stderr == INTERRUPTED) == (status == 4)


@pytest.mark.parametrize("command, heavy", [("import", "dipper_gap.readings.measured"), ("survey", "numpy")])
def test_a_command_is_interrupted_while_it_is_imported(command, heavy):
    packages = [RUNS, RUNS.parent / {"import": "logs", "survey": "survey"}[command], RUNS.parent / "gap"]
    code = f"""import runpy, sys
sys.path[:0] = {[str(p) for p in packages]!r}
class Interrupted:
    def find_spec(self, name, path=None, target=None):
        if name == {heavy!r}:
            raise KeyboardInterrupt
sys.meta_path.insert(0, Interrupted())
runpy.run_module("dipper_{command}", run_name="__main__")
"""
    done = subprocess.run([sys.executable, "-B", "-c", code], stderr=subprocess.PIPE, text=True, timeout=60)
    assert (done.returncode, done.stderr) == (4, f"{command}: interrupted; the same command starts anew\n")
