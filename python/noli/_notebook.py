# SPDX-License-Identifier: Apache-2.0
"""How a result shows itself in a notebook: its verdict, a table of the steps that touch, and a page to turn."""

from __future__ import annotations

import base64
import html
import os
import tempfile

from ._errors import NoliError

COLOURS = {"proved": "#1a7f37", "no_contact": "#1a7f37", "contact": "#b3261e", "too_near": "#b3261e"}
MOST_ROWS = 10


def html_of(result):
    """A fragment of HTML that fetches nothing."""
    lines = result.text().splitlines()
    colour = COLOURS.get(result.verdict, "#8a6d00")
    parts = [f'<p style="color:{colour};font-weight:bold;white-space:pre-wrap">{html.escape(lines[-1])}</p>']
    parts += [f"<p>{html.escape(line)}</p>" for line in lines[:-1] if line.startswith(("Looked at", "Note"))]
    parts.append(_table(result.contacts))
    parts.append(_view(result))
    return "\n".join(part for part in parts if part)


def _table(contacts):
    if not len(contacts):
        return ""
    head = "".join(f"<th>{name}</th>" for name in ("step", "time", "kind", "pair", "vertices"))
    rows = [
        "<tr>"
        + "".join(
            f"<td>{value}</td>"
            for value in (
                row["step"],
                f"{row['time']:.6g}",
                row["kind"],
                row["pair"],
                " ".join(str(v) for v in row["vertices"] if v >= 0),
            )
        )
        + "</tr>"
        for row in contacts[:MOST_ROWS]
    ]
    more = f"<p>and {len(contacts) - MOST_ROWS} more</p>" if len(contacts) > MOST_ROWS else ""
    return f"<table><tr>{head}</tr>{''.join(rows)}</table>{more}"


def _view(result):
    """The page of ``Result.report`` in a frame; nothing where the motion cannot be read again."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "result.html")
        try:
            result.report(file)
        except NoliError:
            return ""
        with open(file, "rb") as page:
            text = base64.b64encode(page.read()).decode("ascii")
    return f'<iframe src="data:text/html;base64,{text}" width="100%" height="600" style="border:0"></iframe>'
