# SPDX-License-Identifier: Apache-2.0
"""Compares a collision detection function with the exact answers."""

from __future__ import annotations

import os
import time as clock
from typing import Any, Dict, List, Mapping, NoReturn, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._errors import InputError, UsageError
from ._queries import _points, contacts
from ._options import LONGEST, distance, require_new, whole, words
from ._types import CcdFunction, Floats, Json, Path
from ._words import PAIRS, no_truth

FAULTS = ("false_negative", "late", "bad_time", "false_positive", "early")
ASKED = ("vertex_face", "edge_edge")
KIND_ORDER = ("crossing", "touching", "persistent", "apart")  # what a function should not miss comes first


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
    answer : float or bool
        What the function said.
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
    answer: Union[float, bool]
    generator: str
    index: int

    def __init__(self, **members: Any) -> None:
        self.__dict__.update(members)

    def save(self, file: Path, *, force: bool = False) -> None:
        """Writes a .csv file that ``noli ccd`` and ``noli audit ccd`` read. Its name has to contain the pair, "edge-edge"."""
        if self.pair not in os.path.basename(os.fspath(file)).replace("-", "_"):
            raise UsageError(f"{os.fspath(file)}: expected a name that contains {self.pair.replace('_', '-')}")
        require_new(file, force)
        comments = [f"# {self.fault}: {self.answer}, the truth is {self.kind}, t = {self.time}"]
        number = int(np.flatnonzero(PAIRS == self.pair)[0])
        _core.save_query(os.fspath(file), number, self.x_t0, self.x_t1, self.kind != "apart", comments)

    def to_json(self) -> Json:
        """A dict of all attributes; NaN for no time becomes None, as does an infinite answer."""
        found = {name: getattr(self, name) for name in ("fault", "pair", "kind", "generator", "index")}
        found.update(time=_number_or_none(self.time), answer=_number_or_none(self.answer))
        found.update(x_t0=self.x_t0.tolist(), x_t1=self.x_t1.tolist())
        return found

    def __repr__(self):
        return f"<noli.Finding: {self.fault}, {self.pair} {self.kind}, t = {self.time}, answered {self.answer}>"


