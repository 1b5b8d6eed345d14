# SPDX-License-Identifier: Apache-2.0
"""Writes the evaluated meshes of a Blender file as frames that Noli reads.

    blender -b scene.blend -P blender_frames.py -- frames.npz [FIRST LAST]
    noli verify frames.npz

All meshes that are visible and rendered become one mesh, in world coordinates: also instances of collections, of
particles and of geometry nodes. Modifiers, shape keys, simulations and animation are evaluated. Polygons are cut as
Blender cuts them; every frame has to have the triangles of the first one. Blender evaluates meshes in single precision,
so the coordinates are float32.
"""

import sys

import bpy
import numpy as np


def meshes_of(depsgraph):
    """(evaluated object, world matrix) of every mesh and instance of one, in an order that stays from frame to frame."""
    found = []
    for instance in depsgraph.object_instances:
        thing = instance.object
        if thing.type == "MESH" and instance.show_self and not thing.original.hide_render:
            place = (thing.name, instance.parent.name if instance.parent else "", tuple(instance.persistent_id))
            found.append((place, thing.original, np.array(instance.matrix_world, np.float64)))
    return [(thing, world) for _, thing, world in sorted(found, key=lambda item: item[0])]


def evaluated(depsgraph):
    """Vertices in world coordinates, and triangles, of everything."""
    points, triangles, first = [np.empty((0, 3), np.float32)], [np.empty((0, 3), np.int32)], 0
    for original, world in meshes_of(depsgraph):
        thing = original.evaluated_get(depsgraph)
        mesh = thing.to_mesh()
        mesh.calc_loop_triangles()
        local, corners = np.empty(3 * len(mesh.vertices), np.float32), np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.vertices.foreach_get("co", local)
        mesh.loop_triangles.foreach_get("vertices", corners)
        points.append((local.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3]).astype(np.float32))
        triangles.append(corners.reshape(-1, 3) + first)
        first += len(mesh.vertices)
        thing.to_mesh_clear()
    return np.concatenate(points), np.concatenate(triangles)


def main(output, first=None, last=None):
    scene = bpy.context.scene
    numbers = range(scene.frame_start if first is None else first, (scene.frame_end if last is None else last) + 1)
    frames, faces = [], None
    for number in numbers:
        scene.frame_set(number)
        vertices, found = evaluated(bpy.context.evaluated_depsgraph_get())
        if faces is None:
            faces = found
        if not np.array_equal(found, faces) or (frames and len(vertices) != len(frames[0])):
            sys.exit(f"frame {number}: has other triangles than the first frame; expected the same mesh in all")
        frames.append(vertices)
    np.savez(output, vertices=np.array(frames), faces=faces)
    print(f"{output}: {len(frames)} frames, {len(frames[0])} vertices, {len(faces)} faces")


if __name__ == "__main__":
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    if len(given) not in (1, 3):
        sys.exit("expected: blender -b FILE.blend -P blender_frames.py -- FRAMES.npz [FIRST LAST]")
    main(given[0], *map(int, given[1:]))
