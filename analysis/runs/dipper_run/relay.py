"""python3 -m dipper_run.relay SOCKET: a program for --operator whose answers come from elsewhere (environment.py).

Carries the run's lines to a Unix socket and what it says back, until either end closes.
"""
import socket
import sys
import threading


def carry(source, sink):
    for line in source:
        sink.write(line)
        sink.flush()


def main(place):
    with socket.socket(socket.AF_UNIX) as link:
        link.connect(place)
        lines = link.makefile("rwb")

        def to_the_learner():
            carry(sys.stdin.buffer, lines)
            link.shutdown(socket.SHUT_WR)

        threading.Thread(target=to_the_learner, daemon=True).start()
        carry(lines, sys.stdout.buffer)


if __name__ == "__main__":
    main(sys.argv[1])
