# SPDX-License-Identifier: Apache-2.0
"""Frames, whatever holds them: names of files, one array, a list of arrays, a generator."""

from __future__ import annotations

import os

import numpy as np

from ._arrays import numbers, positions
from ._errors import InputError, UsageError
from ._mesh import as_mesh

NAME = "frames"


class Given:
    """Frames in memory as the module in C++ reads them: from ``array`` by itself, or from ``next(k)``."""

    name = NAME

    def __init__(self, mesh, vertices, *, numbers, count=None, again=False, array=None, next=None):
        mesh._require_vertices(vertices)
        self.mesh, self.vertices, self.numbers = mesh, int(vertices), numbers
        self.count, self.again, self.array, self.next = count, again, array, next


def bodies_in_files(frames, obstacles=None):
    """(name, names of files, whether it stands still) of each body, where frames are a dict of these; else none."""
    if not isinstance(frames, dict):
        if obstacles:
            raise UsageError("obstacles: need frames as a dict of body name to files; in arrays, they are part of the mesh")
        return []
    rows = []
    for still, bodies in ((False, frames), (True, obstacles or {})):
        for name, files in bodies.items():
            names = file_names(files)
            if names is None:
                raise UsageError(f"{name}: expected names of files; bodies in arrays belong to the mesh")
            rows.append((str(name), names, still))
    return rows


def file_names(frames):
    """The names if these are frames in files, else None."""
    if isinstance(frames, dict):
        return [name for files in frames.values() for name in file_names(files) or ()]
    if isinstance(frames, (str, os.PathLike)):
        return [os.fspath(frames)]
    if isinstance(frames, (list, tuple)) and frames and all(isinstance(f, (str, os.PathLike)) for f in frames):
        return [os.fspath(f) for f in frames]
    return None


def given_frames(frames, mesh):
    """Frames in memory. Raises InputError, UsageError."""
    mesh = as_mesh(mesh)
    if isinstance(frames, np.ndarray):
        return _of_array(positions(frames, NAME, 3), mesh)
    if hasattr(frames, "__getitem__") and hasattr(frames, "__len__"):
        return _of_sequence(frames, mesh)
    if hasattr(frames, "__iter__"):
        return _of_iterator(iter(frames), mesh)
    raise InputError(f"{NAME}: expected names of files, an array, a list of arrays or a generator, found {frames!r:.60}")


def _of_array(array, mesh):
    return Given(mesh, array.shape[1], numbers=str(array.dtype), count=len(array), again=True, array=array)


def _of_sequence(frames, mesh):
    if not len(frames):
        raise InputError(f"{NAME}: found none; expected at least two to have a motion")
    first = positions(frames[0], f"{NAME}[0]")
    types = sorted({str(numbers(frame, NAME).dtype) for frame in frames if isinstance(frame, np.ndarray)})

    def next(k):
        return _like(first, positions(frames[k], f"{NAME}[{k}]"), k)

    return Given(mesh, len(first), numbers="/".join(types) or str(first.dtype), count=len(frames), again=True, next=next)


def _of_iterator(frames, mesh):
    start = [positions(frame, f"{NAME}[0]") for frame in _at_most_one(frames)]

    def next(k):
        if start:
            return start.pop()
        for frame in _at_most_one(frames):
            return _like(first, positions(frame, f"{NAME}[{k}]"), k)
        return None

    if not start:
        raise InputError(f"{NAME}: the generator yielded none; expected at least two to have a motion")
    first = start[0]
    return Given(mesh, len(first), numbers=str(first.dtype), next=next)


def _like(first, frame, k):
    """The frame, if it has as many coordinates as the first one."""
    if frame.shape[1] != first.shape[1]:
        raise InputError(f"{NAME}[{k}]: has {frame.shape[1]} coordinates; expected {first.shape[1]} as in the first frame")
    return frame


def _at_most_one(iterator):
    for value in iterator:
        yield value
        return
