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
look curtains '{"word": "no contact", "listed": 0, "plots": 6}'

# A verdict with many contacts, and its frames.
mkdir "$out/frames"
"$demo_frames" contact 60 "$out/frames"
verify --no-check --keep-going --max-reports 100000 --json "$out/contacts.json" "$out"/frames/*.ply
"$noli" report "$out/contacts.json" "$out"/frames/*.ply -o "$out/contacts.html"
look contacts '{"word": "contact", "listed": 1000, "frames": 6}'

# A result that is a table, with a picture.
cat >"$out/table.json" <<'JSON'
{"verdict": "finding", "rows": [{"method": "one", "wrong": {"times": 3}}, {"method": "two", "wrong": {"times": 0}}]}
JSON
echo '<svg xmlns="http://www.w3.org/2000/svg" width="40" height="20"><rect width="40" height="20" fill="teal"/></svg>' >"$out/picture.svg"
"$noli" report "$out/table.json" "$out/picture.svg" -o "$out/table.html"
look table '{"word": "finding", "total": "wrong.times"}'

# A page that says something else than expected is noticed.
if look table '{"word": "no contact"}' >/dev/null 2>&1; then echo "browser.sh: a wrong word was not noticed" >&2; exit 1; fi
echo "pages and pictures are in $out"
