"""Laws as an effect of the case: the drives show their forces besides, and the case runs with it as with any."""
import yaml

from ..simulation.effects import Effect

TITLE = "Force that follows from the motion, found by dipper gap"
NAME = "motion_law"
MOST = 2.0  # of the law


def law_effect(laws):
    """The Effect of one Law a force, whose strength 1 is the laws as they were found."""
    drive = {law: law.channel.removesuffix("_force_kN") for law in laws}
    overlay = tuple(sorted((f"observation.{drive[law]}_law.{term}", "add", float(f"{number:.4g}"))
                           for law in laws for term, number in law.numbers().items()))
    law_words = ". ".join(f"{drive[law].capitalize()} force: {law.words}" for law in laws)
    return Effect(NAME, TITLE, "observation", law_words, "size", "of the law", 0.0, MOST,
                  1.0, "fitted to the training passes, confirmed on those held out (docs/gap_method.md)", overlay,
                  affects="instruments")


def effect_text(e):
    """The file effects/NAME.yaml of an Effect."""
    parameter = {"name": e.parameter, "unit": e.unit, "low": e.low, "high": e.high, "scale": e.scale,
                 "source": e.source}
    return yaml.safe_dump({"title": e.title, "kind": e.kind, "signature": e.signature, "parameter": parameter,
                           "overlay": {key: {how: number} for key, how, number in e.overlay}},
                          sort_keys=False, width=100)
