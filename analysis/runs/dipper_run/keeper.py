"""keeper.py PIPE LOCK PROGRAM WORD...: runs a program that must not outlive whoever holds the pipe's other end.

The analysis may be killed in any way; its runs would go on by themselves for minutes. When the pipe ends, or on an
interrupt, the program is interrupted, so that it leaves a checkpoint. It shares the open file LOCK. Exit status: the
program's.
"""
import select
import signal
import subprocess
import sys

LOOK_S = 0.2


def main(pipe, lock, words):
    asked = []  # an interrupt before the program is started must not be lost
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda *_: asked.append(True))
    child = subprocess.Popen(words, pass_fds=[lock])
    held = True
    while child.poll() is None:
        if select.select([pipe] if held else [], [], [], LOOK_S)[0]:
            held = False  # nobody writes to it: readable means ended
            asked.append(True)
        if asked:
            asked.clear()
            child.send_signal(signal.SIGINT)
    return child.returncode if child.returncode >= 0 else 128 - child.returncode


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]), int(sys.argv[2]), sys.argv[3:]))
