#!/bin/bash
# The scripts of `launchsafe emit slurm` on a real Slurm: this machine is its only node, and it listens on the loopback
# only. A sweep in three shards, one with tasks that are interrupted and queued again, one with a cancelled task that is
# submitted twice, and one of 2 000 cases in 20 tasks of which some are killed, with their node too, must each leave the
# report that one plain `launchsafe study` writes, byte for byte. A job that takes more memory than it asked for is
# killed by Slurm.
#
#     tests/app/slurm.sh build/release/launchsafe
#
# Everything happens in a temporary folder; every server that is started is ended by its process number. Ends with 77
# where there is no Slurm to start.
set -euo pipefail
shopt -s nullglob

readonly skipped=77
program=$(realpath "$1")
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
  tail -n 40 "$folder"/*/*/slurm/*.log "$folder"/*.log || true
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
JobAcctGatherType=jobacct_gather/linux
JobAcctGatherFrequency=1
JobAcctGatherParams=OverMemoryKill
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
input_uncertainty = { value = "2 K", because = "for a test" }
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
  "$program" study "$folder/$1/sweep.toml" -o "$folder/$1/plain" --quiet >"$folder/$1/plain.log" 2>&1 || code=$?
  ((code == 0 || code == 4)) || fail "the plain study ended with $code: $(cat "$folder/$1/plain.log")"
}

emit() {
  say "emit"
  "$program" emit slurm "$folder/$1/sweep.toml" -o "$folder/$1/out" --shards "${2:-3}" --jobs 1 \
    --sbatch=--comment="of slurm.sh" || fail "emit ended with $?"
}

# Sets shards and merge to the job numbers.
submit() {
  local text
  text=$(sh "$folder/$1/out/slurm/submit.sh") || fail "submit.sh ended with $?"
  say "submit.sh: $text"
  shards=$(sed -n 's/.* as job \([0-9]*\), the merge as job .*/\1/p' <<<"$text")
  merge=$(sed -n 's/.* the merge as job \([0-9]*\).*/\1/p' <<<"$text")
  [[ -n $shards && -n $merge ]] || fail "submit.sh names no jobs"
}

finish() {
  squeue --format="%.8i %.28j %.10T %r" | head -n 8
  wait_until "${1:-60}" "the end of all jobs" no_jobs
}

exit_code_of() { scontrol --oneliner show job "$1" | sed -n 's/.* ExitCode=\([0-9]*\):.*/\1/p' | sort -u; }

expect_equal_reports() {
  diff --recursive --brief --exclude=manifest.json --exclude='journal*' --exclude='study*.db' --exclude='status*' \
    --exclude=slurm "$folder/$1/plain" "$folder/$1/out" || fail "the reports differ"
  say "$(find "$folder/$1/plain" -type f | wc -l) files of the plain study, equal ones from the cluster"
}

log_of_task() { echo "$folder/$1/out/slurm/launchsafe-sweep-$2.log"; }
has_stored() { grep --quiet '"runs_stored": [1-9]' "$folder/$1/out/status.$2-of-3.json"; }
expect_line() { grep --quiet --fixed-strings "$2" "$1" || fail "$1 does not say: $2"; }

# --- what is tested ---

test_shards_and_merge() {
  say "three shards, then the merge"
  write_study "$folder/a study" "0.05 ms" "5 mm"
  run_plainly "a study"
  emit "a study"
  submit "a study"
  finish
  [[ $(exit_code_of "$shards") == 0 ]] || fail "a shard ended with $(exit_code_of "$shards")"
  expect_equal_reports "a study"
}

# As Slurm does when the time is nearly up, and as a person may who wants the task elsewhere.
test_interrupted_tasks_are_queued_again() {
  say "interrupted tasks"
  write_study "$folder/long" "$long_duration" "$long_cell"
  run_plainly long
  emit long
  submit long
  wait_until 30 "the first case of shard 1" has_stored long 1
  scancel --batch --signal=USR1 "${shards}_1"
  wait_until 30 "the first case of shard 2" has_stored long 2
  scancel --full --signal=TERM "${shards}_2"
  finish
  for task in 1 2; do
    expect_line "$(log_of_task long $task)" "interrupted; queued again"
    expect_line "$(log_of_task long $task)" "start 2"
  done
  [[ $(exit_code_of "$shards") == 0 ]] || fail "a shard ended with $(exit_code_of "$shards")"
  expect_equal_reports long
}

