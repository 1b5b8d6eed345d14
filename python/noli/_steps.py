# SPDX-License-Identifier: Apache-2.0
"""One step of a mesh, inside a solver's loop, and one moment of it."""

from __future__ import annotations

import threading
from typing import Any, NoReturn, Optional

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import positions
from ._errors import Contact, InputError
from ._mesh import as_mesh
from ._options import dimension_of, threads_of, whole
from ._types import Features, Floats, Integers, Mesh
from ._verify import CONTACTS
from ._words import KINDS, PAIRS, POINTS, no_truth


class Impact:
    """The first contact of a step. It is not a bool: ask ``touches``.

    Attributes
    ----------
    touches : bool
    time : float
        The largest double not above the exact first time, in [0, 1] of the step; infinite where nothing touches.
    kind, pair, features, point
        As FirstContact has them; None where nothing touches, or cells intersect as the step begins (``time`` is 0).
    """

    def __init__(self, touches: bool, found: Any) -> None:
        self.touches = touches
        self.time: float = found["time"] if found else 0.0 if touches else float("inf")
        self.kind: Optional[str] = None
        self.pair: Optional[str] = None
        self.features: Optional[Features] = None
        self.point: Optional[Floats] = None
        if found:
            self.kind, self.pair = str(KINDS[found["kind"]]), str(PAIRS[found["pair"]])
            first = POINTS[self.pair][0]
            self.features = (tuple(found["vertices"][:first]), tuple(found["vertices"][first:]))
            self.point = np.array(found["point"])

    def __bool__(self) -> NoReturn:
        no_truth(self)

    def __float__(self) -> float:
        return self.time

    def __repr__(self):
        return f"<noli.Impact: t = {self.time}, {self.kind} {self.pair}>" if self.touches else "<noli.Impact: none>"


def time_of_impact(
    x_t0: ArrayLike, x_t1: ArrayLike, mesh: Mesh, *, dimension: Optional[int] = None, threads: int = 0
) -> Impact:
    """When the mesh first touches itself as each vertex moves along a straight line from x_t0 to x_t1.

    Parameters
    ----------
    x_t0, x_t1 : (vertices, 3 or 2), float32 or float64
    mesh : CollisionMesh, or (n, 3) faces
    dimension : 2 or 3, optional
        2 ignores z. Default: 2 if both have one z, else 3.
    threads : int
        0: all.

    Returns
    -------
    Impact

    Raises
    ------
    InputError
        Another shape or type, numbers that are not finite.
    """
    begin, end, cells = _step(x_t0, x_t1, mesh)
    steps = _steps_of(cells, begin, end, dimension, False, threads)
    touches = steps.step(begin, end)
    return Impact(touches, None if steps.intersection_count() else steps.first())


class FreeStep:
    """A part of a step that touches nothing. It is not a bool: ask ``free``.

    Attributes
    ----------
    step : float
        The share of the step that is taken, in [0, 1].
    positions : (vertices, 3 or 2)
        Where it ends, in the type of x_t1; straight lines from x_t0 to exactly these numbers were decided to touch
        nothing.
    free : bool
        False if x_t0 touches itself: ``step`` is then 0, and ``positions`` are x_t0.
    """

    def __init__(self, step: float, positions: Floats, free: bool) -> None:
        self.step, self.positions, self.free = step, positions, free

    def __bool__(self) -> NoReturn:
        no_truth(self)

    def __repr__(self):
        return f"<noli.FreeStep: step {self.step}>" if self.free else "<noli.FreeStep: x_t0 touches itself>"


def collision_free_step(
    x_t0: ArrayLike,
    x_t1: ArrayLike,
    mesh: Mesh,
    *,
    safety: float = 0.9,
    dimension: Optional[int] = None,
    threads: int = 0,
) -> FreeStep:
    """How far a step can go. The whole step if that touches nothing, else ``safety`` of the way to the first contact.

    Parameters as for ``time_of_impact``; ``safety`` is in (0, 1). Returns a FreeStep. Raises InputError.
    """
    if not 0 < safety < 1:
        raise InputError(f"safety: expected a number between 0 and 1, found {safety}")
    begin, end, cells = _step(x_t0, x_t1, mesh)
    steps = _steps_of(cells, begin, end, dimension, False, threads)
    share, there, free = steps.free_step(begin, end, float(safety))
    return FreeStep(share, there[:, : end.shape[1]].astype(end.dtype), free)


class Intersections:
    """Where a mesh at rest meets itself. It is not a bool: ask ``count``.

    Attributes
    ----------
    count : int
        Pairs of cells whose vertex-disjoint parts meet.
    pairs : (n, 2) int64
        The first ``max_reports`` of them, by number of cell, ascending.
    """

    def __init__(self, count: int, pairs: Integers) -> None:
        self.count, self.pairs = count, pairs

    def __bool__(self) -> NoReturn:
        no_truth(self)

    def __len__(self) -> int:
        return self.count

    def __repr__(self):
        return f"<noli.Intersections: {self.count} pairs of cells>"


def self_intersections(
    x: ArrayLike, mesh: Mesh, *, max_reports: int = 100_000, dimension: Optional[int] = None, threads: int = 0
) -> Intersections:
    """Which cells meet as the mesh stands at x, (vertices, 3 or 2). Returns Intersections. Raises InputError."""
    there, _, cells = _step(x, x, mesh)
    steps = _steps_of(cells, there, there, dimension, True, threads, max_reports)
    steps.step(there, there)
    return Intersections(steps.intersection_count(), steps.intersections())


