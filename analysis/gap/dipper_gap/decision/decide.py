"""What may be said: a name, a class of effects that look alike, `unknown`, or no gap at all.

A wrong name costs more than `cannot tell`, so a name must pass every rule.
"""
from dataclasses import dataclass, field

import numpy as np

from ..statistics.isolability import isolability
from ..statistics.null import statistics

OMNIBUS_P = 0.01       # there is a gap
PROBABILITY = 0.90     # of the effect, or the class
BAYES_FACTOR = 10.0    # over every effect outside the class
CONSISTENT_P = 0.05    # what the effect leaves looks like nothing
NEGLIGIBLE = 0.05      # of everything in the catalogue together
LARGEST_CLASS = 4      # a longer list is no answer


@dataclass(frozen=True)
class Verdict:
    verdict: str                    # named | class | unknown | no-gap
    effect: str = ""
    members: tuple = ()             # the class; the effect alone when named
    probability: float = 0.0
    residual_p: float = 1.0
    reasons: tuple = ()             # rules that did not pass, in words
    rejected: tuple = field(default_factory=tuple)  # (effect, probability, reason)


def decide(omnibus_p, m, signatures, covariance, plain, residual, baseline, null):
    """`covariance` holds the nuisances and the null's inflation; `plain` only the nuisances."""
    if omnibus_p >= OMNIBUS_P:
        return Verdict("no-gap", probability=m.probability["none"],
                       reasons=(f"omnibus p {omnibus_p:.2g} is not below {OMNIBUS_P:g}",))
    by_name = {s.name: s for s in signatures}
    lead = max(by_name, key=m.presence)
    best = m.fits[sure(m, lead)]
    strength = best.best[best.names.index(lead)]
    members = _class(lead, strength, m, signatures, covariance)
    residual_p = _left_over(best, by_name, plain, residual, baseline, null)
    failed = _failed(lead, members, strength, m, by_name, residual_p)
    probability = m.presence(lead)
    if not failed and probability >= PROBABILITY:
        return Verdict("named", lead, (lead,), probability, residual_p, (), _rejected(lead, (lead,), m, by_name))
    together = m.any_of(members)
    reasons = tuple(failed) + ((f"probability {probability:.2f} is below {PROBABILITY:g}",)
                               if probability < PROBABILITY else ())
    if not failed and together >= PROBABILITY and 1 < len(members) <= LARGEST_CLASS:
        return Verdict("class", lead, members, together, residual_p, reasons, _rejected(lead, members, m, by_name))
    if together < NEGLIGIBLE:
        reasons = ("nothing in the catalogue explains it",)
    elif together < PROBABILITY:
        reasons += (f"with what looks like it ({', '.join(members)}) {together:.2f}",)
    elif len(members) > LARGEST_CLASS:
        reasons += (f"{len(members)} effects look alike here",)
    return Verdict("unknown", "", (), m.probability["unknown"], residual_p, reasons,
                   _rejected("", (), m, by_name))


def sure(m, lead):
    """The set of `lead` and its companions that are as probable as a name must be: what would be added."""
    names = {n for key in m.fits for n in key}
    beside = {n for n in names - {lead} if m.presence(n) >= PROBABILITY}
    return next((key for key in m.fits if set(key) == beside | {lead}), (lead,))


def _class(lead, strength, m, signatures, covariance):
    """Effects these data cannot tell from `lead` at the strength it has, and those still in the running."""
    at = [strength if s.name == lead else s.effect.reference() for s in signatures]
    alike = set(isolability(signatures, covariance, at, only=lead).classmates(lead))
    rivals = sorted((s.name for s in signatures if s.name != lead), key=m.presence, reverse=True)
    members = [lead] + [n for n in rivals if n in alike and m.log_bayes(lead, n) < np.log(BAYES_FACTOR)]
    for n in rivals:  # fill up to the probability asked for, if few are enough
        if m.any_of(members) >= PROBABILITY or len(members) == LARGEST_CLASS:
            break
        if n not in members:
            members.append(n)
    return tuple(members)


def _left_over(best, by_name, plain, residual, baseline, null):
    """p of what the effects leave, by the omnibus test, whose null knows how little the covariance is known."""
    spread = plain + sum(a * a * by_name[n].spread for a, n in zip(best.best, best.names))
    stats = statistics(residual - best.explained, spread, baseline.grid)
    return float(null.plain().omnibus_p(stats))


def _failed(lead, members, strength, m, by_name, residual_p):
    effect = by_name[lead].effect
    out = []
    for other in by_name:
        beside = m.presence(other) >= PROBABILITY  # a companion is no rival
        if other not in members and not beside and m.log_bayes(lead, other) < np.log(BAYES_FACTOR):
            out.append(f"Bayes factor over {other} is {np.exp(m.log_bayes(lead, other)):.1f}, "
                       f"not above {BAYES_FACTOR:g}")
    if residual_p <= CONSISTENT_P:
        out.append(f"what it leaves is not like noise: p {residual_p:.2g}")
    if strength == 0 or not effect.low < strength < effect.high:
        out.append(f"the estimate {strength:.3g} {effect.unit} is at a bound")
    return out


def _rejected(lead, members, m, by_name):
    """What is turned down, and why; not what is as sure as a name must be, beside a lead."""
    out = []
    for n in sorted(by_name, key=m.presence, reverse=True):
        if n in members or (lead and m.presence(n) >= PROBABILITY):
            continue
        factor = m.log_bayes(lead, n) / np.log(10) if lead else None
        reason = (f"in place of {lead} it is {_times(factor)} less likely" if lead
                  else f"alone it explains the data {_times(_behind(m, n))} worse than the best")
        out.append((n, m.presence(n), reason))
    return tuple(out)


def _times(power):
    """A factor of 10 ** power to read."""
    return "over a million times" if power > 6 else f"{10**power:,.{0 if power > 1 else 1}f} times"


def _behind(m, name):
    return (max(m.log_weight.values()) - m.log_weight[(name,)]) / np.log(10)
