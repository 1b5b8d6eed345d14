#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compiles the extracted checker and its driver into OUT/noli_check_verified.
# Needs ocamlfind, ocamlopt and Zarith, not Coq.
#   proofs/coq/driver/build.sh OUT [VERSION COMMIT]
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
[ $# -eq 1 ] || [ $# -eq 3 ] ||
  { echo "build.sh: expected the folder in which to write noli_check_verified, then perhaps version and commit" >&2; exit 3; }
mkdir -p "$1"
out=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here"/../extracted/*.ml "$here"/../extracted/*.mli "$here"/*.ml "$work"
cd "$work"
echo "let text = \"${2:-unknown} ${3:-unknown}\"" >version.ml
# Dependencies first, as ocamldep sorts them.
read -r -a sources <<< "$(ocamlfind ocamldep -sort ./*.mli ./*.ml | tr '\n' ' ')"
# The extraction does not heed the warnings of which these are left out; -O3 does something where there is flambda.
ocamlfind ocamlopt -package zarith -linkpkg -O3 -inline 200 -w +a-4-9-20-33-39-40-41-42-44-45-67-70 \
  "${sources[@]}" -o noli_check_verified
mv noli_check_verified "$out"
