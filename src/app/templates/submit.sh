#!/bin/sh
# Submits a launchsafe study to Slurm: its shards (shard.sbatch) and, behind them, the merge (merge.sbatch). Prints
# both job numbers. May be run again when both have ended: only what is missing is computed.

folder={{folder}}

set -eu
fail() {
  echo "submit.sh: $1" >&2
  exit 70
}
command -v sbatch >/dev/null || fail "sbatch is not there; run this on a machine from which Slurm jobs are submitted"

shards=$(sbatch --parsable "$folder/shard.sbatch") || fail "Slurm took no job"
shards=${shards%%;*}  # "ID;CLUSTER" where there are several clusters
merge=$(sbatch --parsable --dependency="afterany:$shards" "$folder/merge.sbatch") ||
  fail "Slurm took the shards (job $shards) but not the merge; when they have ended: sbatch '$folder/merge.sbatch'"
merge=${merge%%;*}
echo "submitted: {{shards|counted shard}} as job $shards, the merge as job $merge"
echo "to watch: launchsafe status "{{output}}"; squeue --jobs=$shards,$merge; logs in $folder"
