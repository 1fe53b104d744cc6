"""Feature vectors of runs and of a mine over the same cells, and what the instruments do to them."""
from dataclasses import replace

import numpy as np

from .balance import balanced, tonnes_a_kN
from .channels import FACE, MASS
from .noise import common_errors, measured_features, noise_covariance, noisy_features


class Vectors:
    """How folders with these `channels` and pass `numbers` become vectors over `cells`.

    `base` are runs of the unchanged case: their noise is everyone's, and they tell the balance.
    """

    def __init__(self, channels, numbers, base):
        self.channels, self.numbers = channels, list(numbers)
        seen = [m.seen_by(channels) for m in base]
        views = [noisy_features(m, channels, numbers) for m in seen]
        self.plain, self.durations = views[0].cells, views[0].durations
        self.slope = tonnes_a_kN(self.plain, np.array([v.mean for v in views if v.cells == self.plain]))
        self.cells, _ = balanced(self.plain, views[0].mean, self.slope)
        own = noise_covariance(views, channels)
        for _ in range(2):  # rows, then columns
            own = balanced(self.plain, own, self.slope)[1].T
        self.own = own                                                 # (n, n) of one truck
        # A shift of each channel: also of one that shares no error, which may have drifted, or be all that is wrong.
        steps = {n: c.common_sigma or c.sigma or 1.0 for n, c in channels.items()}
        stepped = {n: replace(c, common_sigma=steps[n]) for n, c in channels.items()}
        shifts = balanced(self.plain, common_errors(seen, stepped, numbers), self.slope)[1]
        names = (*seen[0].responses(), *(n for n in (MASS, FACE) if n in seen[0].channels))
        self.bias = shifts / np.array([steps[n] for n in names])[:, None]                    # (channels, n): 1 each
        self.common = self.bias * np.array([channels[n].common_sigma for n in names])[:, None]  # common_sigma each

    def of_run(self, measured):
        """Cells and vector of a noise-free folder, as the mine's instruments would see it on average."""
        view = noisy_features(measured.seen_by(self.channels), self.channels, self.numbers)
        return balanced(view.cells, view.mean, self.slope)

    def of_mine(self, measured):
        """Cells, vectors (trucks, n) and each truck's durations of the mine's own folder."""
        seen = [measured_features(truck, self.numbers) for truck in measured.trucks()]
        cells = [c for c in seen[0][0] if all(c in of for of, _, _ in seen)]
        y = np.array([row[indices_of(cells, of)] for of, row, _ in seen])
        return (*balanced(cells, y, self.slope), [durations for _, _, durations in seen])


def indices_of(wanted, cells):
    index = {c: i for i, c in enumerate(cells)}
    return [index[c] for c in wanted]
