#!/bin/sh
# slurm_test.sh TAUT CHECKOUT: a real Slurm with two nodes on this host runs the manual's lines for it. While the array
# is at work one of the nodes is killed with everything on it. Frames and video are the bytes of a run on one machine.
# Takes minutes: Slurm notices the dead node after half a minute, and lets a requeued job wait for two.
set -eu
taut=$1
root=$2
. "$root/tests/farm/manual.sh"
[ "$(id -u)" -eq 0 ] || { echo "skipped: only root may run Slurm's nodes here"; exit 77; }
for tool in munged slurmctld slurmd sbatch setpriv; do
    command -v $tool >/dev/null || { echo "skipped: no $tool; tests/run.sh --long installs it"; exit 77; }
done
D=$(mktemp -d)
chmod 755 "$D"
started=
stop() {
    # shellcheck disable=SC2086,SC2046  # one word a process
    kill -9 $started $(on_node n1) $(on_node n2) 2>/dev/null || true
    rm -rf "$D"
}
trap stop EXIT
trap 'exit 1' INT TERM

# on_node NAME: the processes of jobs there, with the daemons that watch over them.
on_node() {
    for process in /proc/[0-9]*; do
        { tr '\0' '\n' <"$process/environ"; } >"$D/environ" 2>/dev/null || continue
        grep -qx "SLURMD_NODENAME=$1" "$D/environ" || continue
        grep -qx "SLURM_CONF=$D/slurm.conf" "$D/environ" || continue
        echo "${process#/proc/}"
        parent=$(awk '/^PPid:/ { print $2 }' "$process/status" 2>/dev/null) || continue
        if grep -qs slurmstepd "/proc/$parent/comm"; then echo "$parent"; fi
    done | sort -u
}

# Slurm with a key and folders of its own.
mkdir -p "$D/munge" "$D/run" "$D/log" "$D/state" "$D/spool.n1" "$D/spool.n2" "$D/farm" "$D/serial"
dd if=/dev/urandom of="$D/munge/key" bs=1 count=128 2>/dev/null
chmod 711 "$D/run" && chmod 700 "$D/munge" && chmod 400 "$D/munge/key"
chown -R munge "$D/munge" "$D/run"
host=$(hostname -s)
port=$((20000 + $$ % 10000 * 3))
cat >"$D/slurm.conf" <<END
ClusterName=taut
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$D/run/munge.socket
CredType=cred/munge
SlurmctldPort=$port
SlurmctldPidFile=$D/run/slurmctld.pid
SlurmdPidFile=$D/run/slurmd.%n.pid
SlurmdSpoolDir=$D/spool.%n
StateSaveLocation=$D/state
SlurmctldLogFile=$D/log/slurmctld.log
SlurmdLogFile=$D/log/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
SlurmdTimeout=10
JobRequeue=1
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 RealMemory=1000 State=UNKNOWN
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=1000 State=UNKNOWN
PartitionName=farm Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF="$D/slurm.conf"
setpriv --reuid munge --regid munge --clear-groups munged -F --key-file="$D/munge/key" --socket="$D/run/munge.socket" \
    --pid-file="$D/munge/pid" --log-file="$D/munge/log" --seed-file="$D/munge/seed" >"$D/log/munged.out" 2>&1 &
started="$started $!"
sleep 1
slurmctld -D -c -f "$SLURM_CONF" >"$D/log/slurmctld.out" 2>&1 &
started="$started $!"
slurmd -D -N n1 -f "$SLURM_CONF" >"$D/log/n1.out" 2>&1 &
started="$started $!"
slurmd -D -N n2 -f "$SLURM_CONF" >"$D/log/n2.out" 2>&1 &
n2=$!
started="$started $n2"
# until SECONDS COMMAND...: waits for it to succeed; says what Slurm said where it does not.
until_true() {
    left=$(($1 * 5))
    shift
    while ! "$@"; do
        left=$((left - 1))
        if [ "$left" -eq 0 ]; then
            echo "in vain: $*"
            squeue || true
            tail -n 20 "$D"/log/* "$D"/farm/slurm-*.out 2>/dev/null
            exit 1
        fi
        sleep 0.2
    done
}
are_idle() { [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = 2 ]; }
until_true 30 are_idle

# The manual's lines, word for word.
manual_block 1 >"$D/lines"
[ -s "$D/lines" ] || { echo "no lines for Slurm in the manual"; exit 1; }
PATH="$(dirname "$taut"):$PATH"
export PATH
(cd "$D/farm" && sh -eu "$D/lines")

# In the middle of the array, with a part of its frames drawn, n2 dies.
is_at_work() { [ "$(frames_in "$D/farm/out/show")" -ge 20 ] && [ "$(on_node n2)" ]; }
until_true 120 is_at_work
# shellcheck disable=SC2046  # one word a process
kill -9 "$n2" $(on_node n2)
echo "n2 was killed when $(frames_in "$D/farm/out/show") frames were there"

serial "$D/serial"
is_done() { [ -z "$(squeue -h -o %i)" ]; }
until_true 600 is_done
grep -q "Requeue\|requeue" "$D/log/slurmctld.log" || { echo "no shard was requeued"; exit 1; }
[ -s "$D/farm/show.mp4" ] || { tail -n 20 "$D"/farm/slurm-*.out; exit 1; }
same "$D/serial" "$D/farm"
