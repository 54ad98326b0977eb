#!/bin/bash
# A sweep of 10,000 cases on a real Slurm of this one machine: an array of 8 jobs, two of them killed and
# requeued. The merged table must be the serial one, bit for bit, and no finished case may run twice.
#
#   apt-get install slurm-wlm munge     # Debian 12 or later; as root
#   cargo build --release -p host-sim
#   tests/slurm/run.sh [target/release/host-sim]
#
# All files lie in a folder of its own, the daemons' configuration, keys and sockets among them; what runs
# already on this machine is not touched. The folder is kept where a comparison fails.
set -euo pipefail

here=$(cd "$(dirname "$0")" && pwd)
program=$(realpath "${1:-$here/../../target/release/host-sim}")
jobs=8
cores=$(nproc)
work=$(mktemp -d -t dbd-slurm.XXXXXX)
node=$(hostname -s)
pids=()

say() { printf '%7.1f s  %s\n' "$(echo "$(date +%s.%N) - $begun" | bc)" "$*"; }
fail() { echo "FAILED: $*; see $work" >&2; exit 1; }
end() {
    for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
    wait 2>/dev/null || true
}
trap end EXIT
begun=$(date +%s.%N)
for tool in munged slurmctld slurmd sbatch scontrol squeue bc; do
    command -v "$tool" >/dev/null || { echo "$tool is missing: apt-get install slurm-wlm munge bc" >&2; exit 2; }
done
[ "$(id -u)" = 0 ] || { echo "slurmd starts jobs as root only" >&2; exit 2; }
[ -x "$program" ] || { echo "$program is missing: cargo build --release -p host-sim" >&2; exit 2; }

# Daemons with files of their own.
mkdir "$work"/{munge,state,spool,log}
chmod 755 "$work"
dd if=/dev/urandom of="$work/munge/key" bs=1024 count=1 status=none
chmod 711 "$work/munge"
chmod 400 "$work/munge/key"
munged --foreground --force --key-file="$work/munge/key" --socket="$work/munge/socket" \
    --pid-file="$work/munge/pid" --seed-file="$work/munge/seed" --log-file="$work/munge/log" &
pids+=($!)
cat > "$work/slurm.conf" <<CONF
ClusterName=one
SlurmctldHost=$node
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
CredType=cred/munge
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/log/slurmctld
SlurmdLogFile=$work/log/slurmd
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
ReturnToService=2
SchedulerParameters=batch_sched_delay=1,sched_interval=2
NodeName=$node CPUs=$cores State=UNKNOWN
PartitionName=all Nodes=$node Default=YES MaxTime=INFINITE State=UP OverSubscribe=NO
CONF
export SLURM_CONF=$work/slurm.conf
sleep 1
slurmctld -D > "$work/log/slurmctld.out" 2>&1 &
pids+=($!)
slurmd -D -N "$node" > "$work/log/slurmd.out" 2>&1 &
pids+=($!)
for _ in $(seq 60); do
    sinfo -h -o %T 2>/dev/null | grep -q idle && break
    sleep 1
done
sinfo -h -o %T | grep -q idle || fail "the node does not come up"
say "Slurm $(sinfo --version | cut -d' ' -f2) is up with $cores cores"

# The serial table.
cp "$here/sweep.toml" "$work/sweep.toml"
cd "$work"
"$program" sweep sweep.toml --jobs 1 --out serial > serial.txt 2>&1 || fail "serial: $(cat serial.txt)"
say "serial: $(grep ^cases serial.txt)"

# The array.
cat > job.sh <<JOB
#!/bin/bash
echo "begun \$SLURM_ARRAY_TASK_ID restart \${SLURM_RESTART_COUNT:-0}"
exec "$program" sweep sweep.toml --shard \$SLURM_ARRAY_TASK_ID/$jobs --jobs 1 --out shared
JOB
array=$(sbatch --parsable --array=1-$jobs --requeue --open-mode=append --output='job-%a.txt' job.sh)
rows() { cat "shared/sweep/cases/$1-of-$jobs.rows" 2>/dev/null | wc -l; }
kept=()
# Of a share that is under way: some cases are finished, others are not.
wait_for() {
    for _ in $(seq 6000); do
        [ "$(rows "$1")" -ge 100 ] && return
        sleep 0.02
    done
    fail "share $1 does not begin"
}
requeue() {
    local job=${array}_$1
    for _ in $(seq 300); do
        scontrol requeue "$job" 2>/dev/null && break
        sleep 0.2
    done
    # Slurm waits a while by itself.
    scontrol update "jobid=$job" StartTime=now 2>/dev/null || true
}
wait_for 1
# Of this folder, whatever else runs here.
for pid in $(pgrep -f -- "sweep sweep.toml --shard 1/$jobs --jobs 1 --out shared"); do
    [ "$(readlink "/proc/$pid/cwd")" = "$work" ] && kill -9 "$pid"
done
kept[1]=$(rows 1)
cp "shared/sweep/cases/1-of-$jobs.rows" killed-1.rows
say "share 1 is killed by kill -9 with $(rows 1) cases finished"
wait_for 2
scancel --signal=KILL --full "${array}_2"
sleep 0.5
kept[2]=$(rows 2)
cp "shared/sweep/cases/2-of-$jobs.rows" killed-2.rows
say "share 2 is killed by scancel with $(rows 2) cases finished"
# No table before all is there.
"$program" sweep sweep.toml --merge --out shared > early.txt 2>&1 && fail "an incomplete merge was not refused"
say "merge is refused: $(grep -m1 '^error' early.txt)"
requeue 1
requeue 2
for _ in $(seq 600); do
    [ -z "$(squeue -h -j "$array" 2>/dev/null)" ] && break
    for share in 1 2; do scontrol update "jobid=${array}_$share" StartTime=now 2>/dev/null || true; done
    sleep 1
done
[ -z "$(squeue -h -j "$array" 2>/dev/null)" ] || fail "the jobs do not end: $(squeue)"
say "all jobs have ended"

"$program" sweep sweep.toml --merge --out shared > merged.txt 2>&1 || fail "merge: $(cat merged.txt)"
say "merged: $(grep ^cases merged.txt)"
cmp serial/sweep/sweep.csv shared/sweep/sweep.csv || fail "the tables differ"
cat shared/sweep/cases/*.rows | tr -d '\0' > all.rows
lines=$(wc -l < all.rows)
keys=$(cut -d' ' -f2 all.rows | sort -u | wc -l)
[ "$lines" = "$keys" ] || fail "$lines rows of $keys cases: some ran twice"
for share in 1 2; do
    # What was finished when a job was killed is there, once.
    head -n "$(wc -l < killed-$share.rows)" "shared/sweep/cases/$share-of-$jobs.rows" \
        | cmp - <(head -n "$(wc -l < killed-$share.rows)" killed-$share.rows) || fail "share $share lost rows"
done
echo
echo "| share | begun | finished when killed | run in all |"
echo "|---:|---:|---:|---:|"
for share in $(seq $jobs); do
    echo "| $share/$jobs | $(grep -c ^begun "job-$share.txt") | ${kept[$share]:-} | $(rows "$share") |"
done
echo
echo "$keys cases, $lines rows: no finished case ran twice"
echo "the merged table is the serial one, bit for bit: $(sha256sum < shared/sweep/sweep.csv | cut -c1-16), $(wc -c < shared/sweep/sweep.csv) bytes"
end
trap - EXIT
rm -rf "$work"
