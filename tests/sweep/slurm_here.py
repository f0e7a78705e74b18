"""Slurm with controller and node on this machine, in a folder of its own and on ports of its own, without accounts and
without the system's Slurm: Debian's slurm-wlm is enough (scripts/setup --schedulers)."""

import getpass
import os
import shutil
import socket
import subprocess
import time

PROGRAMS = ("sbatch", "scancel", "squeue", "sinfo", "slurmctld", "slurmd")
PATH = os.pathsep.join((os.environ.get("PATH", ""), "/usr/sbin", "/sbin"))
PATIENCE = 120  # s, for the daemons to be ready

CONFIGURATION = """ClusterName=railwave
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
AuthType=auth/none
CredType=cred/none
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
SchedulerType=sched/backfill
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} State=UNKNOWN
PartitionName=here Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def installed():
    return all(shutil.which(program, path=PATH) for program in PROGRAMS)


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Slurm:
    """`environment` is for those that call sbatch."""

    def __init__(self, folder, processors=2):
        self.folder = folder
        host = socket.gethostname().split(".")[0]
        controller, node = free_ports(2)
        for name in ("state", "spool"):
            (folder / name).mkdir(parents=True)
        configuration = folder / "slurm.conf"
        configuration.write_text(
            CONFIGURATION.format(
                host=host, controller=controller, node=node, user=getpass.getuser(), folder=folder,
                processors=processors,
            )
        )
        self.environment = dict(os.environ, PATH=PATH, SLURM_CONF=str(configuration))
        self.daemons = []
        try:
            self._start("slurmctld", "-D", "-i")
            self._start("slurmd", "-D", "-N", host)
            self._wait(lambda: self._says("sinfo", "--noheader", "--format=%T") == "idle", "the node is not ready")
        except BaseException:
            self.stop()
            raise

    def _start(self, *command):
        with open(self.folder / f"{command[0]}.out", "w", encoding="utf-8") as out:
            self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=out, stderr=out))

    def _says(self, *command):
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True, check=False)
        return done.stdout.strip()

    def _wait(self, ready, what, patience=PATIENCE):
        end = time.monotonic() + patience
        while not ready():
            if time.monotonic() > end or any(daemon.poll() is not None for daemon in self.daemons):
                logs = "\n".join(path.read_text() for path in self.folder.glob("*.log"))
                outs = "\n".join(path.read_text() for path in self.folder.glob("*.out"))
                raise RuntimeError(f"Slurm: {what}\n{logs}\n{outs}")
            time.sleep(0.2)

    def wait_for_jobs(self, patience):
        self._wait(lambda: self._says("squeue", "--noheader") == "", "jobs have not ended", patience)

    def stop(self):
        if self._says("squeue", "--noheader"):  # a test failed: its jobs go too
            self._says("scancel", "--me", "--signal=KILL", "--full")
            self._says("scancel", "--me")
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in reversed(self.daemons):
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
