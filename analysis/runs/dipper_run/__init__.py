"""Runs of dipper from Python: `read` opens one; docs/python.md. The other modules make and keep runs for its tools."""
from .run import Frame, NotARun, Run, read

__all__ = ["Frame", "NotARun", "Run", "read"]
