#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the frames of a square sheet that folds onto itself slowly, as binary PLY with float32 coordinates.

    bench/folding_sheet.py FOLDER [--side 225] [--frames 161] [--until 1]

--side: vertices along an edge, so there are 2 (side - 1)² faces. --until: the share of the motion that the frames show. Nothing touches.
Needs numpy.
"""
import argparse
import pathlib

import numpy as np

BEND = 0.15  # the radius of the bend, where half the edge is 1
ANGLE = 0.97 * np.pi  # at the end


def positions(side, share):
    """The sheet after this share of its motion."""
    u, v = np.meshgrid(np.linspace(-1, 1, side), np.linspace(-1, 1, side), indexing="ij")
    angle = ANGLE * share
    turned = np.clip(u, 0, BEND * angle) / BEND
    straight = np.maximum(u - BEND * angle, 0)
    x = np.minimum(u, 0) + BEND * np.sin(turned) + straight * np.cos(angle)
    z = BEND * (1 - np.cos(turned)) + straight * np.sin(angle) + 0.003 * np.sin(9 * v + 3 * u)
    return np.stack([x, v, z], -1).reshape(-1, 3).astype("<f4")


def faces_of(side):
    i = np.arange(side * side).reshape(side, side)
    a, b, c, d = i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]
    return np.concatenate([np.stack(corners, -1).reshape(-1, 3) for corners in ((a, b, c), (a, c, d))])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--side", type=int, default=225)
    parser.add_argument("--frames", type=int, default=161)
    parser.add_argument("--until", type=float, default=1)
    asked = parser.parse_args()
    faces = faces_of(asked.side)
    rows = np.zeros(len(faces), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    rows["count"], rows["corners"] = 3, faces
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {asked.side**2}\nproperty float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    asked.folder.mkdir(parents=True, exist_ok=True)
    for k in range(asked.frames):
        x = positions(asked.side, asked.until * k / max(1, asked.frames - 1))
        (asked.folder / f"f_{k:04}.ply").write_bytes(head.encode() + x.tobytes() + rows.tobytes())


main()
