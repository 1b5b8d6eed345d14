#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Verifies frames in PARTS processes with GNU parallel, then joins what they found:
#   examples/parallel.sh PARTS FRAMES... [OPTIONS OF VERIFY...] [-- OPTIONS OF PARALLEL...]
# Writes the folder `shards`, verdict.json and all.noli here. Run again, it does what is missing.
set -euo pipefail
[[ $# -ge 2 && $1 =~ ^[1-9][0-9]*$ ]] || { echo "usage: $0 PARTS FRAMES... [-- OPTIONS OF PARALLEL...]" >&2; exit 3; }
parts=$1
shift
asked=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do asked+=("$1"); shift; done
[ $# -gt 0 ] && shift
# A part in which something touches exits with 1, which is no failure of the work.
export PARALLEL_SHELL=/bin/bash
seq "$parts" | parallel "$@" -I @PART@ "noli verify ${asked[*]@Q} --shard @PART@/$parts -o shards --threads 1 || [ \$? -eq 1 ]" ||
  { echo "$0: not all parts were done; there is no verdict" >&2; exit 2; }
exec noli merge shards --json verdict.json --proof all.noli --force
