"""What a study will take, printed before it starts."""
from dipper_run.quantities import minutes, size_text

from .plan import free_bytes


def statement(study, planner, executor, runs, own, todo):
    """Two lines: runs and time; disk. Of the runs asked for, `own` are not the same as another, `todo` not kept."""
    points = len({r.point for r in runs})
    seeds = len({r.seed for r in runs})
    said = (f"study: {points} points x {seeds} seeds of {study.case}: {own} runs"
            + (f" (points that are the same case share {len(runs) - own})" if own < len(runs) else "")
            + f", {own - len(todo)} of them kept")
    if not todo:
        return said
    seconds = sum(map(planner.seconds, todo)) / executor.at_once
    sizes = [planner.disk(r) for r in todo]
    stays, more = sum(s for s, _ in sizes), max(m for _, m in sizes) * min(executor.at_once, len(todo))
    cache = todo[0].job.folder.parent
    free = free_bytes(cache)
    said += (f"; {executor.statement}; about {minutes(seconds)}, guessed from their size\n"
             f"study: keep {study.keep}: about {size_text(stays)} of disk in {cache}, {size_text(more)} more while it "
             f"goes on; {size_text(free)} free")
    if stays + more > free:
        said += ": NOT ENOUGH"
    return said
