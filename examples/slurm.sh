#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Verifies frames with a job array of Slurm, and joins what its tasks found when all of them have ended:
#   examples/slurm.sh PARTS FRAMES...
# Submitted again, for a job whose time was up, it does what is missing.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 PARTS FRAMES..." >&2; exit 3; }
parts=$1
shift
frames=("$@")
part=$(sbatch --parsable --job-name noli --array "1-$parts" --cpus-per-task 2 --wrap \
  "noli verify ${frames[*]@Q} --shard \$SLURM_ARRAY_TASK_ID/$parts -o shards --threads \$SLURM_CPUS_PER_TASK")
# A part in which something touches exits with 1, so the last job does not wait for success.
sbatch --parsable --job-name noli-merge --dependency "afterany:$part" --wrap \
  "noli merge shards --json verdict.json --proof all.noli --force"
