"""Two clocks of one motion: a mine's passes may begin at another moment of the cycle than the case's."""
import numpy as np

WITHIN_S, STEP_S = 10.0, 0.05


def best_lag_s(misfit):
    """The lag within 10 s, in steps of 0.05 s, with the least misfit(lag_s)."""
    return float(min(np.arange(-WITHIN_S, WITHIN_S + STEP_S / 2, STEP_S), key=misfit))
