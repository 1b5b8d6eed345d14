# SPDX-License-Identifier: Apache-2.0
"""Existing runs: their windows, positions at any time, frames, pictures, pages."""

from __future__ import annotations

import json
import os
from typing import Iterator, Optional, Tuple

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import numbers
from ._errors import UsageError
from ._mesh import CollisionMesh
from ._options import require_ending, require_new, view_options
from ._simulate import Window
from ._types import Floats, Json, Path, Progress
from ._words import progress_of


class Run:
    """The folder of a run, which ``noli.simulate`` or ``noli.repair`` wrote. Iterate over it for its windows.

    Nothing is decided again: ``noli.verify(folder)`` does that.

    Attributes
    ----------
    folder : str
    title : str
    dimension : int
        2 or 3; in 2 every third coordinate is 0.
    record : str
        "full": the whole motion; "frames": frames, and the state at the end of each window.
    mesh : CollisionMesh
        With the bodies that have names.
    windows : int
        How many windows it has.
    end : float
        The end of the last one [s]; 0 without windows.
    """

    def __init__(self, folder: Path) -> None:
        self.folder: str = os.fspath(folder)
        facts = _core.run_facts(self.folder)
        self.title: str = facts["title"]
        self.dimension: int = facts["dimension"]
        self.record: str = facts["record"]
        self.windows: int = facts["windows"]
        self.end: float = facts["end"] or 0.0
        self.mesh = CollisionMesh(
            facts["faces"],
            edges=facts["edges"],
            points=facts["points"],
            bodies={name: np.arange(first, first + count) for name, first, count in facts["bodies"]} or None,
            vertex_count=facts["vertices"],
        )

    def __len__(self) -> int:
        return self.windows

    def __iter__(self) -> Iterator[Window]:
        """Its windows, one in memory at a time.

        Raises
        ------
        InputError
            The run is damaged.
        """
        windows = _core.RunWindows(self.folder)
        while (found := windows.next()) is not None:
            yield Window(found)

    def positions(self, times: ArrayLike) -> Floats:
        """Where all vertices are at these times, rounded. Straight lines between them are not the certified motion.

        Ask for all times at once: each call reads the run from its beginning.

        Parameters
        ----------
        times : float, or (n,)
            From 0 to ``end`` [s], in any order.

        Returns
        -------
        (vertices, 3), or (n, vertices, 3) float64

        Raises
        ------
        InputError
            The run is damaged, does not have one of these times, or recorded only frames.
        """
        asked = numbers(times, "times").astype(np.float64)
        if asked.ndim > 1:
            raise UsageError(f"times: expected a number or a list of numbers, found the shape {asked.shape}")
        wanted, place = np.unique(asked, return_inverse=True)
        found = _core.run_positions(self.folder, wanted.tolist())
        return np.asarray(found)[place.reshape(asked.shape)]

    def export(
        self,
        pattern: Path,
        *,
        fps: float = 60,
        view: Optional[Tuple[float, float, float]] = None,
        size: Optional[Tuple[int, int]] = None,
        zoom: Optional[str] = None,
        force: bool = False,
        progress: Progress = None,
    ) -> int:
        """Writes frames, or the pictures of a film, and returns how many.

        Parameters
        ----------
        pattern : path
            "fine/%04d.ply", .obj or .vtu; .png for pictures, all in one view.
        fps : float
            Frames a second; a run with record "frames" has its own.
        view : (x, y, z)
            Of pictures: the direction from which they are seen.
        size : (width, height)
            Of pictures [pixels].
        zoom : str
            Of pictures: the body that fills them.
        force : bool
            Files of this pattern may be replaced, and are removed if they are not.
        progress : callable, or True
            As for ``noli.verify``.

        Raises
        ------
        InputError, UsageError, OSError
        """
        if not 0 < fps < float("inf"):
            raise UsageError(f"fps: expected a positive number, found {fps!r}")
        shown = view_options(view, size, zoom)
        if shown and not os.fspath(pattern).endswith(".png"):
            raise UsageError("view, size, zoom: are for pictures; expected a pattern that ends in .png")
        with progress_of(progress) as told:
            return _core.export_run(self.folder, os.fspath(pattern), float(fps), bool(force), shown, told)

    def to_png(
        self,
        file: Path,
        time: float,
        *,
        view: Optional[Tuple[float, float, float]] = None,
        size: Optional[Tuple[int, int]] = None,
        zoom: Optional[str] = None,
        force: bool = False,
    ) -> None:
        """Writes a picture of the run at a time [s]; the options are those of ``export``."""
        require_ending(file, ".png")
        require_new(file, force)
        _core.run_picture(self.folder, float(time), os.fspath(file), view_options(view, size, zoom))

    def report(self, file: Path, *, title: Optional[str] = None, force: bool = False) -> None:
        """Writes a page for a browser: the motion, and what the run recorded of it."""
        require_new(file, force, [os.path.join(self.folder, name) for name in os.listdir(self.folder)])
        _core.run_page(self.folder, os.fspath(file), title)

    def explain(self) -> Json:
        """A dict, as ``noli explain RUN --json`` writes it: energies, events, the layers that acted."""
        explained: Json = json.loads(_core.explain_run(self.folder))
        return explained

    def __repr__(self):
        return f"<noli.Run: {self.folder}, {self.windows} windows, up to {self.end} s>"


def open_run(folder: Path) -> Run:
    """Opens an existing run.

    Parameters
    ----------
    folder : path
        That ``noli.simulate`` or ``noli.repair`` wrote.

    Returns
    -------
    Run

    Raises
    ------
    InputError
        There is no run, or it is damaged.
    """
    return Run(folder)
