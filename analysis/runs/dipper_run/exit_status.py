"""How a command ends: its errors on standard error, and its exit status."""
import os
import select
import signal
import sys

from .findings import BadInput
from .program import ProgramFailed


def exit_status(command, work):
    """Calls `work()`. 0: done; 2: bad input or a file that cannot be used; 3: `dipper` itself failed; 4: interrupted;
    what a shell says of a program that SIGPIPE ends, where nobody reads its output to the end."""
    try:
        work()
        sys.stdout.flush()
    except BadInput as e:
        print(e.counted(), file=sys.stderr)
        return 2
    except OSError as e:
        return of_fault(e)
    except ProgramFailed as e:
        print(f"{command}: {e}", file=sys.stderr)
        return 3
    except KeyboardInterrupt:
        return _interrupted(command)
    return 0


def of_fault(e):
    """The exit status after an OSError, which is told."""
    if isinstance(e, BrokenPipeError) and _output_is_closed():
        return 128 + signal.SIGPIPE
    print(f"{e.filename}: {e.strerror}" if e.filename else e.strerror, file=sys.stderr)
    return 2


def end_interrupted(command):
    """From here on an interrupt ends the process with status 4 outside of exit_status, too: while it is imported."""
    def hook(kind, value, trace):
        if not issubclass(kind, KeyboardInterrupt):
            sys.__excepthook__(kind, value, trace)
            return
        os._exit(_interrupted(command))

    sys.excepthook = hook


def _interrupted(command):
    print(f"{command}: interrupted; the same command starts anew", file=sys.stderr, flush=True)
    return 4


def _output_is_closed():
    """Whether it is standard output that nobody reads; then nothing more is written to it, as at the end."""
    output = select.poll()
    output.register(sys.stdout, 0)
    closed = bool(output.poll(0))
    if closed:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return closed
