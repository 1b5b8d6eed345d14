#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compiles the extracted checker and its driver into OUT/noli_check_verified. Needs ocamlfind, ocamlopt and Zarith, not Coq.
#   proofs/coq/driver/build.sh OUT
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
[ $# -eq 1 ] || { echo "build.sh: expected the folder in which to write noli_check_verified" >&2; exit 3; }
mkdir -p "$1"
out=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$here"/../extracted/*.ml "$here"/../extracted/*.mli "$here"/*.ml "$work"
cd "$work"
# The extraction is not written to be free of the warnings that a person would heed.
mapfile -t extracted < <(cd "$here/../extracted" && ls ./*.ml ./*.mli)
mapfile -t driver < <(cd "$here" && ls ./*.ml)
mapfile -t sorted < <(ocamlfind ocamldep -sort "${extracted[@]}" "${driver[@]}" | tr ' ' '\n' | grep .)
ocamlfind ocamlopt -package zarith -linkpkg -inline 200 "${sorted[@]}" -o noli_check_verified
mv noli_check_verified "$out/noli_check_verified"