class Audit:
    """How a function did. It is not a bool: ask ``verdict``.

    Attributes
    ----------
    verdict : str
        "no_finding", or "finding".
    asked, contacts : int
        Queries, and how many of them are contacts.
    faults : dict of name to int
        All that were found. "false_positive" and "early" count for the verdict only with ``exact=True``.
    findings : list of Finding
        At most ``max_findings``, missed crossings first.
    """

    def __init__(self, exact: bool, max_findings: int) -> None:
        self.exact, self._most = exact, whole(max_findings, "max_findings", 0)
        self.asked = self.contacts = 0
        self.faults: Dict[str, int] = dict.fromkeys(FAULTS, 0)
        self.findings: List[Finding] = []
        self._alike: Dict[Tuple[str, ...], List[Finding]] = {}

    def __bool__(self) -> NoReturn:
        no_truth(self)

    def counts(self, fault: str) -> bool:
        """Whether faults of this name count for the verdict."""
        return self.exact or fault not in ("false_positive", "early")

    @property
    def verdict(self) -> str:
        return "finding" if any(n for fault, n in self.faults.items() if self.counts(fault)) else "no_finding"

    def __repr__(self) -> str:
        found = ", ".join(f"{n} {fault}" for fault, n in self.faults.items() if n)
        return f"<noli.Audit: {self.verdict}, {self.asked} queries, {self.contacts} contacts{': ' + found if found else ''}>"

    def to_json(self) -> Json:
        """A dict: verdict, exact, asked, contacts, faults, findings (``Finding.to_json``)."""
        return {
            "verdict": self.verdict,
            "exact": self.exact,
            "asked": self.asked,
            "contacts": self.contacts,
            "faults": dict(self.faults),
            "findings": [finding.to_json() for finding in self.findings],
        }

    def text(self) -> str:
        """The first finding with its coordinates, then the verdict and how often each fault was found."""
        lines = []
        if self.findings:
            first = self.findings[0]
            lines.append(f"{first.pair}, {first.kind} at t = {first.time!r}: the function answered {first.answer!r} ({first.fault})")
            lines += [f"  {name} = {getattr(first, name).tolist()!r}" for name in ("x_t0", "x_t1")]
        found = ", ".join(f"{n} {fault}" for fault, n in self.faults.items() if n and self.counts(fault))
        verdict = self.verdict.replace("_", " ").upper()
        lines.append(f"{verdict}  {self.asked} queries, {self.contacts} contacts" + (f": {found}" if found else ""))
        return "\n".join(lines)

    def __str__(self) -> str:
        return self.text()

    def _repr_html_(self) -> str:
        from ._notebook import html_of_audit

        return html_of_audit(self)

    def _room(self, *alike: str) -> int:
        """For so many more findings that are alike."""
        return self._most - len(self._alike.get(alike, ()))

    def _keep(self, finding: Finding) -> None:
        alike = (finding.pair, finding.fault, finding.kind, finding.generator)
        self._alike.setdefault(alike, []).append(finding)

    def _choose(self) -> None:
        """Takes one of each sort in turn, until there are enough."""
        seen: Dict[Tuple[str, ...], int] = {}
        ranked = []
        for (pair, fault, kind, _), found in self._alike.items():  # both pairs alternate
            rank = seen[pair, fault, kind] = seen.get((pair, fault, kind), -1) + 1
            ranked.append(((KIND_ORDER.index(kind), FAULTS.index(fault), rank), list(found)))
        lists = [found for _, found in sorted(ranked, key=lambda item: item[0])]
        while len(self.findings) < self._most and any(lists):
            for found in lists:
                if found and len(self.findings) < self._most:
                    self.findings.append(found.pop(0))
        self.findings.sort(key=lambda finding: KIND_ORDER.index(finding.kind))


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
        (m,) times of impact in [0, 1], NaN or infinite for no contact. A time is late if it is above the exact one,
        however little: round down.
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
    if not hasattr(queries, "items") or not queries:
        raise UsageError("queries: expected a dict of pair to (x_t0, x_t1), with one pair at least")
    audit = Audit(exact, max_findings)
    for pair, (x_t0, x_t1) in queries.items():
        _require_pair(pair)
        _ask(audit, function, pair, _points(pair, x_t0, "x_t0"), _points(pair, x_t1, "x_t1"))
    audit._choose()
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
    alone. ``pairs`` is "vertex_face", "edge_edge" or both (the default). ``function``, ``exact``, ``max_findings`` as for
    ``audit_ccd``. Returns an Audit.
    """
    if seconds is None and count is None:
        raise UsageError("expected seconds=, count= or both")
    if not hasattr(_core, "adversarial_queries"):
        raise UsageError("this noli was built without audits; build it with NOLI_WITH_AUDIT=ON")
    pairs = words(pairs)
    if not pairs:
        raise UsageError(f"pairs: expected one of {', '.join(ASKED)} at least")
    for pair in pairs:
        _require_pair(pair)
    if count is not None:
        whole(count, "count", 1)
    limit = LONGEST if seconds is None else distance(seconds, "seconds")
    audit, end, each, round_number = Audit(exact, max_findings), clock.monotonic() + limit, 64, 0
    while clock.monotonic() < end and (count is None or audit.asked < count):
        for pair in pairs:
            names, x_t0, x_t1 = _core.adversarial_queries(_number(pair), seed, round_number, each)
            if count is not None:
                x_t0, x_t1 = x_t0[: max(0, count - audit.asked)], x_t1[: max(0, count - audit.asked)]
            _ask(audit, function, pair, x_t0, x_t1, lambda row, names=names: names[row // each])
        round_number += 1
    audit._choose()
    if shrink:
        simpler = [_simpler(function, finding, audit, end) for finding in audit.findings]
        once = {(f.pair, f.fault, f.x_t0.tobytes(), f.x_t1.tobytes()): f for f in reversed(simpler)}
        audit.findings = [f for f in simpler if once[f.pair, f.fault, f.x_t0.tobytes(), f.x_t1.tobytes()] is f]
    return audit


def _number_or_none(value):
    """Bool as it is; None for what JSON has no number for."""
    return value if isinstance(value, bool) or np.isfinite(value) else None


def _require_pair(pair):
    if pair not in ASKED:
        raise InputError(f"pair: expected one of {', '.join(ASKED)}, found {pair!r}")


def _number(pair):
    return int(np.flatnonzero(PAIRS == pair)[0])


def _times(function, pair, x_t0, x_t1):
    """(hits, times, answers) of the function; times is None where it answers yes or no."""
    answers = np.asarray(function(pair, x_t0, x_t1))
    if answers.shape != (len(x_t0),):
        raise InputError(f"the function's answers have the shape {answers.shape}; expected ({len(x_t0)},)")
    if answers.dtype == bool:
        return answers, None, answers
    if answers.dtype.kind != "f":
        raise InputError(f"the function's answers are {answers.dtype}; expected bool, or times as floating-point numbers")
    times = answers.astype(np.float64)
    return ~(np.isnan(times) | np.isposinf(times)), times, times


def _faults(function, pair, x_t0, x_t1, exact):
    """By query the number of its fault in FAULTS, or -1; the answers, and the truth."""
    truth = contacts(pair, x_t0, x_t1)
    hits, times, answers = _times(function, pair, x_t0.copy(), x_t1.copy())
    fault = np.full(len(x_t0), -1)
    fault[~truth.touches & hits] = FAULTS.index("false_positive")
    if times is not None:
        both = truth.touches & hits
        fault[both & (times < truth.time)] = FAULTS.index("early")
        fault[both & (times > np.nextafter(truth.time, np.inf))] = FAULTS.index("late")
        fault[hits & ((times < 0) | (times > 1))] = FAULTS.index("bad_time")
    fault[truth.touches & ~hits] = FAULTS.index("false_negative")
    return fault, answers, truth


def _ask(audit, function, pair, x_t0, x_t1, generator=None):
    if not len(x_t0):
        return
    fault, answers, truth = _faults(function, pair, x_t0, x_t1, audit.exact)
    audit.asked += len(x_t0)
    audit.contacts += int(np.count_nonzero(truth.touches))
    for number, name in enumerate(FAULTS):
        rows = np.flatnonzero(fault == number)
        audit.faults[name] += len(rows)
        for row in rows if audit.counts(name) else ():
            kind, made_by = str(truth.kind[row]), "" if generator is None else generator(int(row))
            if audit._room(pair, name, kind, made_by) <= 0:
                continue
            audit._keep(
                Finding(
                    fault=name,
                    pair=pair,
                    x_t0=x_t0[row].copy(),
                    x_t1=x_t1[row].copy(),
                    kind=kind,
                    time=float(truth.time[row]),
                    answer=answers[row].item(),
                    generator=made_by,
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
    _, answers, truth = _faults(function, finding.pair, x_t0[np.newaxis], x_t1[np.newaxis], audit.exact)
    members = dict(finding.__dict__, x_t0=x_t0, x_t1=x_t1, time=float(truth.time[0]), answer=answers[0].item())
    return Finding(**members)
