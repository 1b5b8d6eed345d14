#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Verifies frames with a job array of Slurm, and joins what its tasks found when all of them are done:
#   examples/slurm.sh PARTS FRAMES... [OPTIONS OF VERIFY...]
# Writes the folder `shards`, verdict.json and all.noli here. Submitted again, for a job whose time was up, it does what is missing.
set -euo pipefail
[[ $# -ge 2 && $1 =~ ^[1-9][0-9]*$ ]] || { echo "usage: $0 PARTS FRAMES..." >&2; exit 3; }
parts=$1
shift
asked=("$@")
# A part in which something touches exits with 1, which is no failure of the work.
array=$(sbatch --parsable --job-name noli --array "1-$parts" --cpus-per-task 2 <<END
#!/bin/bash
noli verify ${asked[*]@Q} --shard \$SLURM_ARRAY_TASK_ID/$parts -o shards --threads \$SLURM_CPUS_PER_TASK || [ \$? -eq 1 ]
END
)
sbatch --parsable --job-name noli-merge --dependency "afterok:$array" <<'END'
#!/bin/bash
exec noli merge shards --json verdict.json --proof all.noli --force
END
