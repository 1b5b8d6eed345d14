# SPDX-License-Identifier: Apache-2.0
"""Compares a collision detection function with the exact answers."""

from __future__ import annotations

import os
import time as clock
from typing import Any, Dict, List, Mapping, NoReturn, Optional, Sequence, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._errors import InputError, UsageError
from ._queries import _points, contacts
from ._options import LONGEST, distance, words
from ._types import CcdFunction, Floats, Path
from ._words import PAIRS, no_truth

FAULTS = ("false_negative", "late", "bad_time", "false_positive", "early")
ASKED = ("vertex_face", "edge_edge")


class Finding:
    """A query that a function answers wrongly.

    Attributes
    ----------
    fault : str
        "false_negative": they meet, it says no. "late": a time after the first. "bad_time": outside [0, 1].
        With ``exact=True`` also "false_positive" and "early".
    pair, x_t0, x_t1
        The query: (4, 3) each.
    kind, time
        The truth, as Contacts has it.
    answer : float
        What the function said: a time, infinite for no.
    generator : str
        What made the query; empty for a caller's own.
    index : int
        Of a caller's own query.
    """

    fault: str
    pair: str
    x_t0: Floats
    x_t1: Floats
    kind: str
    time: float
    answer: float
    generator: str
    index: int

    def __init__(self, **members: Any) -> None:
        self.__dict__.update(members)

    def save(self, file: Path) -> None:
        """Writes a file that ``noli ccd`` and ``noli audit ccd`` read; its name has to have "vertex-face" or "edge-edge"."""
        comments = [f"# {self.fault}: {self.answer}, the truth is {self.kind}, t = {self.time}"]
        number = int(np.flatnonzero(PAIRS == self.pair)[0])
        _core.save_query(os.fspath(file), number, self.x_t0, self.x_t1, self.kind != "apart", comments)

    def __repr__(self):
        return f"<noli.Finding: {self.fault}, {self.pair} {self.kind}, t = {self.time}, answered {self.answer}>"


class Audit:
    """How a function did. It is no bool: ask ``verdict``.

    Attributes
    ----------
    verdict : str
        "no_finding", or "finding".
    asked, contacts : int
        Queries, and how many of them are contacts.
    faults : dict of name to int
        All that were found. "false_positive" and "early" count for the verdict only with ``exact=True``.
    findings : list of Finding
        At most ``max_findings``.
    """

    def __init__(self, exact: bool, max_findings: int) -> None:
        self.exact, self._most = exact, max_findings
        self.asked = self.contacts = 0
        self.faults: Dict[str, int] = dict.fromkeys(FAULTS, 0)
        self.findings: List[Finding] = []

    def __bool__(self) -> NoReturn:
        no_truth(self)

    def counts(self, fault: str) -> bool:
        """Whether this fault is a finding."""
        return self.exact or fault not in ("false_positive", "early")

    @property
    def verdict(self) -> str:
        return "finding" if any(n for fault, n in self.faults.items() if self.counts(fault)) else "no_finding"

    def __repr__(self):
        found = ", ".join(f"{n} {fault}" for fault, n in self.faults.items() if n)
        return f"<noli.Audit: {self.verdict}, {self.asked} queries, {self.contacts} contacts{': ' + found if found else ''}>"


def audit_ccd(
    function: CcdFunction,
    queries: Mapping[str, Tuple[ArrayLike, ArrayLike]],
    *,
    exact: bool = False,
    max_findings: int = 20,
) -> Audit:
    """Compares a function's answers with the exact ones.

    Parameters
    ----------
    function : callable
        ``function(pair, x_t0, x_t1)``, pair "vertex_face" or "edge_edge", (m, 4, 3) float64 each. Returns (m,) bool, or
        (m,) times of impact in [0, 1], NaN or infinite for no contact.
    queries : dict of pair to (x_t0, x_t1)
        (m, 4, 3) each.
    exact : bool
        The function claims to be exact: false positives and early times are findings too. Else it may say "hit" for
        what stays apart, and times before the first.
    max_findings : int
        How many are kept; all are counted.

    Returns
    -------
    Audit

    Raises
    ------
    InputError
        Queries, or answers, of another shape or type. What the function raises is passed on.
    """
    audit = Audit(exact, max_findings)
    for pair, (x_t0, x_t1) in queries.items():
        _require_pair(pair)
        _ask(audit, function, pair, _points(pair, x_t0, "x_t0"), _points(pair, x_t1, "x_t1"))
    return audit


