# SPDX-License-Identifier: Apache-2.0
"""Writes the evaluated meshes of a Blender file as frames that Noli reads.

    blender -b scene.blend -P blender_frames.py -- frames.npz [FIRST LAST]
    noli verify frames.npz

All mesh objects that are rendered become one mesh, in world coordinates. Modifiers, shape keys, simulations and
animation are evaluated; polygons are cut as Blender cuts them, once, in the first frame. Every object has to keep its
number of vertices. Blender evaluates meshes in single precision, so the coordinates are float32.
"""

import sys

import bpy
import numpy as np


def objects_of(scene):
    """Objects that have a mesh, in the order of their names."""
    return sorted((o for o in scene.objects if o.type == "MESH" and not o.hide_render), key=lambda o: o.name)


def evaluated(scene, depsgraph):
    """Vertices of all objects in world coordinates, and how many each has."""
    parts, counts = [], []
    for thing in objects_of(scene):
        there = thing.evaluated_get(depsgraph)
        mesh = there.to_mesh()
        local = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.vertices.foreach_get("co", local)
        world = np.array(there.matrix_world, np.float64)
        parts.append((local.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]).astype(np.float32))
        counts.append(len(mesh.vertices))
        there.to_mesh_clear()
    return np.concatenate(parts) if parts else np.empty((0, 3), np.float32), counts


def triangles(scene, depsgraph):
    """Faces of all objects, by the numbers of vertices that evaluated() gives."""
    parts, first = [], 0
    for thing in objects_of(scene):
        there = thing.evaluated_get(depsgraph)
        mesh = there.to_mesh()
        mesh.calc_loop_triangles()
        corners = np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("vertices", corners)
        parts.append(corners.reshape(-1, 3) + first)
        first += len(mesh.vertices)
        there.to_mesh_clear()
    return np.concatenate(parts) if parts else np.empty((0, 3), np.int32)


def main(output, first=None, last=None):
    scene = bpy.context.scene
    numbers = range(scene.frame_start if first is None else first, (scene.frame_end if last is None else last) + 1)
    frames, faces, expected = [], None, None
    for number in numbers:
        scene.frame_set(number)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        if faces is None:
            faces = triangles(scene, depsgraph)
        vertices, counts = evaluated(scene, depsgraph)
        if expected not in (None, counts):
            sys.exit(f"frame {number}: objects have {counts} vertices; expected {expected} as in the first frame")
        expected = counts
        frames.append(vertices)
    np.savez(output, vertices=np.array(frames), faces=faces)
    print(f"{output}: {len(frames)} frames, {sum(expected or [0])} vertices, {len(faces)} faces")


if __name__ == "__main__":
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    if len(given) not in (1, 3):
        sys.exit("expected: blender -b FILE.blend -P blender_frames.py -- FRAMES.npz [FIRST LAST]")
    main(given[0], *map(int, given[1:]))
