#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compiles all proofs and the extracted checker from nothing, in a temporary folder, and compares what they rest on, and
# the extraction, with what is here. Exits 0 only if all is as it should be.
#   proofs/coq/build.sh            compile and compare
#   proofs/coq/build.sh --renew    compile, and write assumptions.txt and extracted/ anew
# Needs coqc 8.16, and ocamlfind, ocamlopt and Zarith.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
# shellcheck source=proofs/formal.sh
. "$here/../formal.sh"

compile Noli

# What the theorems rest on.
theorems=(check_sound check_sound_cells check_well_formed run_app glue_sound glue_well_formed chain_sound
          check_hit_sound check_hit_sound_both start_read_same start_read_sound asked_holds)
{
  echo 'Require Import ZArith List Reals.'
  echo 'From Noli Require Import Spec Checker Sound Reading Glue Hit Asked.'
  echo 'Open Scope Z_scope. Open Scope R_scope.'
  for theorem in "${theorems[@]}"; do
    echo "Check $theorem."
    echo "Print Assumptions $theorem."
  done
} | ask Noli

# The extracted checker: the same text, and it compiles with Zarith alone.
mkdir extracted
for module in Spec Checker Reading Poly Hit; do
  for end in ml mli; do
    { echo '(* SPDX-License-Identifier: Apache-2.0 *)'
      echo "(* Extracted from $module.v by build.sh --renew: not to be edited. *)"
      cat "$module.$end"; } > "extracted/$module.$end"
  done
done
cp "$here/extracted/zint.ml" extracted
cp -r extracted compiled
(cd compiled && ocamlfind ocamlopt -package zarith -c zint.ml Spec.mli Spec.ml Checker.mli Checker.ml \
  Reading.mli Reading.ml Poly.mli Poly.ml Hit.mli Hit.ml) ||
  fail "the extracted checker does not compile"

keep assumptions.txt "the theorems, or what they rest on, differ from assumptions.txt"
keep extracted "extracted/ is not what Coq extracts"
echo "all proofs hold"
