#!/usr/bin/python3
"""A bad network for a whole run: relay.py REAL_PROGRAM CONFIG.

Stands in for dipper-mbs and dipper-dem. Each is sent to a multicast group of its own (its config's URL
is changed on the way), and between that group and the master's a relay drops, doubles and delays
packets as RELAY says: a JSON object with `drop`, `double`, `late` (the part that comes `late_s`
later) and `swap` (the part that comes some milliseconds later, after its successors) and `seed`.
The relay knows no secret: it carries bytes.
"""
import ctypes
import heapq
import json
import os
import random
import select
import signal
import socket
import struct
import sys
import time

MASTER, SIDES, PORT = "239.255.76.67", "239.255.76.68", 7667


def listen(group):
    s = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    s.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    s.bind((group, PORT))
    s.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP,
                 struct.pack("4s4s", socket.inet_aton(group), b"\0" * 4))
    s.setblocking(False)
    return s


def relay(drop=0.0, double=0.0, late=0.0, late_s=0.1, swap=0.0, seed=1):
    rng = random.Random(seed)
    sockets = {listen(MASTER): SIDES, listen(SIDES): MASTER}
    out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    out.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
    out.bind(("", 0))
    own = out.getsockname()[1]
    waiting, count = [], 0
    while True:
        now = time.monotonic()
        while waiting and waiting[0][0] <= now:
            _, _, data, group = heapq.heappop(waiting)
            out.sendto(data, (group, PORT))
        patience = waiting[0][0] - time.monotonic() if waiting else None
        for s in select.select(list(sockets), [], [], None if patience is None else max(0, patience))[0]:
            data, sender = s.recvfrom(65536)
            if sender[1] == own:  # what this relay sent
                continue
            for _ in range(2 if rng.random() < double else 1):
                if rng.random() < drop:
                    continue
                delay = late_s if rng.random() < late else 0.003 * rng.random() if rng.random() < swap else 0
                if delay == 0:
                    out.sendto(data, (sockets[s], PORT))
                    continue
                count += 1
                heapq.heappush(waiting, (time.monotonic() + delay, count, data, sockets[s]))


def main():
    real, config = sys.argv[1:]
    if os.path.basename(real) == "dipper-mbs" and os.fork() == 0:
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG: ends with the machine side
        relay(**json.loads(os.environ["RELAY"]))
    changed = f"{config}.{os.getpid()}"
    with open(config) as f:
        text = f.read()
    with open(os.open(changed, os.O_WRONLY | os.O_CREAT, 0o600), "w") as f:
        f.write(text.replace(MASTER, SIDES))
    os.execv(real, [real, changed])


if __name__ == "__main__":
    main()
