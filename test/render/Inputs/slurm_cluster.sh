#!/bin/bash
# usage: slurm_cluster.sh FOLDER COMMAND...: runs COMMAND under a Slurm of this computer's own:
# slurmctld and two slurmd with one processor each, all on the loopback. Everything lies in
# FOLDER, which is made, and ends with COMMAND. The user that runs it is Slurm's user.
set -euo pipefail
Folder=$(realpath -m "$1")
shift
rm -rf "$Folder"
mkdir -p "$Folder"/{state,n1,n2}
# A socket's path has at most 107 characters.
Sockets=$(mktemp -d)
chmod 755 "$Sockets"
Pids=()
finish() {
  local Status=$?
  for Pid in "${Pids[@]}"; do kill "$Pid" 2> /dev/null || true; done
  wait
  rm -rf "$Sockets"
  exit "$Status"
}
trap finish EXIT
start() { # NAME COMMAND...
  "${@:2}" > "$Folder/$1.out" 2>&1 &
  Pids+=($!)
}

read -r Controller First Second < <(python3 -c '
import socket
open_ = [socket.socket() for _ in range(3)]
for s in open_: s.bind(("127.0.0.1", 0))
print(*(s.getsockname()[1] for s in open_))')
head -c 1024 /dev/urandom > "$Folder/key"
chmod 400 "$Folder/key"
cat > "$Folder/slurm.conf" << END
ClusterName=loopback
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$Controller
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$Sockets/munge
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
StateSaveLocation=$Folder/state
SlurmdSpoolDir=$Folder/%n
SlurmctldPidFile=$Folder/slurmctld.pid
SlurmdPidFile=$Folder/%n.pid
SlurmctldLogFile=$Folder/slurmctld.log
SlurmdLogFile=$Folder/%n.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
SchedulerParameters=batch_sched_delay=1,sched_interval=1
NodeName=n1 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$First CPUs=1
NodeName=n2 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$Second CPUs=1
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=10 State=UP
END
# A container has no cgroups, which versions from 23 on look for even where nothing uses them.
Version=$(PATH=$PATH:/usr/sbin slurmd -V | sed 's/[^0-9]*\([0-9]*\).*/\1/')
[ "$Version" -lt 23 ] || echo CgroupPlugin=disabled > "$Folder/cgroup.conf"
export PATH=$PATH:/usr/sbin SLURM_CONF=$Folder/slurm.conf
start munged munged --foreground --force --key-file="$Folder/key" --socket="$Sockets/munge" \
  --pid-file="$Sockets/munged.pid" --log-file="$Folder/munged.log" --seed-file="$Folder/munged.seed"
start slurmctld slurmctld -D -i
start n1 slurmd -D -N n1
start n2 slurmd -D -N n2
until [ "$(timeout 5 sinfo --noheader --states=idle --format=%D 2> /dev/null)" = 2 ]; do
  if [ $SECONDS -ge 120 ]; then
    tail -n 5 "$Folder"/*.out
    echo "slurm_cluster.sh: error: two nodes are not idle after two minutes" >&2
    exit 1
  fi
  sleep 0.2
done
sinfo --noheader --format='slurm: %D nodes, %t'
"$@"
