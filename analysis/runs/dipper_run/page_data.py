"""What Python hands to a page (`dipper page`): JSON with numbers that a reader can take in."""
import numpy as np

DIGITS = 5  # of a number on the page


def plain(x):
    """Tuples and arrays as lists, numbers with the digits a page can show, None for what is no number."""
    if isinstance(x, dict):
        return {k: plain(v) for k, v in x.items()}
    if isinstance(x, (list, tuple, np.ndarray)):
        return [plain(v) for v in x]
    if isinstance(x, (float, np.floating)):
        return float(f"{x:.{DIGITS}g}") if np.isfinite(x) else None
    return x.item() if isinstance(x, np.generic) else x
