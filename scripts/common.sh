# SPDX-License-Identifier: Apache-2.0
# Sourced by the other scripts, which run with `set -euo pipefail`: goes to the root of the project and says where the real data are.
cd "$(dirname "${BASH_SOURCE[0]}")/.."
: "${NOLI_DATA:=$PWD/../shared/data}"
export NOLI_DATA
jobs=$(nproc)

say() { printf '\n== %s\n' "$*"; }

# build PRESET [TARGET...]: configures and builds, everything or the targets; what ships with reports, where there is npm.
build() {
  local preset=$1 options=()
  shift
  if [ "$preset" = release ]; then
    if command -v npm >/dev/null; then options+=(-DNOLI_WITH_REPORT=ON); else echo "skipped: noli report, because there is no npm"; fi
  fi
  cmake --preset "$preset" "${options[@]}" >/dev/null
  cmake --build --preset "$preset" --parallel "$jobs" ${1:+--target "$@"}
}

# run_tests PRESET: the fast tests, then the slow ones. Both always run; each ends with ctest's summary. Fails when either does.
run_tests() {
  local preset=$1 label failed=0
  for label in fast slow; do
    say "$preset: $label tests"
    ctest --test-dir "build/$preset" -L "$label" --parallel "$jobs" --output-on-failure --no-tests=error || failed=1
  done
  return "$failed"
}
