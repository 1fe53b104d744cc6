"""python3 -m dipper_run.worker JOBS.json NUMBER: makes one job of a list; a queue of a cluster starts it.

The file holds {"program", "jobs": [{folder, words, label, drop, report, facts}]}. What it ends
with is written to NUMBER.json beside it: {"error": null or the message}. Without that file the job was lost (a node, a
time limit), not failed.
"""
import json
import os
import signal
import sys
from pathlib import Path

from .kept_runs import Job, KeptRuns


def job_of(listed):
    return Job(Path(listed["folder"]), tuple(listed["words"]), listed["label"], tuple(listed["drop"]), listed["report"],
               listed["facts"])


def main(file, number):
    batch = json.loads(Path(file).read_text())
    errors = []
    for kind in (signal.SIGINT, signal.SIGTERM):  # the queue's warning before a limit: leave a checkpoint
        signal.signal(kind, signal.default_int_handler)
    try:
        KeptRuns(batch["program"], 1).make([job_of(batch["jobs"][number])], lambda _, error: errors.append(error))
    except KeyboardInterrupt:
        print("interrupted; it continues from its checkpoint", flush=True)
        return 4
    error = errors[0] if errors else None
    answer = Path(file).parent / f"{number}.json"
    part = answer.with_suffix(".part")
    part.write_text(json.dumps({"error": error and str(error)}))
    os.replace(part, answer)
    print(error or "done", flush=True)
    return 3 if error else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], int(sys.argv[2])))
