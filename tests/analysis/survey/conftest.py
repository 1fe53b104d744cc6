"""Puts the packages and this folder on the path, however pytest is started."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), *(str(HERE.parents[2] / "analysis" / name) for name in ("survey", "runs"))]
