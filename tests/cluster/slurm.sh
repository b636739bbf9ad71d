#!/usr/bin/env bash
# A sweep as a Slurm job array: the table is that of one run, byte for byte.
#   tests/cluster/slurm.sh PROGRAM [SWEEP]         needs: slurm-wlm and munge (Debian), root
# Starts a cluster of one node with its own configuration, keys, sockets and ports in a temporary folder, and stops
# it again. On a real cluster `by_slurm.sh` beside this file is all that is needed.
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
program="$(realpath "$1")"
sweep="$(realpath "${2:-$here/tiny.toml}")"
folder="$(mktemp -d)"
pids=()
clean() {
    for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
    sleep 1
    rm -rf "$folder"
}
trap clean EXIT
chmod 755 "$folder"
cd "$folder"
mkdir -p spool state munge
host="$(hostname -s)"
port=$((30000 + RANDOM % 10000))

dd if=/dev/urandom of=munge/key bs=1 count=1024 status=none
chmod 400 munge/key
/usr/sbin/munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
    --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" \
    >munge/out 2>&1 &
pids+=($!)
cores="$(nproc)"
cat >slurm.conf <<END
ClusterName=asperity
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
CredType=cred/munge
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmctldLogFile=$folder/slurmctld.log
SlurmdLogFile=$folder/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cores State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF="$folder/slurm.conf"
for _ in $(seq 50); do [ -S munge/socket ] && break; sleep 0.1; done
/usr/sbin/slurmctld -D -f slurm.conf >slurmctld.out 2>&1 &
pids+=($!)
/usr/sbin/slurmd -D -f slurm.conf -N "$host" >slurmd.out 2>&1 &
pids+=($!)
for _ in $(seq 200); do
    sinfo -h -o %T 2>/dev/null | grep -q idle && break
    sleep 0.2
done
sinfo || { tail -n 20 slurmctld.log slurmd.log slurmctld.out slurmd.out munge/out; exit 1; }

"$program" sweep "$sweep" --out single --threads 1 >/dev/null
echo "single run: $(($(wc -l <single/table.csv) - 1)) cases"
"$here/by_slurm.sh" "$program" "$sweep" "$folder/chains" >/dev/null
cmp chains/table.csv single/table.csv && echo "same: a task for each chain, collected"
