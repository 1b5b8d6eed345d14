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
look curtains '{"word": "no contact", "tone": "good", "listed": 0, "plots": 6}'

# A run that ended in contact, of which what it has was proved again: it has ended so all the same.
"$noli" simulate "$here/../../scenes/sheet_through_sheet.json" --short -o "$out/sheets" >/dev/null || [ $? -eq 1 ]
verify "$out/sheets" --json "$out/sheets.json"
"$noli" report "$out/sheets" "$out/sheets.json" -o "$out/sheets.html"
look sheets '{"word": "contact", "tone": "bad", "listed": 0,
  "says": ["noli verify says proved (sheets.json)", "meets edge driven", "Not compared: two cells of driven", "is about this run",
           "always in one place are merged", "stops at any contact", "the run sheets"]}'

# A verdict with many contacts, and its frames.
mkdir "$out/frames"
"$demo_frames" contact 60 "$out/frames"
verify --no-check --keep-going --max-reports 100000 --json "$out/contacts.json" "$out"/frames/*.ply
"$noli" report "$out/contacts.json" "$out"/frames/*.ply -o "$out/contacts.html"
look contacts '{"word": "contact", "tone": "bad", "listed": 1000, "frames": 6, "says": ["features, by vertex"], "lacks": ["kind"]}'

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
  "says": ["wrong.times", "18446744073709551615", "1e+300", "2.5e-7", "yes", "[3], [0,1,2]", "says they are apart", "still here"]}'

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
echo "pages and pictures are in $out"
