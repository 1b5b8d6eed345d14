#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Both checkers on good proofs and on broken ones: equal exit codes, and equal first words.
#   proofs/coq/driver/test.sh BIN     BIN has noli, noli_check and noli_check_verified
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
[ $# -eq 1 ] || { echo "test.sh: expected the folder of the programs" >&2; exit 3; }
bin=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
PYTHONDONTWRITEBYTECODE=1 python3 "$here/test_agreement.py" "$bin" "$here/../../../scenes" "$work"
