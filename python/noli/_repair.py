# SPDX-License-Identifier: Apache-2.0
"""A motion near a given one in which nothing touches."""

from __future__ import annotations

import csv
import json
import os
import re
import tempfile
from typing import List, NoReturn, Optional, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _core
from ._arrays import indices, numbers
from ._errors import InputError, NotProved, UsageError
from ._frames import bodies_in_files, file_names, given_frames
from ._mesh import CollisionMesh
from ._options import (
    ORDERS,
    choice,
    dimension_of,
    distance,
    refuse_options_of_files,
    require_ending,
    require_new,
    stem,
    threads_of,
    time_limit_of,
    view_options,
    whole,
)
from ._types import Bodies, Floats, Frames, Integers, Json, Mesh, Path, Progress
from ._words import no_truth, progress_of


class Repaired:
    """Frames in which nothing touches, also between them. It is not a bool: ask ``verdict``.

    Attributes
    ----------
    verdict : str
        "proved" or "no_contact", as ``noli.verify`` says of ``frames``; "cannot_be": the first frame touches, or
        fixed vertices meet; "undecided".
    frames : (frames, vertices, 3) float64
        The new frames. Frames are inserted where straight lines between two would touch.
    times : (frames,) float64
        In steps: the given frame k has the time k, as far as the repair got.
    """

    def __init__(self, repair: _core.Repair, frames: Floats, times: Floats, *, kept: bool) -> None:
        self._repair, self.frames, self.times, self._kept = repair, frames, times, kept
        self._json: Json = json.loads(repair.json())
        self.verdict: str = self._json["verdict"]

    def __bool__(self) -> NoReturn:
        no_truth(self)

    @property
    def given_times(self) -> Integers:
        """Numbers of the rows of ``frames`` that are at the times of given frames."""
        return np.flatnonzero(self.times == np.floor(self.times))

    @property
    def changed(self) -> List[Json]:
        """The steps that were changed, dicts: step (from 1), moved (vertices), largest and rms displacement, inserted."""
        return self._json["changed"]

    def to_json(self) -> Json:
        """A dict, as ``noli repair --json`` writes it (``noli schema repair``): "changed" lists the steps that were.

        Without ``output``, the frames that it names are gone."""
        return self._json

    def raise_unless_proved(self) -> Repaired:
        """Returns this if its verdict is "proved". Raises NotProved."""
        if self.verdict != "proved":
            raise NotProved(self.text().splitlines()[-1], self)
        return self

    def report(self, file: Path, *, title: Optional[str] = None, force: bool = False) -> None:
        """Writes a page for a browser: the repaired motion over the given one, and what was changed.

        Needs ``output``, whose files it shows. Frames in memory have to be as they were.
        """
        if not self._kept:
            raise UsageError("report: shows the frames in files; pass output= to noli.repair")
        require_new(file, force, [frame["file"] for key in ("inputs", "outputs") for frame in self._json[key]])
        self._repair.report(os.fspath(file), title or stem(file))

    def to_png(
        self,
        file: Path,
        time: float,
        *,
        given: bool = False,
        view: Optional[Tuple[float, float, float]] = None,
        size: Optional[Tuple[int, int]] = None,
        zoom: Optional[str] = None,
        force: bool = False,
    ) -> None:
        """Writes a picture of the repaired motion, or with ``given`` of the one before, at a time in steps.

        Both have the same view. Needs ``output``. ``view``: the direction from which they are seen; ``size``: width and height
        [pixels]; ``zoom``: the body that fills it.
        """
        if not self._kept:
            raise UsageError("to_png: shows the frames in files; pass output= to noli.repair")
        require_ending(file, ".png")
        require_new(file, force, [frame["file"] for key in ("inputs", "outputs") for frame in self._json[key]])
        if not len(self.times) or not 0 <= time <= self.times[-1]:
            raise InputError(f"time: expected 0 to {max(self.times, default=0):g} steps, found {time!r}")
        self._repair.picture(os.fspath(file), float(time), bool(given), view_options(view, size, zoom))

    def text(self) -> str:
        """What ``noli repair`` prints."""
        text = self._repair.text()
        return text if self._kept else re.sub(r" Times of the frames: .*?(?=\. Their motion: |\n)", "", text)

    def __str__(self):
        return self.text()

    def __repr__(self):
        return f"<noli.Repaired: {self.text().splitlines()[-1]}>"

    def _repr_html_(self) -> str:
        from ._notebook import html_of_repair

        return html_of_repair(self, with_page=self._kept)


