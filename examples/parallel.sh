#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Verifies frames in PARTS processes with GNU parallel, then joins what they found:
#   examples/parallel.sh PARTS FRAMES... [-- OPTIONS OF PARALLEL...]
# A part that something touches in exits with 1, which is no failure of the work. Run again, it does what is missing.
set -euo pipefail
[ $# -ge 2 ] || { echo "usage: $0 PARTS FRAMES... [-- OPTIONS OF PARALLEL...]" >&2; exit 3; }
parts=$1
shift
frames=()
while [ $# -gt 0 ] && [ "$1" != -- ]; do frames+=("$1"); shift; done
[ $# -gt 0 ] && shift
code=0
parallel "$@" noli verify "${frames[@]@Q}" --shard "{}/$parts" -o shards --threads 1 ::: $(seq "$parts") || code=$?
echo "parts that did not end with 0: $code" >&2
exec noli merge shards --json verdict.json --proof all.noli --force