class LeastDistance:
    """``allowed`` holds: all features that are compared are more than this apart. ``limit`` does not."""

    def __init__(self, allowed: float, limit: float) -> None:
        self.allowed, self.limit = allowed, limit

    def __float__(self) -> float:
        return self.allowed

    def __repr__(self):
        return f"<noli.LeastDistance: more than {self.allowed}, not more than {self.limit}>"


def largest_min_distance(
    x: ArrayLike, mesh: Mesh, *, ring: int = 1, dimension: Optional[int] = None, threads: int = 0
) -> Optional[LeastDistance]:
    """The largest ``min_distance`` that holds for the mesh as it stands at x, within a millionth.

    Features fewer than ``ring`` mesh edges apart may be nearer. Returns a LeastDistance, both of its numbers 0 if the
    mesh meets itself; None if there are no two features to compare. Raises InputError.
    """
    there, _, cells = _step(x, x, mesh)
    if cells.cell_count < 2:
        return None
    found = _steps_of(cells, there, there, dimension, False, threads).largest_distance(there, whole(ring, "ring", 1, 255))
    return None if found is None else LeastDistance(*found)


class Certifier:
    """Decides each step of a solver as it is made.

        with noli.Certifier(mesh, x0) as certifier:
            for x in solver:
                certifier.step(x)          # raises noli.Contact with .time and .pairs (pair, vertices)

    After a Contact the certifier is where it was, so that another, shorter step can be tried.

    Parameters
    ----------
    mesh : CollisionMesh, or (n, 3) faces
    x0 : (vertices, 2 or 3)
        Where the mesh begins.
    dimension : 2 or 3, optional
        2 ignores z. Default: as many as ``x0`` has coordinates. In the plane, faces are filled: what is inside touches.
    threads, max_reports
        As for ``noli.verify``.

    Attributes
    ----------
    x : (vertices, 2 or 3)
        Where the mesh is: a copy.
    steps : int
        How many steps were free.

    Raises
    ------
    InputError, UsageError
    Contact
        If the mesh intersects itself at ``x0``.
    """

    def __init__(
        self, mesh: Mesh, x0: ArrayLike, *, dimension: Optional[int] = None, threads: int = 0, max_reports: int = 100
    ) -> None:
        self._x, self.mesh = positions(x0, "x0").copy(), as_mesh(mesh)
        self.mesh._require_vertices(len(self._x))
        self._steps = 0
        self._dimension = self._x.shape[1] if dimension is None else dimension  # a step may leave the plane of those before it
        self._threads, self._reports = threads, max_reports
        found = self_intersections(self._x, self.mesh, dimension=self._dimension, threads=threads, max_reports=max_reports)
        if found.count:
            raise Contact(f"x0: {found.count} pairs of cells intersect", found, None, np.empty(0, CONTACTS))
        self._decide: Any = None
        self._lock = threading.RLock()

    @property
    def x(self) -> Floats:
        return self._x.copy()

    @property
    def steps(self) -> int:
        return self._steps

    def __repr__(self) -> str:
        return f"<noli.Certifier: {self.steps} free steps, {self.mesh!r}>"

    def __enter__(self) -> Certifier:
        return self

    def __exit__(self, *exception: object) -> None:
        self._decide = None

    def step(self, x: ArrayLike) -> Impact:
        """Goes on to x if straight lines from here to there touch nothing. Raises Contact.

        The Impact that it returns says so; a loop does not need it."""
        with self._lock:
            return self._step(positions(x, "x"))

    def _step(self, there: Any) -> Impact:
        if there.shape != self._x.shape:
            raise InputError(f"x: has the shape {there.shape}; expected {self._x.shape}")
        if self._decide is None:
            self._decide = _steps_of(self.mesh, self._x, there, self._dimension, False, self._threads, self._reports)
        touches = self._decide.step(self._x, there)
        impact = Impact(touches, None if self._decide.intersection_count() else self._decide.first())
        if touches:
            count = self._decide.contact_count()
            text = f"step {self.steps + 1}: {count} pairs of features touch, first at t = {impact.time}"
            raise Contact(text, impact, impact.time, self._pairs())
        self._x, self._steps = there.copy(), self._steps + 1
        return impact

    def _pairs(self):
        found = self._decide.pairs()
        rows = np.zeros(len(found), [("pair", "U13"), ("vertices", np.int64, 4)])
        rows["pair"], rows["vertices"] = PAIRS[found[:, 0]], found[:, 1:]
        return rows


def _step(x_t0, x_t1, mesh):
    x_t0, x_t1, mesh = positions(x_t0, "x_t0"), positions(x_t1, "x_t1"), as_mesh(mesh)
    if x_t0.shape != x_t1.shape:
        raise InputError(f"x_t1: has the shape {x_t1.shape}; expected that of x_t0, {x_t0.shape}")
    mesh._require_vertices(len(x_t0))
    return x_t0, x_t1, mesh


def _steps_of(mesh, x_t0, x_t1, dimension, at_rest, threads, max_reports=100):
    dimension_of(dimension)
    flat = all(x.shape[1] == 2 or (len(x) > 0 and np.all(x[:, 2] == x[0, 2])) for x in (x_t0, x_t1))
    dimension = dimension or (2 if flat else 3)
    return _core.Steps(
        mesh, len(x_t0), dimension, at_rest, threads_of(threads), whole(max_reports, "max_reports", 0)
    )
