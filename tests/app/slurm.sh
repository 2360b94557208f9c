#!/bin/bash
# The batch files of studies/slurm on a real Slurm: this machine is its only node, and it listens on the loopback only.
# A sweep in three shards, one with tasks that are interrupted and queued again, and one with a cancelled task that is
# submitted twice must each leave the report that one plain `launchsafe study` writes, byte for byte.
#
#     tests/app/slurm.sh build/release/launchsafe studies/slurm
#
# Everything happens in a temporary folder; every server that is started is ended by its process number. Ends with 77
# where there is no Slurm to start.
set -euo pipefail
shopt -s nullglob

readonly skipped=77
program=$(realpath "$1")
batch_files=$(realpath "$2")
folder=
servers=()  # process numbers, in the order of their start

say() { printf '%s\n' "== $*"; }

skip() {
  say "skipped: $*"
  exit "$skipped"
}

fail() {
  say "failed: $*"
  squeue || true
  tail -n 40 "$folder"/*/*.out "$folder"/*.log || true
  exit 1
}

# wait_until SECONDS WHAT COMMAND...: fails when the command does not succeed in time.
wait_until() {
  local seconds=$1 what=$2
  local end=$((SECONDS + seconds))
  shift 2
  until "$@" 2>/dev/null; do
    ((SECONDS < end)) || fail "$what: not within $seconds s"
    sleep 0.1
  done
}

# --- the servers ---

free_port() {
  local port
  while true; do
    port=$((20000 + RANDOM % 12000))
    if ! (: <>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; then
      echo "$port"
      return
    fi
  done
}

# start NAME COMMAND...
start() {
  local name=$1
  shift
  "$@" >"$folder/$name.log" 2>&1 &
  servers+=($!)
}

write_configuration() {
  local controller_port node_port
  controller_port=$(free_port)
  while node_port=$(free_port) && [[ $node_port == "$controller_port" ]]; do :; done
  cat >"$folder/slurm.conf" <<END
ClusterName=launchsafe-test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$controller_port
SlurmdPort=$node_port
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
# A task that is queued again waits until its credential has expired.
AuthInfo=socket=$folder/munge.socket,cred_expire=5
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
SchedulerType=sched/builtin
SchedulerParameters=sched_interval=1,sched_min_interval=0,batch_sched_delay=0
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SlurmdParameters=config_overrides
KillWait=5
NodeName=localhost NodeAddr=127.0.0.1 CPUs=3 RealMemory=4000
PartitionName=all Nodes=ALL Default=YES State=UP
END
}

node_is_idle() { [[ $(sinfo --noheader --format=%T) == idle ]]; }

start_slurm() {
  mkdir "$folder/state" "$folder/spool"
  (umask 077 && head -c 1024 /dev/urandom >"$folder/munge.key")
  write_configuration
  export SLURM_CONF=$folder/slurm.conf
  start munged munged --force --foreground --key-file="$folder/munge.key" --socket="$folder/munge.socket" \
    --pid-file="$folder/munge.pid" --log-file="$folder/munge.log" --seed-file="$folder/munge.seed"
  wait_until 10 "munge" test -S "$folder/munge.socket"
  start slurmctld slurmctld -D
  start slurmd slurmd -D -N localhost
  wait_until 20 "Slurm's start" node_is_idle
}

no_jobs() { [[ -z $(squeue --noheader) ]]; }

# Jobs first: they would outlive their servers.
stop_slurm() {
  local end=$((SECONDS + 10)) i
  scancel --user=root 2>/dev/null || true
  until no_jobs 2>/dev/null || ((SECONDS >= end)); do sleep 0.2; done
  for ((i = ${#servers[@]} - 1; i >= 0; --i)); do
    kill "${servers[i]}" 2>/dev/null || true
    wait "${servers[i]}" 2>/dev/null || true
  done
}

clean_up() {
  [[ -n $folder ]] || return 0
  [[ ${#servers[@]} -eq 0 ]] || stop_slurm
  rm -rf "$folder"
}

# --- the study ---

# write_study FOLDER DURATION CELL: a sweep of six mechanical runs on a small shell.
write_study() {
  mkdir -p "$1"
  cat >"$1/shell.toml" <<END
title = "a small shell"
body = [
  { name = "cup",     material = "steel",  x = "0 to 1 cm", r = "0 to 2 cm" },
  { name = "filling", material = "charge", x = "1 to 4 cm", r = "0 to 1.5 cm" },
  { name = "wall",    material = "steel",  x = "1 to 4 cm", r = "1.5 to 2 cm" },
  { name = "base",    material = "steel",  x = "4 to 5 cm", r = "0 to 2 cm" },
]
observation_point = [ { name = "G1", x = "3.9 cm", r = "1 cm" } ]

[load]
duration = "$2"
base = "0 Pa"
peak = "50 MPa"
peak_time = "$2"
exponent = 3
shape = "power-exponential"

[gap]
thickness = "0, 0.01 cm"

[numerics]
cell_size = "$3"
energy_drift_limit = 0.5

[output]
trace_interval = "5 us"
END
  cat >"$1/sweep.toml" <<END
kind = "critical-gap"
scene = "shell.toml"
early_time = "0.03 ms"
uncertainty.peak_pressure = "0 %"
numerics = { value = "2 K", because = "two meshes of it" }
gaps = "0, 0.01 cm"
confirm = false

[[vary]]
key = "peak_pressure"
values = "30, 40, 50, 60, 70, 80, 90 MPa"   # more than are told in detail, with times of their own
END
}

# Into $folder/NAME/plain.
run_plainly() {
  local code=0
  launchsafe study "$folder/$1/sweep.toml" -o "$folder/$1/plain" --quiet >"$folder/$1/plain.log" 2>&1 || code=$?
  ((code == 0 || code == 4)) || fail "the plain study ended with $code: $(cat "$folder/$1/plain.log")"
}

# Sets shards and merge to the job numbers.
submit() {
  local text
  cp "$batch_files/merge.sbatch" "$folder/$1/"
  sed -e 's/^shards=[0-9]*/shards=3/' -e 's/^cores=[0-9]*/cores=1/' -e 's/^memory=[0-9]*/memory=1/' \
    "$batch_files/shards.sbatch" >"$folder/$1/shards.sbatch"
  text=$(cd "$folder/$1" && sh shards.sbatch sweep.toml out) || fail "shards.sbatch ended with $?"
  say "shards.sbatch: $text"
  shards=$(sed -n 's/^shards: job \([0-9]*\)$/\1/p' <<<"$text")
  merge=$(sed -n 's/^Submitted batch job \([0-9]*\)$/\1/p' <<<"$text")
  [[ -n $shards && -n $merge ]] || fail "shards.sbatch names no jobs"
}

