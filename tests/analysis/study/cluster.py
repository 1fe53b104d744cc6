"""A Slurm of the test's own: munge, a controller and three nodes, on this machine, in one folder, for
the user of the test, on free ports."""
import getpass
import os
import shutil
import socket
import subprocess
import tempfile
import time
from pathlib import Path

PATIENCE_S = 60
CONF = """ClusterName=dipper-test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,batch_sched_delay=0
ReturnToService=0
KillWait=5
MinJobAge=10
NodeName=n1 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1
NodeName=n2 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1
NodeName=n3 NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[3]} CPUs=2
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
PartitionName=wide Nodes=n3 MaxTime=INFINITE State=UP
"""


def free_ports(count):
    held = [socket.socket() for _ in range(count)]
    for s in held:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in held]
    for s in held:
        s.close()
    return ports


class Cluster:
    """Starts with a `with`, and ends with it."""

    def __init__(self):
        # A socket's path must be short, and every user may look through the folder.
        self.folder = Path(tempfile.mkdtemp(prefix="dipper-slurm-", dir="/tmp"))
        self.folder.chmod(0o755)
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self._daemons = []

    def __enter__(self):
        try:
            self._begin()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for daemon in reversed(self._daemons):
            daemon.terminate()
        for daemon in self._daemons:
            try:
                daemon.wait(timeout=10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def _begin(self):
        folder = self.folder
        (folder / "state").mkdir()
        (folder / "slurm.conf").write_text(CONF.format(host=socket.gethostname().split(".")[0], user=getpass.getuser(),
                                                       folder=folder, ports=free_ports(4)))
        key = folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o600)
        self._start("munged", "--foreground", "--force", f"--socket={folder}/munge.socket", f"--key-file={key}",
                    f"--pid-file={folder}/munge.pid", f"--log-file={folder}/munge.log",
                    f"--seed-file={folder}/munge.seed")
        self._wait(lambda: (folder / "munge.socket").exists())
        self._start("slurmctld", "-D", "-c")
        for node in ("n1", "n2", "n3"):
            self._start("slurmd", "-D", "-N", node)
        self._wait(lambda: self.ask("sinfo", "-h", "-N", "-o", "%t", check=False).split() == ["idle"] * 3)

    def _start(self, name, *words):
        program = shutil.which(name, path=f"{os.environ['PATH']}:/usr/sbin")
        with open(self.folder / f"{name}-{len(self._daemons)}.out", "w") as out:
            self._daemons.append(subprocess.Popen([program, *words], env=self.environment, stdout=out, stderr=out))

    def _wait(self, ready):
        until = time.monotonic() + PATIENCE_S
        while not ready():
            if time.monotonic() > until:
                logs = "\n".join(f"{f}:\n{f.read_text()[-2000:]}" for f in self.folder.glob("*.[lo]*") if f.is_file())
                raise RuntimeError(f"the test's Slurm does not start\n{logs}")
            time.sleep(0.1)

    def ask(self, *words, check=True):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, check=check).stdout

    def jobs(self):
        """(job id, state, node) of every task the queue knows as alive."""
        return [line.split("|") for line in self.ask("squeue", "-h", "-r", "-o", "%A|%T|%N").splitlines()]
