# A Slurm on this machine alone, for one test. Usage: . slurm_lib.sh, after lib.sh.

for program in munged slurmctld slurmd; do
  if [ "$(id -u)" -ne 0 ] || ! PATH=$PATH:/usr/sbin command -v "$program" >/dev/null; then
    echo "$program is not installed, or this is not root"
    exit 77
  fi
done
PATH=$PATH:/usr/sbin
slurm=$(mktemp -d) # a short path: that of a socket may have 107 characters
export SLURM_CONF=$slurm/slurm.conf
trap 'slurmDown; chmod -R u+w "$workFolder"; rm -rf "$workFolder" "$logs" "$slurm"' EXIT

slurmdUp() { slurmd -N "$1" -f "$SLURM_CONF"; }

# slurmUp: a key, a controller and two nodes with one core each; ready when both are idle.
slurmUp() {
  mkdir "$slurm/state"
  head -c 1024 /dev/urandom >"$slurm/munge.key" && chmod 400 "$slurm/munge.key"
  munged --force --key-file="$slurm/munge.key" --socket="$slurm/munge.socket" --pid-file="$slurm/munged.pid" \
    --log-file="$slurm/munged.log" --seed-file="$slurm/munge.seed" 2>"$slurm/munged.err"
  cat >"$SLURM_CONF" <<CONF
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmctldPort=26817
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$slurm/munge.socket
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool-%n
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd-%n.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
ReturnToService=2
SlurmdTimeout=30
SchedulerParameters=sched_interval=2,batch_sched_delay=1
NodeName=n1 NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=26818 CPUs=1 RealMemory=4000
NodeName=n2 NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=26819 CPUs=1 RealMemory=4000
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
  slurmctld -f "$SLURM_CONF"
  slurmdUp n1
  slurmdUp n2
  for _ in $(seq 100); do
    [ "$(sinfo -h -N -t idle -o %N 2>/dev/null | sort -u | wc -l)" -eq 2 ] && return
    sleep 0.2
  done
  tail -n 5 "$slurm"/*.log
}

slurmDown() {
  scancel --me 2>/dev/null
  for daemon in slurmd-n1 slurmd-n2 slurmctld munged; do
    [ -s "$slurm/$daemon.pid" ] && kill -9 "$(cat "$slurm/$daemon.pid")" 2>/dev/null
  done
}

# reached N: waits until N jobs are finished.
reached() {
  for _ in $(seq 1500); do
    [ "$(grep -c '^Finished job' "$logs/first")" -ge "$1" ] && return
    sleep 0.2
  done
  fail "in five minutes there were not $1 finished jobs: $(tail -n 3 "$logs/first")"
}

# finishedOnes: every stage that ended well, and when its record was written.
finishedOnes() { (cd study/logs && grep -l -E '"exit": (0|7),' */*.exit | LC_ALL=C sort | xargs -d '\n' stat -c '%n %y'); }
