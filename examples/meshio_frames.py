# SPDX-License-Identifier: Apache-2.0
"""Verifies frames in any of the formats that meshio reads: Abaqus, Gmsh, STL, XDMF and about thirty more.

    python3 meshio_frames.py frame_1.msh frame_2.msh ...

Triangles and lines are taken as they are; quadrilaterals are cut into two triangles as Noli cuts them. Of tetrahedra
and hexahedra the outer faces count. Files that list each triangle with corners of its own, as STL does, have their
equal points merged in the first frame.
"""

import sys

import meshio
import noli
import numpy as np

# The faces of a cell of volume, by the numbers of its corners.
SIDES = {
    "tetra": [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]],
    "hexahedron": [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]],
}


def cut(polygons):
    """Polygons (n, corners) as triangles, in a fan."""
    return np.concatenate([polygons[:, [0, k, k + 1]] for k in range(1, polygons.shape[1] - 1)])


def outer(sides):
    """The sides that belong to one cell alone, of all cells of volume."""
    every = np.concatenate(sides)
    _, where, count = np.unique(np.sort(every, axis=1), axis=0, return_index=True, return_counts=True)
    return every[where[count == 1]]


def cells_of(mesh):
    """Faces and edges of a meshio.Mesh. Raises ValueError."""
    faces, edges, sides = [np.empty((0, 3), int)], [np.empty((0, 2), int)], {3: [], 4: []}
    for block in mesh.cells:
        cells = np.asarray(block.data)
        if block.type in ("triangle", "quad", "polygon"):
            faces.append(cut(cells))
        elif block.type == "line":
            edges.append(cells)
        elif block.type in SIDES:
            corners = len(SIDES[block.type][0])
            sides[corners].append(cells[:, SIDES[block.type]].reshape(-1, corners))
        elif block.type != "vertex":
            known = ", ".join([*SIDES, "triangle", "quad", "line"])
            raise ValueError(f"cells of type {block.type} are not known here; expected {known}")
    faces += [cut(outer(found)) for found in sides.values() if found]
    return np.concatenate(faces), np.concatenate(edges)


def read(names):
    """Positions (frames, vertices, 3), and the mesh of all files. Raises ValueError where meshes differ."""
    frames, first = [], None
    for name in map(str, names):
        mesh = meshio.read(name)
        points, found = np.asarray(mesh.points), cells_of(mesh)
        if first is None:
            first, keep, number = found, np.arange(len(points)), np.arange(len(points))
            if name.lower().endswith(".stl"):  # one vertex for points that are equal in the first file
                _, keep, number = np.unique(points, axis=0, return_index=True, return_inverse=True)
        elif len(points) != len(number) or not all(np.array_equal(a, b) for a, b in zip(first, found)):
            raise ValueError(f"{name}: has another mesh than {names[0]}; expected the same cells in every file")
        frames.append(points[keep])
    number = number.ravel()
    return np.array(frames), noli.CollisionMesh(number[first[0]], edges=number[first[1]])


def main(names):
    """The exit code of ``noli verify``."""
    try:
        frames, mesh = read(names)
        result = noli.verify(frames, mesh, at_rest=len(names) == 1)
    except (OSError, ValueError, meshio.ReadError) as error:
        print(error, file=sys.stderr)
        return 3
    print(result)
    return {"proved": 0, "no_contact": 0, "contact": 1, "too_near": 1}.get(result.verdict, 2)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        print(__doc__, file=sys.stderr)
        sys.exit(3)
    try:
        sys.exit(main(sys.argv[1:]))
    except Exception as error:  # 1 would say that something touches
        print(f"{type(error).__name__}: {error}", file=sys.stderr)
        sys.exit(4)
