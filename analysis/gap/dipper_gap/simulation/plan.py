"""Which runs an analysis needs."""
from dataclasses import dataclass, replace

from .simulator import request

LEAST_SEEDS, MOST_SEEDS = 8, 16
SEEDS_A_TRUCK = 4  # so that the model's mean is known twice as well as the mine's, up to the most
SIGNATURE_RUNS = ((0, 0), (1, 1), (1, 2))  # (which of the two strengths, which of the baseline's seeds)
FRESH_SEEDS = 5
FRESH_FROM = 1000  # seeds of the confirming runs start so far above the baseline's


@dataclass(frozen=True)
class PlannedRun:
    strength: float
    seed_index: int  # which of the baseline's runs has the same seed
    request: object
    same_rock: bool  # the rock does what it does in the plain run: it takes no run of its own


@dataclass(frozen=True)
class Plan:
    first_seed: int
    baseline: tuple   # requests of the unchanged case, one a seed
    signatures: dict  # {effect: (PlannedRun, ...)}; effects with the same overlay share their runs

    def requests(self):
        """Every run, once."""
        every = list(self.baseline) + [p.request for planned in self.signatures.values() for p in planned]
        return list(dict.fromkeys(every))

    def only(self, names):
        """The same with the signatures of these effects alone."""
        return replace(self, signatures={n: p for n, p in self.signatures.items() if n in names})

    def fresh_seeds(self):
        """Seeds of the runs that confirm a named effect."""
        return [self.first_seed + FRESH_FROM + k for k in range(FRESH_SEEDS)]


def seeds_for(trucks):
    """How many seeds the model is run with for a mine of so many trucks."""
    return min(MOST_SEEDS, max(LEAST_SEEDS, SEEDS_A_TRUCK * trucks))


def make_plan(catalogue, trucks, first_seed, takes_a_run=lambda r: r.how == "run"):
    """`takes_a_run` is a Simulator's: with limited drives a replay cannot tell what another machine does, and its runs
    are as chaotic as those of another rock."""
    seeds = [first_seed + k for k in range(seeds_for(trucks))]
    signatures, shared = {}, {}
    for effect in sorted(catalogue.values(), key=lambda e: e.nuisance):
        first = shared.setdefault(effect.overlay or effect.name, effect)
        same_rock = not takes_a_run(request({first.name: 1.0}, 0, catalogue))
        strengths = first.strengths(same_rock)
        signatures[effect.name] = tuple(
            PlannedRun(strengths[i], k, request({first.name: strengths[i]}, seeds[k], catalogue), same_rock)
            for i, k in SIGNATURE_RUNS)
    return Plan(first_seed, tuple(request({}, s, catalogue) for s in seeds), signatures)


def without_runs(plan, simulator):
    """The plan with the effects that are observed or replayed: besides the baseline's they take no run."""
    return plan.only([n for n, planned in plan.signatures.items()
                      if not any(simulator.takes_a_run(p.request) for p in planned)])


def statement(plan, simulator, first=None):
    """What the analysis will take, before it starts; `first` is the part after which it may end."""
    todo, kept, each = simulator.plan(plan.requests())
    text = f"{todo + kept} runs, {kept} of them kept from before; {FRESH_SEEDS} more confirm a named effect"
    if first and len(first.signatures) < len(plan.signatures):
        text += f"; {sum(simulator.plan(first.requests())[:2])} of them decide whether there is a gap at all"
    if todo and each:
        return text + f"; about {todo * each / simulator.jobs / 60:.0f} min, {simulator.jobs} at a time"
    return text + "; a time estimate follows after the first" if todo else text
