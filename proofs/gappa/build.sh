#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compiles the proofs about the floating-point filters from nothing, in a temporary folder, and compares what
# they say and rest on with assumptions.txt. Exits 0 only if all is as it should be.
#   proofs/gappa/build.sh            compile and compare
#   proofs/gappa/build.sh --renew    compile, and write assumptions.txt anew
# Needs coqc 8.16, gappa, and the Coq libraries Flocq and Gappa.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=proofs/formal.sh
. "$here/../formal.sh"

compile NoliGappa

# What the theorems say and rest on: of all that is called Theorem.
{
  echo 'Require Import Reals.'
  echo 'From NoliGappa Require Import Constants Rounding Formulas Differences.'
  echo 'Open Scope R_scope. Set Printing Width 110.'
  for theory in "${theories[@]}"; do
    module=${theory%.v}
    echo "From NoliGappa Require $module."
    sed -nE 's/^Theorem ([A-Za-z0-9_]+).*/\1/p' "$theory" | while read -r theorem; do
      echo "Check $module.$theorem."
      echo "Print Assumptions $module.$theorem."
    done
  done
} | ask NoliGappa

keep assumptions.txt "the theorems, or what they rest on, differ from assumptions.txt"
echo "all bounds hold"
