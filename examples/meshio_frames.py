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


def outer(cells, sides):
    """The sides that belong to one cell alone."""
    every = cells[:, sides].reshape(-1, len(sides[0]))
    _, where, count = np.unique(np.sort(every, axis=1), axis=0, return_index=True, return_counts=True)
    return every[where[count == 1]]


def collision_mesh(mesh):
    """The surface of a meshio.Mesh."""
    faces, edges = [np.empty((0, 3), int)], [np.empty((0, 2), int)]
    for block in mesh.cells:
        cells = np.asarray(block.data)
        if block.type in ("triangle", "quad", "polygon"):
            faces.append(cut(cells))
        elif block.type == "line":
            edges.append(cells)
        elif block.type in SIDES:
            faces.append(cut(outer(cells, SIDES[block.type])))
        elif block.type != "vertex":
            sys.exit(f"cells of type {block.type} are not known here; expected {', '.join(SIDES)}, triangle, quad, line")
    return noli.CollisionMesh(np.concatenate(faces), edges=np.concatenate(edges))


def welded(mesh, points):
    """The mesh with one vertex for points that are equal, and the numbers of the points that stay."""
    _, keep, number = np.unique(points, axis=0, return_index=True, return_inverse=True)
    return noli.CollisionMesh(number[mesh.faces], edges=number[mesh.edges]), keep


def read(names):
    """Positions (frames, vertices, 3), and the mesh of the first file."""
    first = meshio.read(names[0])
    mesh, keep = collision_mesh(first), np.arange(len(first.points))
    if names[0].lower().endswith(".stl"):
        mesh, keep = welded(mesh, first.points)
    frames = [np.asarray(meshio.read(name).points)[keep] for name in names]
    return np.array(frames), mesh


def main(names):
    frames, mesh = read(names)
    result = noli.verify(frames, mesh, at_rest=len(names) == 1)
    print(result)
    return {"proved": 0, "no_contact": 0, "contact": 1, "too_near": 1}.get(result.verdict, 2)


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