def repair(
    frames: Frames,
    mesh: Optional[Mesh] = None,
    *,
    output: Optional[Path] = None,
    order: str = "checked",
    obstacles: Optional[Bodies] = None,
    ignore: Optional[Path] = None,
    fixed: Union[ArrayLike, str, Sequence[str], None] = None,
    thickness: Optional[float] = None,
    masses: Union[str, ArrayLike, None] = None,
    restitution: float = 0.1,
    friction: float = 0.0,
    spread: int = 0,
    only_new: bool = False,
    points: bool = False,
    dimension: Optional[int] = None,
    run: Optional[Path] = None,
    proof: Optional[Path] = None,
    check: bool = True,
    threads: int = 0,
    time_limit: Optional[float] = None,
    force: bool = False,
    resume: bool = False,
    progress: Progress = None,
) -> Repaired:
    """Turns steps that touch into steps that do not, by contact alone; what touches nothing stays bit for bit.

    Parameters
    ----------
    frames, mesh, order, obstacles, ignore
        As for ``noli.verify``; a generator is read to its end first.
    output : str, optional
        Where the new frames are written as well: "out/%04d.ply", .obj or .vtu.
    fixed : (n,) whole numbers, (vertices,) bool, or names of bodies
        Vertices that move as given, whatever they meet. Obstacles always do.
    thickness : float
        The gap that is aimed at, in the unit of the positions. Default: from the mesh.
    masses : (vertices,) positive numbers, or "uniform"
        Default: by area and length.
    restitution : float
        Share of the approach energy that comes back, 0 to 1.
    friction : float
        Coulomb's coefficient.
    spread : int
        Contact also moves the surroundings, over about this many edges. 0: only what touches.
    run : str, optional
        A folder for the motion as contact made it: a run, in which a step takes one second.
    only_new, points, dimension, proof, check, threads, time_limit, force, progress
        As for ``noli.verify``.
    resume : bool
        With ``output``: goes on after the last complete step of an earlier call.

    Returns
    -------
    Repaired

    Raises
    ------
    InputError, UsageError, OSError
    """
    options: Json = {
        "restitution": float(restitution),
        "friction": distance(friction, "friction"),
        "spread": whole(spread, "spread", 0, 1_000_000),
        "only_new": bool(only_new),
        "points": bool(points),
        "check": bool(check),
        "threads": threads_of(threads),
        "force": bool(force),
        "resume": bool(resume),
        **dimension_of(dimension),
        **time_limit_of(time_limit),
    }
    if not 0 <= options["restitution"] <= 1:
        raise UsageError(f"restitution: expected a number from 0 to 1, found {restitution!r}")
    if thickness is not None:
        options["thickness"] = float(thickness)
        if not 0 < options["thickness"] < float("inf"):
            raise UsageError(f"thickness: expected a positive distance, found {thickness!r}")
    if resume and output is None:
        raise UsageError("resume: needs output=, the pattern of the earlier call")
    names = file_names(frames)
    if run is not None:
        options["run"] = os.fspath(run)
    if proof is not None:
        require_new(proof, force, names or ())
        options["proof"] = os.fspath(proof)
    given = given_frames(frames, mesh) if names is None else names
    if names is None:
        refuse_options_of_files({"order": order, "ignore": ignore})
    options.update(order=choice(order, "order", ORDERS), bodies=bodies_in_files(frames, obstacles))
    if ignore is not None:
        options["ignore"] = os.fspath(ignore)
    if fixed is not None:
        options.update(_chosen(fixed, mesh, None if names is not None else given.vertices))
    if names is not None and mesh is not None:
        raise UsageError("mesh: frames in files have their own; expected none")
    with tempfile.TemporaryDirectory() as scratch, progress_of(progress) as told:
        if masses is not None:
            options["masses"] = _masses(masses, scratch)
        pattern = os.fspath(output) if output is not None else os.path.join(scratch, "frame_%06d.ply")
        try:
            done = _core.Repair(given, None if names is not None else given.mesh, pattern, options, output is not None, told)
        except (InputError, UsageError) as error:
            raise type(error)(_without_scratch(str(error), scratch)) from None
        return Repaired(done, *_read(json.loads(done.json())), kept=output is not None)


