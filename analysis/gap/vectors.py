"""Feature vectors of runs and of a mine over the same cells, and what the instruments do to them."""
import numpy as np

from .balance import balanced, tonnes_a_kN
from .noise import measured_features, noise_covariance, noisy_features


class Vectors:
    """How folders with these `channels` and pass `numbers` become vectors over `cells`.

    `base` are runs of the unchanged case: their noise is everyone's, and they tell the balance.
    """

    def __init__(self, channels, numbers, base):
        self.channels, self.numbers = channels, list(numbers)
        views = [noisy_features(m.seen_by(channels), channels, numbers) for m in base]
        self.plain, self.durations = views[0].cells, views[0].durations
        self.slope = tonnes_a_kN(self.plain, np.array([v.mean for v in views if v.cells == self.plain]))
        self.cells, _ = balanced(self.plain, views[0].mean, self.slope)
        noise = noise_covariance(views, channels)
        for _ in range(2):  # rows, then columns
            noise = balanced(self.plain, noise, self.slope)[1].T
        self.noise = noise                                                   # (n, n)
        self.common = balanced(self.plain, views[0].common, self.slope)[1]  # (channels, n): one common_sigma each

    def of_run(self, measured):
        """Cells and vector of a noise-free folder, as the mine's instruments would see it on average."""
        view = noisy_features(measured.seen_by(self.channels), self.channels, self.numbers)
        return balanced(view.cells, view.mean, self.slope)

    def of_mine(self, measured):
        """Cells, vector and durations of the mine's own folder."""
        cells, y, durations = measured_features(measured, self.numbers)
        return (*balanced(cells, y, self.slope), durations)


def places(cells, wanted):
    index = {c: i for i, c in enumerate(cells)}
    return [index[c] for c in wanted]
