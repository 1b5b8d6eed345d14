# SPDX-License-Identifier: Apache-2.0
"""How results show themselves in a notebook: the verdict, a table of the steps that touch or were changed, and a page to turn."""

from __future__ import annotations

import base64
import html
import os
import tempfile

from ._errors import NoliError

GOOD, BAD, OPEN = "#1a7f37", "#b3261e", "#8a6d00"
COLOURS = dict.fromkeys(("proved", "no_contact", "accepted", "no_finding"), GOOD)
COLOURS.update(dict.fromkeys(("contact", "too_near", "cannot_be", "refuted", "rejected", "finding"), BAD))
MOST_ROWS = 10


def html_of(result):
    """A fragment of HTML that fetches nothing."""
    columns = ("step", "time", "kind", "pair", "vertices")
    rows = [
        (row["step"], f"{row['time']:.6g}", row["kind"], row["pair"], " ".join(str(v) for v in row["vertices"] if v >= 0))
        for row in result.contacts[:MOST_ROWS]
    ]
    return _join(_words(result), _table(columns, rows, len(result.contacts)), _view(result))


def html_of_repair(repaired, *, with_page):
    """The same for a motion that was repaired. ``with_page``: it can be read again."""
    changed = repaired.to_json()["changed"]
    columns = ("step", "moved", "largest", "rms", "inserted")
    rows = [
        (row["step"], row["moved"], f"{row['largest']:.4g}", f"{row['rms']:.4g}", row["inserted"])
        for row in changed[:MOST_ROWS]
    ]
    return _join(_words(repaired), _table(columns, rows, len(changed)), _view(repaired) if with_page else "")


def html_of_check(checked):
    """The verdict on a proof."""
    return _words(checked)


def html_of_audit(audit):
    """The verdict on a function, and its findings."""
    columns = ("fault", "pair", "kind", "time", "answer")
    rows = [(f.fault, f.pair, f.kind, f"{f.time:.6g}", f.answer) for f in audit.findings[:MOST_ROWS]]
    return _join(_words(audit), _table(columns, rows, len(audit.findings)))


def _join(*parts):
    return "\n".join(part for part in parts if part)


def _words(result):
    """The verdict, then what was looked at, and notes."""
    lines = result.text().splitlines()
    colour = COLOURS.get(result.verdict, OPEN)
    parts = [f'<p style="color:{colour};font-weight:bold;white-space:pre-wrap">{html.escape(lines[-1])}</p>']
    parts += [f"<p>{html.escape(line)}</p>" for line in lines[:-1] if line.startswith(("Looked at", "Note"))]
    return _join(*parts)


def _table(columns, rows, total):
    if not rows:
        return ""
    head = "".join(f"<th>{name}</th>" for name in columns)
    body = "".join("<tr>" + "".join(f"<td>{value}</td>" for value in row) + "</tr>" for row in rows)
    more = f"<p>and {total - len(rows)} more</p>" if total > len(rows) else ""
    return f"<table><tr>{head}</tr>{body}</table>{more}"


def _view(result):
    """The page of ``result.report`` in a frame; nothing where the motion cannot be read again."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "result.html")
        try:
            result.report(file)
        except NoliError:
            return ""
        with open(file, "rb") as page:
            text = base64.b64encode(page.read()).decode("ascii")
    return f'<iframe src="data:text/html;base64,{text}" width="100%" height="600" style="border:0"></iframe>'