finish() {
  squeue --format="%.8i %.28j %.10T %r" | head -n 8
  wait_until 60 "the end of all jobs" no_jobs
}

exit_code_of() { scontrol --oneliner show job "$1" | sed -n 's/.* ExitCode=\([0-9]*\):.*/\1/p' | sort -u; }

expect_equal_reports() {
  diff --recursive --brief --exclude=manifest.json --exclude=study.db --exclude=study.lock \
    "$folder/$1/plain" "$folder/$1/out" || fail "the reports differ"
  say "$(find "$folder/$1/plain" -type f | wc -l) files of the plain study, equal ones from the cluster"
}

log_of_task() { echo "$folder/$1/slurm-${shards}_$2.out"; }
has_stored() { compgen -G "$folder/$1/out-shard-$2/cases/*.h5" >/dev/null; }

# --- what is tested ---

test_shards_and_merge() {
  say "three shards, then the merge"
  write_study "$folder/a study" "0.05 ms" "5 mm"
  run_plainly "a study"
  submit "a study"
  finish
  [[ $(exit_code_of "$shards") == 0 ]] || fail "a shard ended with $(exit_code_of "$shards")"
  expect_equal_reports "a study"
}

# As Slurm does when the time is nearly up.
test_interrupted_tasks_are_queued_again() {
  say "interrupted tasks"
  write_study "$folder/long" "12 ms" "1.25 mm"
  run_plainly long
  submit long
  for task in 1 2; do
    wait_until 30 "the first case of shard $task" has_stored long $task
    scancel --batch --signal=USR1 "${shards}_$task"
  done
  finish
  for task in 1 2; do
    grep --quiet "interrupted" "$(log_of_task long $task)" || fail "task $task was not interrupted"
  done
  [[ $(exit_code_of "$shards") == 0 ]] || fail "a shard ended with $(exit_code_of "$shards")"
  expect_equal_reports long
}

test_a_cancelled_task_stays_cancelled() {
  say "a cancelled task"
  cp "$folder/long/shell.toml" "$folder/long/sweep.toml" "$folder/cancelled/"
  cp -r "$folder/long/plain" "$folder/cancelled/"
  submit cancelled
  wait_until 30 "the first case of shard 3" has_stored cancelled 3
  scancel "${shards}_3"
  finish
  [[ $(exit_code_of "$merge") == 3 ]] || fail "the merge ended with $(exit_code_of "$merge")"
  grep --quiet "^missing: " "$folder/cancelled/slurm-$merge.out" || fail "the merge names no missing run"
  [[ ! -e $folder/cancelled/out/report.md ]] || fail "there is a report of what is not there"
  submit cancelled
  finish
  expect_equal_reports cancelled
}

PATH=$PATH:/usr/sbin:/sbin
((EUID == 0)) || skip "only root can start Slurm's servers"
for needed in munged slurmctld slurmd sbatch squeue scancel scontrol sinfo; do
  command -v "$needed" >/dev/null || skip "$needed is not there; Debian: slurm-wlm, munge"
done
unset "${!SLURM@}" "${!SBATCH@}"
trap clean_up EXIT
trap 'exit 130' INT TERM HUP
folder=$(mktemp -d)
chmod 711 "$folder"  # munge wants its socket's folder to be open to all
mkdir "$folder/cancelled" "$folder/bin"
ln -s "$program" "$folder/bin/launchsafe"
PATH=$folder/bin:$PATH
start_slurm
say "$(slurmctld -V) after $SECONDS s"
test_shards_and_merge
say "after $SECONDS s"
test_interrupted_tasks_are_queued_again
say "after $SECONDS s"
test_a_cancelled_task_stays_cancelled
say "all done after $SECONDS s"
