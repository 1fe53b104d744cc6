"""How a command ends: its errors on standard error, and its exit status."""
import sys

from .findings import BadInput
from .program import ProgramFailed


def exit_status(command, work):
    """Calls `work()`. 0: done; 2: bad input or a file that cannot be used; 3: `dipper` itself failed."""
    try:
        work()
    except BadInput as e:
        print(e.counted(), file=sys.stderr)
        return 2
    except OSError as e:
        print(f"{e.filename}: {e.strerror}", file=sys.stderr)
        return 2
    except ProgramFailed as e:
        print(f"{command}: {e}", file=sys.stderr)
        return 3
    return 0