test_a_cancelled_task_stays_cancelled() {
  say "a cancelled task"
  cp "$folder/long/shell.toml" "$folder/long/sweep.toml" "$folder/cancelled/"
  cp -r "$folder/long/plain" "$folder/cancelled/"
  emit cancelled
  submit cancelled
  wait_until 30 "the first case of shard 3" has_stored cancelled 3
  scancel "${shards}_3"
  finish
  expect_line "$(log_of_task cancelled 3)" "interrupted, and not queued again"
  [[ $(exit_code_of "$merge") == 3 ]] || fail "the merge ended with $(exit_code_of "$merge")"
  expect_line "$folder/cancelled/out/slurm/launchsafe-sweep-merge.log" "missing: "
  [[ ! -e $folder/cancelled/out/report.md ]] || fail "there is a report of what is not there"
  submit cancelled
  finish
  expect_equal_reports cancelled
}

# random_task: one that runs, or nothing.
random_task() {
  local tasks
  mapfile -t tasks < <(squeue --noheader --states=RUNNING --jobs="$shards" --format=%K)
  ((${#tasks[@]} == 0)) || echo "${tasks[RANDOM % ${#tasks[@]}]}"
}
a_task_runs() { [[ -n $(random_task) ]]; }
processes_with() { pgrep --full -- "$1" || true; }  # a part of their command line
kill_processes() { [[ -z $1 ]] || kill -KILL $1 2>/dev/null || true; }

# The node's daemon and all that it started die at once; the node comes back empty, once its port is free.
kill_node() {
  local scripts
  mapfile -t scripts < <(processes_with "$folder/spool/job")
  kill_processes "${servers[-1]} $(ps --no-headers -o ppid= "${scripts[@]}") ${scripts[*]} $(processes_with "$folder/many/out")"
  wait "${servers[-1]}" 2>/dev/null || true
  unset 'servers[-1]'
  scontrol update NodeName=localhost State=DOWN Reason="it does not answer"  # as after SlurmdTimeout
  wait_until 120 "the node's return" restart_node
}

restart_node() {
  start slurmd slurmd -D -N localhost
  sleep 2
  kill -0 "${servers[-1]}" || { unset 'servers[-1]' && false; }
}

kill_at_random() {
  local kill task
  RANDOM=33
  for kill in {1..9}; do
    sleep "0.$((RANDOM % 9 + 1))"
    task=$(random_task)
    [[ -n $task ]] || continue
    if ((kill == 5)); then
      say "the node of task $task dies"
      kill_node
    elif ((kill % 2 == 0)); then
      say "the job of task $task is killed"
      scancel --full --signal=KILL "${shards}_$task" || true
    else
      say "the process of task $task is killed"
      kill_processes "$(processes_with "$folder/many/out --shard $task/20 ")"
    fi
  done
}

test_killed_tasks_of_many() {
  say "2 000 cases in 20 tasks, killed at random"
  write_study "$folder/many" "0.2 ms" "5 mm"
  sed -i "s/^values = .*/values = \"$(seq --separator=", " 31 130) MPa\"/" "$folder/many/sweep.toml"
  printf '[[vary]]\nkey = "crack_radius"\nvalues = "%s um"\n' "$(seq --separator=", " 10 29)" >>"$folder/many/sweep.toml"
  run_plainly many
  say "the plain study is there after $SECONDS s"
  emit many 20
  submit many
  wait_until 30 "the first tasks" a_task_runs
  kill_at_random
  finish 240
  expect_line "$folder/many/out/slurm/launchsafe-sweep-merge.log" "missing: "
  submit many
  finish 240
  [[ $(exit_code_of "$shards") == 0 ]] || fail "a shard ended with $(exit_code_of "$shards")"
  say "starts of tasks: $(cat "$folder"/many/out/slurm/launchsafe-sweep-[0-9]*.log | grep --count '^task ')"
  expect_equal_reports many
}

readonly long_duration="12 ms" long_cell="1.25 mm"

PATH=$PATH:/usr/sbin:/sbin
((EUID == 0)) || skip "only root can start Slurm's servers"
for needed in munged slurmctld slurmd sbatch squeue scancel scontrol sinfo pgrep; do
  command -v "$needed" >/dev/null || skip "$needed is not there; Debian: slurm-wlm, munge"
done
unset "${!SLURM@}" "${!SBATCH@}"
trap clean_up EXIT
trap 'exit 130' INT TERM HUP
folder=$(mktemp -d)
chmod 711 "$folder"  # munge wants its socket's folder to be open to all
mkdir "$folder/cancelled"
start_slurm
say "$(slurmctld -V) after $SECONDS s"
test_shards_and_merge
say "after $SECONDS s"
test_interrupted_tasks_are_queued_again
say "after $SECONDS s"
test_a_cancelled_task_stays_cancelled
say "after $SECONDS s"
test_killed_tasks_of_many
say "all done after $SECONDS s"