def fuzz_queries(
    function: CcdFunction,
    *,
    seconds: Optional[float] = None,
    count: Optional[int] = None,
    seed: int = 1,
    exact: bool = False,
    pairs: Sequence[str] = ASKED,
    shrink: bool = True,
    max_findings: int = 20,
) -> Audit:
    """Asks a function adversarial queries until it has been asked ``count``, or for so many seconds.

    Findings are made simpler while the function still gets them wrong (``shrink``). The queries depend on ``seed``
    alone. ``function``, ``exact``, ``max_findings`` as for ``audit_ccd``. Returns an Audit.
    """
    if seconds is None and count is None:
        raise UsageError("expected seconds=, count= or both")
    if not hasattr(_core, "adversarial_queries"):
        raise UsageError("this noli was built without audits; expected one with NOLI_WITH_AUDIT=ON")
    pairs = words(pairs)
    if not pairs:
        raise UsageError(f"pairs: expected one of {', '.join(ASKED)} at least")
    for pair in pairs:
        _require_pair(pair)
    limit = LONGEST if seconds is None else distance(seconds, "seconds")
    audit, end, each, round_number = Audit(exact, max_findings), clock.monotonic() + limit, 64, 0
    while clock.monotonic() < end and (count is None or audit.asked < count):
        for pair in pairs:
            names, x_t0, x_t1 = _core.adversarial_queries(_number(pair), seed, round_number, each)
            if count is not None:
                x_t0, x_t1 = x_t0[: max(0, count - audit.asked)], x_t1[: max(0, count - audit.asked)]
            _ask(audit, function, pair, x_t0, x_t1, lambda row, names=names: names[row // each])
        round_number += 1
    if shrink:
        audit.findings = [_simpler(function, finding, audit, end) for finding in audit.findings]
    return audit


def _require_pair(pair):
    if pair not in ASKED:
        raise InputError(f"pair: expected one of {', '.join(ASKED)}, found {pair!r}")


def _number(pair):
    return int(np.flatnonzero(PAIRS == pair)[0])


def _times(function, pair, x_t0, x_t1):
    """(hits, times, whether it gives times) of the function's answers."""
    answers = np.asarray(function(pair, x_t0, x_t1))
    if answers.shape != (len(x_t0),):
        raise InputError(f"the function's answers have the shape {answers.shape}; expected ({len(x_t0)},)")
    if answers.dtype == bool:
        return answers, np.where(answers, np.nan, np.inf), False
    if answers.dtype.kind not in "fiu":
        raise InputError(f"the function's answers are {answers.dtype}; expected bool or times")
    times = answers.astype(np.float64)
    return ~(np.isnan(times) | np.isposinf(times)), times, True


def _faults(function, pair, x_t0, x_t1, exact):
    """By query the number of its fault in FAULTS, or -1; the answers, and the truth."""
    truth = contacts(pair, x_t0, x_t1)
    hits, times, knows_times = _times(function, pair, x_t0.copy(), x_t1.copy())
    fault = np.full(len(x_t0), -1)
    fault[~truth.touches & hits] = FAULTS.index("false_positive")
    if knows_times:
        both = truth.touches & hits
        fault[both & (times < truth.time)] = FAULTS.index("early")
        fault[both & (times > np.nextafter(truth.time, np.inf))] = FAULTS.index("late")
        fault[hits & ((times < 0) | (times > 1))] = FAULTS.index("bad_time")
    fault[truth.touches & ~hits] = FAULTS.index("false_negative")
    return fault, times, truth


def _ask(audit, function, pair, x_t0, x_t1, generator=None):
    if not len(x_t0):
        return
    fault, times, truth = _faults(function, pair, x_t0, x_t1, audit.exact)
    audit.asked += len(x_t0)
    audit.contacts += int(np.count_nonzero(truth.touches))
    for number, name in enumerate(FAULTS):
        rows = np.flatnonzero(fault == number)
        audit.faults[name] += len(rows)
        if not audit.counts(name):
            continue
        alike = sum(finding.fault == name for finding in audit.findings)
        for row in rows[: max(0, min(audit._most - len(audit.findings), -(-audit._most // 2) - alike))]:
            audit.findings.append(
                Finding(
                    fault=name,
                    pair=pair,
                    x_t0=x_t0[row].copy(),
                    x_t1=x_t1[row].copy(),
                    kind=str(truth.kind[row]),
                    time=float(truth.time[row]),
                    answer=float(times[row]),
                    generator="" if generator is None else generator(int(row)),
                    index=int(row),
                )
            )


def _simpler(function, finding, audit, end):
    wanted = FAULTS.index(finding.fault)

    def fails(x_t0, x_t1):
        fault, _, truth = _faults(function, finding.pair, x_t0, x_t1, audit.exact)
        rows = np.flatnonzero((fault == wanted) & (truth.kind == finding.kind))
        return int(rows[0]) if len(rows) else None

    if clock.monotonic() > end + 10:
        return finding
    x_t0, x_t1 = _core.simpler_query(_number(finding.pair), finding.x_t0, finding.x_t1, fails, 20_000)
    _, times, truth = _faults(function, finding.pair, x_t0[np.newaxis], x_t1[np.newaxis], audit.exact)
    members = dict(finding.__dict__, x_t0=x_t0, x_t1=x_t1, time=float(truth.time[0]), answer=float(times[0]))
    return Finding(**members)
