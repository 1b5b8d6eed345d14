# SPDX-License-Identifier: Apache-2.0
# What coq/build.sh and gappa/build.sh have in common; each sources this file after it has set $here. It looks at the
# arguments, copies the theories to a temporary folder, and goes there. Then `compile`, `ask` and `keep` are there.

here=${here:?}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

renew=no
case "${1-}" in
  '') ;;
  --renew) renew=yes ;;
  *) echo "build.sh: unknown argument '$1'; expected --renew or nothing" >&2; exit 3 ;;
esac

fail() { echo "build.sh: $1" >&2; exit 1; }

cp "$here/_CoqProject" "$here"/*.v "$work"
cd "$work" || exit
mapfile -t theories < <(grep '\.v$' _CoqProject)

# compile NAME: all theories, as the library NAME. Every theory is in the list, and none leaves anything out.
compile() {
  [ "$(printf '%s\n' "${theories[@]}" | sort)" = "$(printf '%s\n' *.v | sort)" ] ||
    fail "_CoqProject does not list the .v files that are here"
  # What would let a theorem stand without its proof. These words are looked for so that they are not there.
  local forbidden='Admitted|admit|give_up|Abort|Axioms?|Parameters?|Conjecture|Primitive|bypass_check'
  forbidden+='|Unset +(Guard|Positivity|Universe) +Checking|Admit +Obligations'
  if grep -nwE "$forbidden" ./*.v; then fail "a word that a proof must not have"; fi
  local theory
  for theory in "${theories[@]}"; do
    coqc -q -Q . "$1" "$theory" > "$theory.out" || fail "$theory does not compile"
  done
}

# ask NAME: what Coq says to the commands of the standard input, in assumptions.txt.
ask() {
  mkdir ask
  cat > ask/Ask.v
  coqc -q -Q . "$1" ask/Ask.v > assumptions.txt || fail "a theorem is missing"
}

# keep FILE WHY: the file or folder that was made is the one in $here, else WHY; with --renew it takes its place.
keep() {
  if [ "$renew" = yes ]; then
    cp -r "$1" "$here"
  else
    diff -r "$here/$1" "$1" || fail "$2"
  fi
}
