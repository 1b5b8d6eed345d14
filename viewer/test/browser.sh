#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes reports of each sort and looks at them in a real browser (browser.mjs): at two widths, without a network, with pictures in OUT.
#   viewer/test/browser.sh NOLI DEMO_FRAMES CHROMIUM MODULES OUT      MODULES: a folder with node_modules
set -euo pipefail
[ $# -eq 5 ] || { echo "browser.sh: expected NOLI DEMO_FRAMES CHROMIUM MODULES OUT" >&2; exit 3; }
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
noli=$1 demo_frames=$2 chromium=$3 modules=$4
mkdir -p "$5"
out=$(cd "$5" && pwd)
rm -rf "${out:?}"/*
look() { (cd "$modules" && node "$here/browser.mjs" "$chromium" "$out/$1.html" "$out/pictures" --expect "$2"); }
verify() { "$noli" verify "$@" >/dev/null || [ $? -eq 1 ]; }

# A run with contact.
"$noli" simulate "$here/../../scenes/curtains.json" --short -o "$out/curtains" >/dev/null
"$noli" report "$out/curtains" -o "$out/curtains.html"
look curtains '{"word": "no contact", "tone": "good", "listed": 0, "plots": 6, "meets": 0.005, "says": ["noli verify --reproduce"],
  "shows": ["Nothing that is compared touches", "Nearest at an impulse of contact: vertex curtains["], "folds": ["noli verify --reproduce"]}'

# A run in which nothing comes near anything: its view opens with the whole scene.
"$noli" simulate "$here/../../scenes/stretched_sheet.json" --short -o "$out/stretched_sheet" >/dev/null
"$noli" report "$out/stretched_sheet" -o "$out/stretched_sheet.html"
look stretched_sheet '{"word": "no contact", "tone": "good", "meets": 0}'

# A run that ended in contact, of which what it has was proved again: it has ended so all the same.
"$noli" simulate "$here/../../scenes/sheet_through_sheet.json" --short -o "$out/sheets" >/dev/null || [ $? -eq 1 ]
verify "$out/sheets" --json "$out/sheets.json"
"$noli" report "$out/sheets" "$out/sheets.json" -o "$out/sheets.html"
look sheets '{"word": "contact", "tone": "bad", "listed": 0, "meets": 0.005,
  "shows": ["The run ends before this contact: edge free[72]-free[85] meets edge driven", "two cells of driven"],
  "folds": ["always in one place are merged", "is about this run"],
  "says": ["noli verify says proved (sheets.json)", "meets edge driven", "Not compared: two cells of driven", "is about this run",
           "always in one place are merged", "stops at any contact", "the run sheets"]}'

# A verdict with contacts, and its frames.
mkdir "$out/frames"
"$demo_frames" contact 60 "$out/frames"
verify --no-check --keep-going --max-reports 100000 --json "$out/contacts.json" "$out"/frames/*.ply
"$noli" report "$out/contacts.json" "$out"/frames/*.ply -o "$out/contacts.html"
look contacts '{"word": "contact", "tone": "bad", "listed": 1000, "frames": 6, "plots": 1, "meets": 0.005, "last_mark": "tep 5",
  "shows": ["First contact: vertex 3721", "features, by vertex", "checks all steps", "Contacts by step"], "folds": ["is cut into the triangles"],
  "says": ["is cut into the triangles"], "lacks": ["kind"]}'
"$noli" report "$out/contacts.json" -o "$out/alone.html"
look alone '{"word": "contact", "tone": "bad", "listed": 1000, "frames": 0, "shows": ["The first is a crossing"]}'

# Frames at rest, in some of which cells intersect: it opens with the first of these.
verify --no-check --static --keep-going --max-reports 1000 --json "$out/rest.json" "$out"/frames/*.ply
"$noli" report "$out/rest.json" "$out"/frames/*.ply -o "$out/rest.html"
look rest '{"word": "contact", "tone": "bad", "frames": 6, "meets": 0.005, "shows": ["pairs of cells intersect before anything moves", "intersection", "frame 5 of 6"], "folds": ["is cut into the triangles"]}'

# A repair: both motions, opened where most was changed.
"$noli" repair "$out"/frames/*.ply -o "$out/mended/%03d.ply" --no-check --json "$out/mended.json" >/dev/null
"$noli" report "$out/mended.json" -o "$out/mended.html"
look mended '{"word": "no contact", "tone": "good", "frames": 6, "plots": 1, "folds": ["restitution"],
  "shows": ["Moved most from its given position", "The new motion is solid", "A motion, mended", "Steps that were changed", "moved by at most"]}'

# A verdict with 100,000 contacts: it opens as fast as one without.
mkdir "$out/many_frames"
"$demo_frames" contact 175 "$out/many_frames"
verify --no-check --keep-going --max-reports 100000 --json "$out/crowd.json" "$out"/many_frames/*.ply
grep -q '"listed": 100000' "$out/crowd.json" || { echo "browser.sh: expected 100,000 contacts in crowd.json" >&2; exit 1; }
"$noli" report "$out/crowd.json" "$out"/many_frames/*.ply -o "$out/crowd.html"
look crowd '{"word": "contact", "tone": "bad", "listed": 1000, "meets": 0.005, "most_open_seconds": 10}'

# Results that have cards of their own.
"$noli" fuzz queries --count 3000 --seed 1 --json "$out/fuzz.json" --out "$out/findings" >/dev/null
"$noli" report "$out/fuzz.json" -o "$out/fuzz.html"
look fuzz '{"word": "no difference", "tone": "good", "shows": ["Fuzzer of queries", "Queries by generator", "Decided by stage"], "says": ["grid/vertex_face", "probes"],
  "folds": ["probes"]}'
"$noli" audit precision "$here/../../scenes/bounce.json" --until 0.5 --json "$out/precision.json" >/dev/null
"$noli" report "$out/precision.json" -o "$out/precision.html"
look precision '{"word": "same", "tone": "good", "plots": 3, "shows": ["Audit of precision", "256 bits", "distance of a position [m]"]}'
"$noli" audit integrator "$here/../../scenes/hanging_chain.json" --short --windows 2 --halvings 1 --json "$out/integrator.json" >/dev/null 2>&1
"$noli" report "$out/integrator.json" -o "$out/integrator.html"
look integrator '{"word": "measured", "tone": "neutral", "plots": 2, "shows": ["Audit of the integrator", "run time [s]", "verlet"]}'

# What claims to be a result that has a card, but is none: everything in it is shown all the same.
echo '{"schema": "noli-fuzz-queries", "verdict": "finding", "odd": [{"one": {"two": [{"three": 4}]}}, {"five": [[6], [7, 8]]}]}' >"$out/damaged.json"
"$noli" report "$out/damaged.json" -o "$out/damaged.html"
look damaged '{"word": "finding", "warns": "The card of noli-fuzz-queries cannot show this", "shows": ["odd", "(6), (7, 8)"]}'

# A result that is a table, with a picture.
cat >"$out/table.json" <<'JSON'
{"verdict": "finding", "seed": 18446744073709551615, "large": 1e300, "small": 2.5e-7, "complete": true, "none": [],
 "rows": [{"method": "one", "wrong": {"times": 3}, "lists": [[3], [0, 1, 2]],
           "reports": [{"query": 7, "words": "says they are apart", "parts": [{"deeper": "still here"}]}]},
          {"method": "two", "wrong": {"times": 0}, "reports": []}]}
JSON
echo '<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20"><rect width="40" height="20" fill="teal"/></svg>' >"$out/picture.svg"
"$noli" report "$out/table.json" "$out/picture.svg" -o "$out/table.html"
look table '{"word": "finding", "tone": "bad",
  "says": ["wrong, times", "18446744073709551615", "1e+300", "2.5e-7", "yes", "(3), (0, 1, 2)", "says they are apart", "still here"]}'

# Of several results the worst is at the head; words that are neither good nor bad have a colour of their own.
echo '{"verdict": "no_finding"}' >"$out/quiet.json"
echo '{"verdict": "measured"}' >"$out/measured.json"
"$noli" report "$out/quiet.json" "$out/measured.json" "$out/table.json" -o "$out/several.html"
look several '{"word": "finding", "tone": "bad", "says": ["quiet.json says no finding", "table.json says finding"]}'
"$noli" report "$out/measured.json" -o "$out/neutral.html"
look neutral '{"word": "measured", "tone": "neutral"}'

# A table of many rows has those within it closed, and they open.
{ echo '{"verdict": "no_finding", "rows": ['
  for i in $(seq 1500); do echo "{\"i\": $i, \"points\": [{\"x\": 1}, {\"x\": 2}]},"; done
  echo '{"i": 0}]}'; } >"$out/many.json"
"$noli" report "$out/many.json" -o "$out/many.html"
look many '{"word": "no finding", "tone": "good", "says": ["points: 2", "and 501 more"]}'

# A page that says something else than expected is noticed.
for wrong in '{"word": "no contact"}' '{"tone": "good"}' '{"says": ["nowhere"]}'; do
  if look table "$wrong" >/dev/null 2>&1; then echo "browser.sh: $wrong was not noticed" >&2; exit 1; fi
done
for wrong in '{"meets": 0.9}' '{"meets": 0}' '{"shows": ["is cut into the triangles"]}' '{"folds": ["First contact"]}' '{"last_mark": "nowhere"}'; do
  if look contacts "$wrong" >/dev/null 2>&1; then echo "browser.sh: $wrong was not noticed" >&2; exit 1; fi
done
echo "pages and pictures are in $out"
