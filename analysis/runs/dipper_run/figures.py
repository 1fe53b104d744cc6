"""matplotlib for the pictures that commands write."""


def pyplot():
    """matplotlib.pyplot by its own defaults, into files, with text as it is written.

    A matplotlibrc of the user's, or one in the current folder, is for other figures: it may ask for a size, a backend
    or LaTeX. A file's name in a title may have dollar signs.
    """
    import matplotlib  # takes a second, which a command without a picture need not wait
    matplotlib.rcdefaults()
    matplotlib.use("Agg")
    matplotlib.rcParams["text.parse_math"] = False
    from matplotlib import pyplot as found
    return found
