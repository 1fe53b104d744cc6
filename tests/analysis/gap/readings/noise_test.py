"""What the instruments are said to do to the features is what they do."""
from dataclasses import replace

import numpy as np

import synthetic
from dipper_gap.readings.noise import measured_features, noise_covariance, noisy_features

PASSES, COPIES = [1, 2, 3], 60
CHANNELS = {n: replace(c, common_sigma=0.0) for n, c in synthetic.CHANNELS.items()}


def test_the_drives_noise_is_in_the_work():
    """Mines of one run, drives to 5 cm and forces to 1 kN: work scatters as is said, where phases end at rest."""
    channels = {n: replace(c, sigma={"m": 0.05, "kN": 1.0}.get(c.unit, c.sigma)) for n, c in CHANNELS.items()}
    run = synthetic.run(seed=3)
    view = noisy_features(run, channels, PASSES)
    said = np.sqrt(np.diag(noise_covariance([view], channels)))
    noisy = (synthetic.with_noise(run, k, channels, drives=True) for k in range(COPIES))
    mines = [measured_features(m, PASSES) for m in noisy]
    at = [i for i, c in enumerate(view.cells) if c.feature == "work" and c.phase in ("dump", "return")]
    rows = np.array([[row[cells.index(view.cells[i])] for i in at] for cells, row, _ in mines])
    found = rows.std(axis=0, ddof=1) / said[at]
    print(f"sd of work, found over said: {found.min():.2f} to {found.max():.2f}")
    assert len(at) == 12
    assert 0.7 < found.min() and found.max() < 1.4
