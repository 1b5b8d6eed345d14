#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compiles the proofs about the floating-point filters from nothing, in a temporary folder, and compares what
# they say and rest on with assumptions.txt. Exits 0 only if all is as it should be.
#   proofs/gappa/build.sh            compile and compare
#   proofs/gappa/build.sh --renew    compile, and write assumptions.txt anew
# Needs coqc 8.16, gappa, and the Coq libraries Flocq and Gappa.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

renew=no
case "${1-}" in
  '') ;;
  --renew) renew=yes ;;
  *) echo "build.sh: unknown argument '$1'; expected --renew or nothing" >&2; exit 3 ;;
esac

fail() { echo "build.sh: $1" >&2; exit 1; }

# Every theory is in the list, and none leaves anything out.
cp "$here/_CoqProject" "$here"/*.v "$work"
cd "$work"
mapfile -t theories < <(grep '\.v$' _CoqProject)
[ "$(printf '%s\n' "${theories[@]}" | sort)" = "$(printf '%s\n' *.v | sort)" ] ||
  fail "_CoqProject does not list the .v files that are here"
# What would let a theorem stand without its proof. These words are looked for so that they are not there.
forbidden='Admitted|admit|give_up|Abort|Axioms?|Parameters?|Conjecture|Primitive|bypass_check'
forbidden+='|Unset +(Guard|Positivity|Universe) +Checking|Admit +Obligations'
if grep -nwE "$forbidden" ./*.v; then fail "a word that a proof must not have"; fi
for theory in "${theories[@]}"; do
  coqc -q -Q . NoliGappa "$theory" > "$theory.out" || fail "$theory does not compile"
done

# What the theorems say and rest on: of all that is called Theorem.
mkdir ask
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
} > ask/Ask.v
coqc -q -Q . NoliGappa ask/Ask.v > assumptions.txt || fail "a theorem is missing"

if [ "$renew" = yes ]; then
  cp assumptions.txt "$here"
else
  diff "$here/assumptions.txt" assumptions.txt ||
    fail "the theorems, or what they rest on, differ from assumptions.txt"
fi
echo "all bounds hold"
