"""Puts the packages and this folder on the path, however pytest is started."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
ANALYSIS = HERE.parents[2] / "analysis"
sys.path[:0] = [str(HERE), str(ANALYSIS / "study"), str(ANALYSIS / "runs")]
