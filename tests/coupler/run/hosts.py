"""Two hosts for MPI on this one: a network namespace each, with a name, shared memory and a cable of its own."""

import contextlib
import os
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

NAMES = {"10.77.0.1": "h1", "10.77.0.2": "h2"}

# Asks its arguments' addresses until each answers, which one that is reached does by refusing: nobody listens there.
ASK = """
import errno, socket, sys, time
for address in sys.argv[1:]:
    while socket.socket().connect_ex((address, 9)) != errno.ECONNREFUSED:
        time.sleep(0.05)
"""


def ip(*words):
    done = subprocess.run(["ip", *map(str, words)], capture_output=True, text=True)
    if done.returncode:
        raise OSError(f"ip {' '.join(map(str, words))}: {done.stderr.strip()}")
    return done.stdout


class Hosts:
    """`with Hosts() as hosts`: they are there until its end. Raises OSError where this user may not make them."""

    def __enter__(self):
        with contextlib.ExitStack() as made:
            self._folder = Path(made.enter_context(tempfile.TemporaryDirectory(prefix="dipper-hosts-")))
            self._switch = self._namespace(made, "sw")
            ip("-n", self._switch, "link", "add", "br0", "type", "bridge")
            ip("-n", self._switch, "link", "set", "br0", "up")
            for address, host in NAMES.items():
                space = self._namespace(made, host)
                ip("link", "add", "eth0", "netns", space, "type", "veth", "peer", "name", host, "netns", self._switch)
                ip("-n", self._switch, "link", "set", host, "master", "br0", "up")
                ip("-n", space, "addr", "add", f"{address}/24", "dev", "eth0")
                for device in ("lo", "eth0"):
                    ip("-n", space, "link", "set", device, "up")
                ip("-n", space, "route", "add", "default", "via", "10.77.0.254")
            for host in NAMES.values():
                self._write(host, f"exec ip netns exec {self._name(host)} unshare -um sh -c 'hostname {host}; "
                            """mount -t tmpfs tmpfs /dev/shm; exec "$@"' sh "$@"\n""")
            # In place of ssh: mpirun calls it with a host and a command.
            agent = self._write("agent", "host=$1; shift\ncase $host in\n" + "".join(
                f'{address}) exec {self._folder / host} sh -c "$*";;\n' for address, host in NAMES.items())
                + 'esac\necho "no host $host" >&2; exit 1\n')
            hostfile = self._folder / "hosts"
            hostfile.write_text("".join(f"{address} slots=1\n" for address in NAMES))
            #: what `dipper run --mpirun` takes for a rank on each. Either host thinks that all cores are its own:
            #: bound, both ranks would be on the first one; and they yield while they wait.
            self.agent = f"--mca plm_rsh_agent {agent} --bind-to none --mca mpi_yield_when_idle 1"
            self.options = f"{self.agent} --hostfile {hostfile}"
            self._until_reached()
            self._until = made.pop_all()
        return self

    def __exit__(self, *_):
        self._until.close()

    def command(self, host, words):
        """The words that make another command run on a host."""
        return [self._folder / host, *words]

    def kill(self, host):
        for pid in ip("netns", "pids", self._name(host)).split():
            with contextlib.suppress(ProcessLookupError):
                os.kill(int(pid), signal.SIGKILL)

    def plug(self, host, state):
        """Its cable, "down" or "up"."""
        ip("-n", self._switch, "link", "set", host, state)
        if state == "up":
            self._until_reached()

    def _until_reached(self):
        """A request for a host made while its cable was out still fails up to a second after it is back in."""
        for host in NAMES.values():
            subprocess.run(self.command(host, [sys.executable, "-c", ASK, *NAMES]), check=True, timeout=60)

    def _name(self, host):
        return f"dipper{os.getpid()}{host}"

    def _write(self, name, script):
        file = self._folder / name
        file.write_text("#!/bin/sh\n" + script)
        file.chmod(0o755)
        return file

    def _namespace(self, made, host):
        name = self._name(host)
        ip("netns", "add", name)
        made.callback(self._remove, host)
        return name

    def _remove(self, host):
        until = time.monotonic() + 10
        while ip("netns", "pids", self._name(host)).split() and time.monotonic() < until:
            self.kill(host)
            time.sleep(0.05)
        ip("netns", "del", self._name(host))