def read_frames(frames: Union[Path, Sequence[Path]]) -> Tuple[Floats, CollisionMesh]:
    """Reads frames in files, as ``noli.verify`` names them.

    Returns
    -------
    (frames, vertices, 3) float64, CollisionMesh

    Raises
    ------
    InputError
    """
    names = file_names(frames)
    if names is None:
        raise UsageError("frames: expected names of files")
    positions, faces, edges, points = _core.read_frames(names)
    return np.array(positions), CollisionMesh(faces, edges=edges, points=points, vertex_count=len(positions[0]))


def _chosen(fixed, mesh, count):
    """Options for the vertices, or for the bodies, that move as given. `count`: of all vertices, if it is known."""
    array = np.asarray(fixed)
    if array.ndim == 0 and array.dtype.kind in "iub":
        raise UsageError(f"fixed: expected a list of vertices, found {fixed!r}; range({fixed}) are the first {fixed}")
    array = np.atleast_1d(array)
    if array.dtype.kind == "U":
        bodies = getattr(mesh, "bodies", None)
        if bodies is None:
            return {"fixed_bodies": array.tolist()}
        if any(name not in bodies for name in array):
            raise UsageError(f"fixed: {array.tolist()} are not all names of bodies; there are {sorted(bodies)}")
        array = np.concatenate([bodies[name] for name in array])
    if array.dtype == bool and count is not None and array.shape != (count,):
        raise UsageError(f"fixed: expected {count} values, one for each vertex, found the shape {array.shape}")
    return {"fixed": (np.flatnonzero(array) if array.dtype == bool else indices(array, 1, "fixed")).tolist()}


def _masses(masses, scratch):
    if isinstance(masses, str):
        if masses not in ("size", "uniform"):
            raise UsageError(f'masses: expected "size", "uniform" or numbers, found {masses!r}')
        return masses
    array = numbers(masses, "masses").astype(np.float64)
    if array.ndim != 1:
        raise InputError(f"masses: has the shape {array.shape}; expected (vertices,)")
    file = os.path.join(scratch, "masses.txt")
    with open(file, "w", encoding="ascii") as out:
        out.writelines(f"{mass!r}\n" for mass in array.tolist())
    return file


def _without_scratch(text, scratch):
    """A message about a file that this call wrote for what it was given: says what that was."""
    text = text.replace(os.path.join(scratch, "masses.txt"), "masses")
    return re.sub(r"\S*/noli-scratch-\w+/frames\.blocks", "frames", text)


def _read(result):
    """Positions and times of the frames that were written."""
    table = result["times"]
    if not os.path.exists(table):
        return np.empty((0, result["vertices"], 3)), np.empty(0)
    with open(table, newline="", encoding="utf-8") as rows:
        listed = list(csv.reader(rows))[1:]
    if not listed:
        return np.empty((0, result["vertices"], 3)), np.empty(0)
    folder = os.path.dirname(table)
    positions = _core.read_frames([os.path.join(folder, row[0]) for row in listed])[0]
    return np.array(positions), np.array([float(row[1]) for row in listed])
