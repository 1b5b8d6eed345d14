# SPDX-License-Identifier: Apache-2.0
"""What moves: cells by the numbers of their vertices, the bodies they make up, and what is not compared."""

from __future__ import annotations

import json
from typing import Any, Iterable, Mapping, Optional, Sequence

import numpy as np
from numpy.typing import ArrayLike

from ._arrays import indices
from ._errors import InputError, UsageError


class CollisionMesh:
    """Cells of a mesh, without coordinates.

    Parameters
    ----------
    faces : (n, 3) whole numbers
        Triangles, by the numbers of their vertices from 0.
    edges : (n, 2) whole numbers, optional
        Edges that belong to no face: cables, hair. Edges of faces need not be listed, and are dropped if they are.
    points : (n,) whole numbers, optional
        Vertices that are particles. Vertices of faces and edges are dropped.
    vertex_count : int, optional
        How many vertices there are. Default: as many as the positions have.
    bodies : dict of name to (n,) whole numbers, optional
        Vertices of each body. Contacts are then named by bodies, and ``ignore`` can leave pairs of them out.
    ignore : list of pairs of names, optional
        Bodies whose cells are not compared with each other; ``("a", "a")``: not with those of the same body.

    All of these are attributes too, as arrays, and ``bodies`` as a dict of them; ``body_of_vertex(v)`` names a body.

    Features of cells are compared if they share no vertex. Cells are numbered: faces, then edges, then points.

    Raises
    ------
    InputError
        An array of another shape or type, a vertex that does not exist, a cell with vertices of two bodies.
    UsageError
        ``ignore`` names no body.
    """

    def __init__(
        self,
        faces: Optional[ArrayLike] = None,
        *,
        edges: Optional[ArrayLike] = None,
        points: Optional[ArrayLike] = None,
        vertex_count: Optional[int] = None,
        bodies: Optional[Mapping[str, ArrayLike]] = None,
        ignore: Optional[Iterable[Sequence[str]]] = None,
    ) -> None:
        try:
            self.faces = indices(faces, 3, "faces")
        except InputError as error:
            raise InputError(f"{error}; expected triangles, by numbers of vertices from 0") from None
        self.edges = indices(edges, 2, "edges")
        self.points = indices(points, 1, "points")
        self._drop_parts()
        self.vertex_count = vertex_count
        self.bodies = {str(name): indices(of, 1, f"bodies[{name!r}]") for name, of in (bodies or {}).items()}
        self.ignore = [(pair,) if isinstance(pair, str) else tuple(pair) for pair in ignore or []]
        for pair in self.ignore:
            if len(pair) != 2 or any(name not in self.bodies for name in pair):
                raise UsageError(f"ignore: expected a pair of bodies of {sorted(self.bodies)}, found {pair!r}")
        if vertex_count is not None:
            self._require_vertices(vertex_count)
        self._require_whole_cells()

    @property
    def cell_count(self) -> int:
        """Number of faces, edges and points."""
        return len(self.faces) + len(self.edges) + len(self.points)

    def __repr__(self):
        parts = [f"{len(cells)} {name}" for name, cells in self._cells().items() if len(cells)]
        return f"<noli.CollisionMesh: {', '.join(parts) or 'no cells'}>"

    def _cells(self):
        return {"faces": self.faces, "edges": self.edges, "points": self.points}

    def _drop_parts(self):
        """Leaves out edges and points that are parts of other cells, or listed before: they add nothing to compare."""
        if len(self.edges):
            # Not np.unique(axis=0): it is slow, and turns a KeyboardInterrupt into a TypeError.
            sides = np.sort(self.faces[:, [[0, 1], [1, 2], [0, 2]]].reshape(-1, 2), axis=1)
            both = np.concatenate([sides, np.sort(self.edges, axis=1)])
            order = np.lexsort(both.T)  # rows that are equal stay in order
            rows = both[order]
            first = order[np.append(True, np.any(rows[1:] != rows[:-1], axis=1))]
            keep = np.sort(first[first >= len(sides)]) - len(sides)
            self.edges = indices(self.edges[keep], 2, "edges")
        _, first = np.unique(self.points, return_index=True)
        points = self.points[np.sort(first)]
        self.points = indices(points[~np.isin(points, [*self.faces.ravel(), *self.edges.ravel()])], 1, "points")

    def _require_vertices(self, count):
        """Raises InputError unless every number is below ``count``."""
        named = [*self._cells().items(), *((f"bodies[{name!r}]", of) for name, of in self.bodies.items())]
        for name, cells in named:
            if cells.size and not 0 <= cells.min() <= cells.max() < count:
                bad = cells.min() if cells.min() < 0 else cells.max()
                raise InputError(f"{name}: vertex {bad} does not exist; expected 0 to {count - 1}")
        if self.vertex_count not in (None, count):
            raise InputError(f"positions of {count} vertices; expected {self.vertex_count}, the mesh's vertex_count")

    def _consecutive_bodies(self, count):
        """(name, first vertex, vertices, first face, faces) of each body, if all bodies are such runs of both."""
        rows, order = [], sorted(self.bodies.items(), key=lambda item: item[1][0] if len(item[1]) else -1)
        of_face = self._body_of(count)[self.faces[:, 0]] if len(self.faces) else np.empty(0, int)
        names = list(self.bodies)
        for name, vertices in order:
            faces = np.flatnonzero(of_face == names.index(name) + 1)
            if not len(vertices) or not _is_run(vertices) or not _is_run(faces):
                return []
            rows.append((name, int(vertices[0]), len(vertices), int(faces[0]) if len(faces) else 0, len(faces)))
        return rows

    def _body_of(self, count):
        """By vertex, the number of its body from 1; 0: of none."""
        of = np.zeros(count, np.int64)
        for number, (name, vertices) in enumerate(self.bodies.items(), 1):
            if np.any(of[vertices]):
                raise InputError(f"bodies[{name!r}]: vertex {vertices[of[vertices] > 0][0]} also belongs to another body; a vertex has one body")
            of[vertices] = number
        return of

    def _require_whole_cells(self):
        """Raises InputError unless bodies are disjoint, and each cell is of one body or of none."""
        highest = max((int(a.max()) for a in (*self._cells().values(), *self.bodies.values()) if a.size), default=-1)
        if not self.bodies:
            return
        of, names = self._body_of(highest + 1), [None, *self.bodies]
        for what, cells in self._cells().items():
            if what == "points" or not len(cells):
                continue
            mixed = np.flatnonzero((of[cells] != of[cells[:, :1]]).any(axis=1))
            if len(mixed):
                row = mixed[0]
                found = sorted({names[k] or "no body" for k in of[cells[row]]})
                raise InputError(f"{what}: row {row} has vertices of {' and '.join(found)}; expected one body")

    def _groups(self, count, named):
        """The text of GROUPS.json (``noli verify --ignore``), or None."""
        if not self.ignore:
            return None
        groups = {"ignore": [list(pair) for pair in self.ignore]}
        if not (named and self._consecutive_bodies(count)):
            self._body_of(count)
            groups["groups"] = {name: _ranges(vertices) for name, vertices in self.bodies.items()}
        return json.dumps(groups)

    def body_of_vertex(self, vertex: int) -> Optional[str]:
        """The name of the body that has a vertex, or None."""
        return next((name for name, vertices in self.bodies.items() if vertex in vertices), None)


def _is_run(numbers):
    """Whether whole numbers are consecutive and ascending."""
    return len(numbers) == 0 or np.array_equal(numbers, np.arange(numbers[0], numbers[0] + len(numbers)))


def _ranges(vertices):
    """[[first, last], ...] of whole numbers."""
    if not len(vertices):
        return []
    ordered = np.unique(vertices)
    starts = np.flatnonzero(np.diff(ordered, prepend=ordered[0] - 2) != 1)
    ends = np.append(starts[1:], len(ordered)) - 1
    return [[int(ordered[a]), int(ordered[b])] for a, b in zip(starts, ends)]


def as_mesh(mesh: Any) -> CollisionMesh:
    """A CollisionMesh as it is, else one of these faces."""
    if mesh is None:
        raise UsageError("positions in arrays need a mesh: CollisionMesh(faces), or the faces")
    return mesh if isinstance(mesh, CollisionMesh) else CollisionMesh(mesh)
