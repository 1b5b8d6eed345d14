# SPDX-License-Identifier: Apache-2.0
"""Single queries: did two features meet while each of their points moved along a straight line?"""

from __future__ import annotations

from typing import Any, NoReturn

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import numbers
from ._errors import InputError
from ._options import threads_of
from ._words import KINDS, PAIRS, POINTS, no_truth

CORNERS = {pair: sum(points) for pair, points in POINTS.items()}
PLANAR = ("vertex_edge", "vertex_vertex")


class Contacts:
    """The answers to m queries. It is not a bool, but has arrays of them.

    Attributes
    ----------
    touches : (m,) bool
        Whether the features meet at some t in [0, 1], both ends included.
    kind : (m,) str, or None
        "apart", "touching", "crossing" or "persistent", judged at the first time.
    time : (m,) float64, or None
        The largest double not above the first time; NaN where they stay apart.
    """

    def __init__(self, touches: Any, kind: Any, time: Any) -> None:
        self.touches, self.time = touches, time
        self.kind = None if kind is None else KINDS[kind]

    def __bool__(self) -> NoReturn:
        no_truth(self)

    def __len__(self) -> int:
        return len(self.touches)

    def __repr__(self):
        return f"<noli.Contacts: {np.count_nonzero(self.touches)} of {len(self)} queries in contact>"


def contacts(pair: str, x_t0: ArrayLike, x_t1: ArrayLike, *, times: bool = True, threads: int = 0) -> Contacts:
    """Decides queries exactly, whatever their numbers.

    Parameters
    ----------
    pair : str
        "vertex_face": points v, f0, f1, f2. "edge_edge": a0, a1, b0, b1. "vertex_edge": v, e0, e1. "vertex_vertex":
        v, w. The last two also in two dimensions.
    x_t0, x_t1 : (m, points, 3 or 2), or (points, 3 or 2) for one query
        At t = 0 and at t = 1, in any unit of length.
    times : bool
        Also finds kind and time of each contact, which takes longer.
    threads : int
        0: all.

    Returns
    -------
    Contacts

    Raises
    ------
    InputError
        Another shape or type, numbers that are not finite.
    """
    begin, end = _points(pair, x_t0, "x_t0"), _points(pair, x_t1, "x_t1")
    if begin.shape != end.shape:
        raise InputError(f"x_t1: has the shape {end.shape}; expected that of x_t0, {begin.shape}")
    return Contacts(*_core.contacts(int(np.flatnonzero(PAIRS == pair)[0]), begin, end, bool(times), threads_of(threads)))


def vertex_face_contact(x_t0: ArrayLike, x_t1: ArrayLike, *, times: bool = True, threads: int = 0) -> Contacts:
    """``contacts("vertex_face", ...)``: (m, 4, 3) each, the vertex first."""
    return contacts("vertex_face", x_t0, x_t1, times=times, threads=threads)


def edge_edge_contact(x_t0: ArrayLike, x_t1: ArrayLike, *, times: bool = True, threads: int = 0) -> Contacts:
    """``contacts("edge_edge", ...)``: (m, 4, 3) each, the points of one edge, then of the other."""
    return contacts("edge_edge", x_t0, x_t1, times=times, threads=threads)


def vertex_edge_contact(x_t0: ArrayLike, x_t1: ArrayLike, *, times: bool = True, threads: int = 0) -> Contacts:
    """``contacts("vertex_edge", ...)``: (m, 3, 3 or 2) each, the vertex first."""
    return contacts("vertex_edge", x_t0, x_t1, times=times, threads=threads)


def vertex_vertex_contact(x_t0: ArrayLike, x_t1: ArrayLike, *, times: bool = True, threads: int = 0) -> Contacts:
    """``contacts("vertex_vertex", ...)``: (m, 2, 3 or 2) each."""
    return contacts("vertex_vertex", x_t0, x_t1, times=times, threads=threads)


def _points(pair, value, what):
    if pair not in CORNERS:
        raise InputError(f"pair: expected one of {', '.join(CORNERS)}, found {pair!r}")
    array = numbers(value, what)
    if array.ndim == 2:
        array = array[np.newaxis]
    sizes = (3, 2) if pair in PLANAR else (3,)
    if array.ndim != 3 or array.shape[1] != CORNERS[pair] or array.shape[2] not in sizes:
        expected = f"(m, {CORNERS[pair]}, {' or '.join(map(str, sizes))})"
        raise InputError(f"{what}: has the shape {array.shape}; expected {expected}")
    return np.ascontiguousarray(array, np.float64)
