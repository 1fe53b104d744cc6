"""Runs of dipper from Python: `read` opens one; docs/python.md. The other modules make, keep and drive runs."""

__all__ = ["Frame", "NotARun", "Run", "read"]


def __getattr__(name):
    """From .run, once asked for: a program that drives a machine needs neither numpy nor h5py."""
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from . import run
    return getattr(run, name)
