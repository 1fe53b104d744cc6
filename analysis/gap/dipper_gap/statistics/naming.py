"""From which strength on an effect gets its name, before looking at what was measured."""
import numpy as np

from .match import match

SURE = 0.99  # probability of the effect where the data show what it does, without noise: named in three of four then
STEP = 1.1   # from one strength that is tried to the next


def naming_limits(signatures, covariance, baseline, found):
    """(K,) smallest strength, of those tried from that on at which an effect stands out (`found`, (K,)), at which it is
    told from all others, from something unknown and from nothing, to whichever side it goes; inf: none within its
    bounds. `covariance` holds the nuisances."""
    def named(k, strength):
        residual = strength * signatures[k].g
        return match(residual, covariance, signatures, baseline, largest=1).presence(signatures[k].name) >= SURE

    def limit(k, bound):
        if not found[k] < abs(bound):
            return np.inf
        tried = found[k] * STEP ** np.arange(1 + int(np.log(abs(bound) / found[k]) / np.log(STEP)))
        return next((x for x in tried if named(k, np.sign(bound) * x)), np.inf)

    return np.array([max(limit(k, bound) for bound in s.effect.sides()) for k, s in enumerate(signatures)])
