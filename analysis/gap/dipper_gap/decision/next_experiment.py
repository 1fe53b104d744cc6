"""Which cheap measurement would split what these data cannot."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import yaml

EXPERIMENTS = Path(__file__).parent / "experiments.yaml"


@dataclass(frozen=True)
class Proposal:
    name: str
    title: str
    minutes: float
    bits: float      # expected drop of the uncertainty about which effect it is
    answers: tuple   # (what one would see, effects it would speak for)


def propose(weights):
    """Experiments that tell the effects of `weights` {effect: probability} apart, the best per minute first.

    Each experiment gives each effect an expected response, in words; effects with the same response stay
    together. The gain is the entropy of that partition, for responses that are read without error.
    """
    total = sum(weights.values())
    out = []
    for name, e in yaml.safe_load(EXPERIMENTS.read_text()).items():
        groups = {}
        for effect in weights:
            groups.setdefault(e["responses"].get(effect, "nothing new"), []).append(effect)
        share = np.array([sum(weights[n] for n in g) / total for g in groups.values()])
        bits = float(-(share * np.log2(np.maximum(share, 1e-300))).sum())
        if bits > 1e-6:
            answers = tuple((seen, tuple(g)) for seen, g in groups.items())
            out.append(Proposal(name, e["title"], float(e["minutes"]), bits, answers))
    return sorted(out, key=lambda p: -p.bits / p.minutes)
