# SPDX-License-Identifier: Apache-2.0
"""Arrays as the module in C++ takes them. Numbers are never rounded; one that float64 cannot hold is an error."""

from __future__ import annotations

import numpy as np

from ._errors import InputError

MOST_ROWS = 2**31 - 1
MOST_WHOLE = 2**53  # up to here every whole number is a double


def numbers(value, what):
    """An array of float32 or float64 in the machine's byte order, not copied if it is one already."""
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        raise InputError(f"{what}: some numbers are masked; expected all of them")
    try:
        array = np.asarray(value)
    except (ValueError, TypeError) as error:
        raise InputError(f"{what}: cannot be read as an array: {error}") from None
    if array.dtype.newbyteorder("=") in (np.float32, np.float64):
        return array.astype(array.dtype.newbyteorder("="), copy=False)
    if array.dtype == object or array.dtype.kind not in "fiub":
        raise InputError(f"{what}: expected numbers, found an array of {array.dtype}")
    exact = array.astype(np.float64)
    if not _is_exact(array, exact):
        raise InputError(f"{what}: some {array.dtype} numbers are not exact as float64; pass float32 or float64")
    return exact


def _is_exact(array, exact):
    if array.dtype.kind in "iub":
        return array.size == 0 or (int(array.max()) <= MOST_WHOLE and int(array.min()) >= -MOST_WHOLE)
    return np.array_equal(exact.astype(array.dtype), array, equal_nan=True)


def positions(value, what, dimensions=2):
    """Coordinates of shape (..., vertices, 2 or 3)."""
    array = numbers(value, what)
    if array.ndim != dimensions or array.shape[-1] not in (2, 3):
        shape = "(frames, vertices, 2 or 3)" if dimensions == 3 else "(vertices, 2 or 3)"
        raise InputError(f"{what}: has the shape {array.shape}; expected {shape}")
    if array.shape[-2] > MOST_ROWS:
        raise InputError(f"{what}: has {array.shape[-2]} vertices; expected at most {MOST_ROWS}")
    return array


def indices(value, columns, what):
    """Numbers of vertices of shape (n, columns), or (n,) for one column, as int64."""
    try:
        array = np.asarray([] if value is None else value)
    except (ValueError, TypeError) as error:
        raise InputError(f"{what}: cannot be read as an array: {error}") from None
    if array.size == 0:
        array = np.empty((0,) if columns == 1 else (0, columns), np.int64)
    if array.dtype.kind not in "iu":
        raise InputError(f"{what}: expected whole numbers, found an array of {array.dtype}")
    if array.ndim != (1 if columns == 1 else 2) or (columns > 1 and array.shape[1] != columns):
        shape = "(n,)" if columns == 1 else f"(n, {columns})"
        raise InputError(f"{what}: has the shape {array.shape}; expected {shape}")
    if array.shape[0] > MOST_ROWS:
        raise InputError(f"{what}: has {array.shape[0]} rows; expected at most {MOST_ROWS}")
    if array.size and (array.min() < 0 or array.max() > MOST_ROWS):
        bad = array.min() if array.min() < 0 else array.max()
        raise InputError(f"{what}: there is no vertex {bad}")
    own = np.array(array, np.int64, order="C")  # nobody changes it once it has been checked
    own.flags.writeable = False
    return own
