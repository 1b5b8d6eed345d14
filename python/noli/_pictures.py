# SPDX-License-Identifier: Apache-2.0
"""A contact, drawn with whatever is installed for that."""

from __future__ import annotations

import importlib
from typing import Any, Optional

import numpy as np

from ._errors import UsageError

BACKENDS = ("matplotlib", "vedo", "polyscope")
COLOURS = np.array([[0.75, 0.78, 0.82], [0.85, 0.15, 0.12], [0.95, 0.75, 0.1]])  # nothing, first, second feature


def plot(shown: Any, backend: Optional[str]) -> Any:
    """Raises UsageError where there is no such package."""
    if backend is not None and backend not in BACKENDS:
        raise UsageError(f"backend: expected one of {', '.join(BACKENDS)}, found {backend!r}")
    for name in [backend] if backend else BACKENDS:
        try:
            importlib.import_module(name)
        except ImportError:
            continue
        return {"matplotlib": _matplotlib, "vedo": _vedo, "polyscope": _polyscope}[name](shown)
    raise UsageError(f"{backend or ' or '.join(BACKENDS)}: is not installed")


def _colours(shown: Any) -> Any:
    """By face."""
    return COLOURS[shown["marks"][: len(shown["faces"])]]


def _radius(shown: Any) -> float:
    """Of the part around the contact: four times the cells that meet."""
    x, faces = shown["positions"], shown["faces"]
    marked = x[faces[shown["marks"][: len(faces)] > 0]]
    size = np.ptp(marked, axis=1).max() if len(marked) else np.ptp(x, axis=0).max()
    return max(4 * float(size), 1e-300)


def _matplotlib(shown: Any) -> Any:
    from matplotlib import pyplot
    from mpl_toolkits.mplot3d.art3d import Line3DCollection, Poly3DCollection

    figure = pyplot.figure(figsize=(8, 6))
    axes = figure.add_subplot(projection="3d")
    x = shown["positions"]
    half = _radius(shown)
    # matplotlib draws beyond the axes, too: only faces inside are drawn.
    inside = (np.abs(x[shown["faces"]] - shown["point"]) <= half).all(axis=(1, 2))
    if inside.any():
        axes.add_collection3d(
            Poly3DCollection(
                x[shown["faces"][inside]],
                facecolors=_colours(shown)[inside],
                edgecolors=(0, 0, 0, 0.2),
                linewidths=0.3,
                alpha=0.7,
            )
        )
    if len(shown["edges"]):
        axes.add_collection3d(Line3DCollection(x[shown["edges"]], colors="black"))
    axes.scatter(*np.array(shown["point"])[:, np.newaxis], color="black", s=30, depthshade=False)
    for axis, centre in zip("xyz", shown["point"]):
        getattr(axes, f"set_{axis}lim")(centre - half, centre + half)
    axes.set_title(f"step {shown['step']}, t = {shown['time']:.6g}")
    return figure


def _vedo(shown: Any) -> Any:
    import vedo

    mesh = vedo.Mesh([shown["positions"], shown["faces"].tolist()])
    mesh.cellcolors = (_colours(shown) * 255).astype(np.uint8)
    plotter = vedo.Plotter()
    plotter.add(mesh, vedo.Point(shown["point"], c="black"))
    return plotter


def _polyscope(shown: Any) -> Any:
    import polyscope

    polyscope.init()
    surface = polyscope.register_surface_mesh("noli", shown["positions"], shown["faces"])
    surface.add_color_quantity("contact", _colours(shown), defined_on="faces", enabled=True)
    polyscope.register_point_cloud("noli contact", np.array([shown["point"]]))
    return polyscope
