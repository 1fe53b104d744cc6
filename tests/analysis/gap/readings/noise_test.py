"""What the instruments are said to do to the features is what they do."""
from dataclasses import replace

import numpy as np

import fake_mine
import synthetic
from dipper_gap.readings.noise import measured_features, noise_covariance, noisy_features
from dipper_gap.statistics.localise import localise

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


def test_the_drives_noise_moves_the_ends_of_phases():
    """Where a phase ends while forces are large, its work scatters by that too, and is so much more in the mean."""
    channels = {**CHANNELS, **{n: replace(CHANNELS[n], sigma=1.0) for n in ("hoist_force_kN", "crowd_force_kN")}}
    run = synthetic.run(seed=3)
    view = noisy_features(run, channels, PASSES)
    said = np.sqrt(np.diag(noise_covariance([view], channels)))
    noisy = (synthetic.with_noise(run, k, channels, drives=True) for k in range(COPIES))
    mines = [measured_features(m, PASSES) for m in noisy]
    at = [i for i, c in enumerate(view.cells) if c.phase in ("fill", "breakout") and c.feature in ("work", "mean")]
    rows = np.array([[row[cells.index(view.cells[i])] for i in at] for cells, row, _ in mines])
    ratio, off = rows.std(axis=0, ddof=1) / said[at], (rows.mean(axis=0) - view.mean[at]) / said[at]
    print(f"sd found over said: {ratio.min():.2f} to {ratio.max():.2f}; mean off by {np.abs(off).max():.2f} sd")
    assert 0.6 < ratio.min() and ratio.max() < 1.5 and np.abs(off).max() < 0.5


def test_mines_with_noisy_drives_and_nothing_hidden_have_no_gap():
    w = fake_mine.world(0)
    p = [localise(w.residual({}, k), w.baseline, w.null, w.directions).omnibus_p for k in range(30)]
    print(f"p below 0.01 in {np.sum(np.array(p) < 0.01)} of 30")
    assert np.sum(np.array(p) < 0.01) <= 3
