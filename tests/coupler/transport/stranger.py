#!/usr/bin/python3
"""Somebody else on the run's network: stranger.py PACKETS_A_SECOND SEED, until killed.

Sends what a run must ignore: noise, packets cut short or without the NUL of their channel, wild
fragments, other runs' messages, and, of the run's own, copies: as they were, turned round, one bit
changed.
"""
import random
import socket
import struct
import sys
import time

from relay import MASTER, PORT, listen

CHANNELS = [b"DIPPER_TO_DEM", b"DIPPER_FROM_DEM", b"DIPPER_TO_MBS", b"DIPPER_FROM_MBS"]


def packet(rng, heard):
    head = b"LC02" + struct.pack(">I", rng.getrandbits(32))
    kind = rng.randrange(8)
    noise = rng.randbytes(rng.randrange(500))
    if kind == 0:
        return noise
    if kind == 1:
        return head + b"x" * rng.randrange(300)  # no NUL
    if kind == 2:  # a fragment that lies far outside of its message
        return (b"LC03" + struct.pack(">IIIHH", rng.getrandbits(32), rng.randrange(1000), rng.getrandbits(32),
                                      rng.randrange(4), rng.randrange(4)) + rng.choice(CHANNELS) + b"\0" + noise)
    if kind == 3 or not heard:
        return head + rng.choice(CHANNELS) + b"\0" + noise
    old = rng.choice(heard)
    if kind == 4:
        return old
    if kind == 5:
        return old[:rng.randrange(len(old))]
    if kind == 6:  # as the message of another channel
        return head + rng.choice(CHANNELS) + b"\0" + old.split(b"\0", 5)[-1]
    at = rng.randrange(len(old))
    return old[:at] + bytes([old[at] ^ (1 << rng.randrange(8))]) + old[at + 1:]


def main():
    rate, seed = float(sys.argv[1]), int(sys.argv[2])
    rng = random.Random(seed)
    ear = listen(MASTER)
    out = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    out.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
    out.bind(("", 0))
    own = out.getsockname()[1]
    heard, sent, began = [], 0, time.monotonic()
    ready = [packet(rng, heard) for _ in range(2000)]
    while True:
        try:
            for _ in range(50):
                data, sender = ear.recvfrom(65536)
                if sender[1] != own and len(heard) < 500:
                    heard.append(data)
        except BlockingIOError:
            pass
        for _ in range(20):  # new ones among the ready ones, so that the rate is kept
            ready[rng.randrange(len(ready))] = packet(rng, heard)
        due = int((time.monotonic() - began) * rate)
        while sent < due:
            out.sendto(ready[sent % len(ready)] or b"x", (MASTER, PORT))
            sent += 1
        time.sleep(0.002)


if __name__ == "__main__":
    main()
