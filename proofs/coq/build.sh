#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compiles all proofs and the extracted checker from nothing, in a temporary folder, and compares what they rest on, and
# the extraction, with what is here. Exits 0 only if all is as it should be.
#   proofs/coq/build.sh            compile and compare
#   proofs/coq/build.sh --renew    compile, and write assumptions.txt and extracted/ anew
# Needs coqc 8.16, and ocamlfind, ocamlopt and Zarith.
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
forbidden='Admitted|admit|give_up|Axioms?|Parameters?|Conjecture|Primitive|bypass_check'
forbidden+='|Unset +(Guard|Positivity|Universe) +Checking|Admit +Obligations'
if grep -nwE "$forbidden" ./*.v; then fail "a word that a proof must not have"; fi
for theory in "${theories[@]}"; do coqc -q -Q . Noli "$theory" > "$theory.out" || fail "$theory does not compile"; done

# What the theorems rest on.
theorems=(check_sound check_sound_cells check_well_formed run_app glue_sound glue_well_formed chain_sound
          check_hit_sound check_hit_sound_both)
mkdir ask
{
  echo 'Require Import ZArith List Reals.'
  echo 'From Noli Require Import Spec Checker Sound Glue Hit.'
  echo 'Open Scope Z_scope. Open Scope R_scope.'
  for theorem in "${theorems[@]}"; do
    echo "Check $theorem."
    echo "Print Assumptions $theorem."
  done
} > ask/Ask.v
coqc -q -Q . Noli ask/Ask.v > assumptions.txt || fail "a theorem is missing"

# The extracted checker: the same text, and it compiles with Zarith alone.
mkdir out
for module in Spec Checker Poly Hit; do
  for end in ml mli; do
    { echo '(* SPDX-License-Identifier: Apache-2.0 *)'
      echo "(* Extracted from $module.v by build.sh --renew: not to be edited. *)"
      cat "$module.$end"; } > "out/$module.$end"
  done
done
cp "$here/extracted/zint.ml" out
mkdir compiled
cp out/* compiled
(cd compiled && ocamlfind ocamlopt -package zarith -c zint.ml Spec.mli Spec.ml Checker.mli Checker.ml \
  Poly.mli Poly.ml Hit.mli Hit.ml) ||
  fail "the extracted checker does not compile"

if [ "$renew" = yes ]; then
  cp assumptions.txt "$here"
  cp out/* "$here/extracted"
else
  diff "$here/assumptions.txt" assumptions.txt || fail "the theorems, or what they rest on, differ from assumptions.txt"
  diff -r "$here/extracted" out || fail "extracted/ is not what Coq extracts"
fi
echo "all proofs hold"
