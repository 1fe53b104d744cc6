"""What Python hands to a page (`dipper page`): JSON with numbers that a reader can take in."""
import numpy as np

DIGITS = 5  # of a number on the page


def finite(x, digits=None):
    """Tuples and arrays as lists, and None for what is no number, as JSON has them; numbers with so many digits."""
    if isinstance(x, dict):
        return {k: finite(v, digits) for k, v in x.items()}
    if isinstance(x, (list, tuple, np.ndarray)):
        return [finite(v, digits) for v in x]
    if isinstance(x, (float, np.floating)):
        if not np.isfinite(x):
            return None
        return float(f"{x:.{digits}g}") if digits else float(x)
    return x.item() if isinstance(x, np.generic) else x


def plain(x):
    """The same with the digits that a page can show."""
    return finite(x, DIGITS)
