# SPDX-License-Identifier: Apache-2.0
"""Did anything touch between these frames?"""

from __future__ import annotations

import json
import os
from typing import Any, NoReturn, Optional, Sequence, Tuple

import numpy as np

from . import _core
from ._errors import Contact, NotProved, UsageError
from ._frames import bodies_in_files, file_names, given_frames
from ._types import Bodies, Features, Frames, Integers, Json, Mesh, Names, Path, Progress
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
    whole,
    words,
)
from ._words import KINDS, PAIRS, no_truth, progress_of

CONTACTS = np.dtype(
    [
        ("step", np.int64),
        ("time", np.float64),
        ("kind", "U10"),
        ("pair", "U13"),
        ("vertices", np.int64, 4),
        ("point", np.float64, 3),
    ]
)


class FirstContact:
    """Where something touches first.

    Attributes
    ----------
    step : int
        From 1: from frame ``step - 1`` to frame ``step``, counted from 0. Of a run, the window.
    time : float
        In [0, 1] of the step, in seconds for a run: the largest double not above the exact time.
    kind : str
        "crossing", "touching" or "persistent".
    pair : str
        "vertex_face", "edge_edge", "vertex_edge" or "vertex_vertex".
    features : tuple of two tuples
        Vertices of both features.
    point : (3,) float64
        Where they meet, rounded; in the unit of the positions.
    bodies : tuple of two names
        Of both features; empty where there are no bodies.
    """

    step: int
    time: float
    kind: str
    pair: str
    features: Features
    point: np.ndarray[Any, np.dtype[np.float64]]
    bodies: Tuple[str, ...]

    def __init__(self, json: Json) -> None:
        first, second = json["features"]
        self.step, self.time, self.kind, self.pair = json["step"], json["time"], json["kind"], json["pair"]
        self.features = (tuple(first), tuple(second))
        self.point = np.array(json["point"])
        self.bodies = tuple(json.get("bodies", ("", "")))

    def __repr__(self):
        a, b = (" ".join(map(str, f)) for f in self.features)
        return f"<{self.pair} {self.kind}, step {self.step}, t = {self.time:.6g}: {a} × {b}>"


class Result:
    """What was found, and what it is about. It is not a bool: ask ``verdict``.

    Attributes
    ----------
    verdict : str
        "proved": nothing touches, and the checker accepted the proof. "no_contact": decided exactly, not checked.
        "contact", "too_near", "undecided".
    """

    def __init__(self, outcome: _core.Outcome) -> None:
        self._outcome = outcome
        self._json: Optional[Json] = None

    @property
    def verdict(self) -> str:
        return self._outcome.verdict

    def __bool__(self) -> NoReturn:
        no_truth(self)

    def to_json(self) -> Json:
        """The result as a dict, as ``noli verify --json`` writes it: ``noli schema verify`` has its fields."""
        if self._json is None:
            self._json = json.loads(self._outcome.json())
        return self._json

    @property
    def first(self) -> Optional[FirstContact]:
        """The first FirstContact. It is None without contacts, and when cells already intersect at the beginning."""
        first = self.to_json()["first"]
        return None if first is None or self.to_json()["initial_intersections"] else FirstContact(first)

    @property
    def contacts(self) -> np.ndarray[Any, Any]:
        """Listed contacts (at most ``max_reports``), a structured array: step, time, kind, pair, vertices, point.

        Steps share the list fairly. Within a step, contacts are not in order of time.
        ``vertices`` are those of the first feature, then of the second, and -1 where a pair has fewer than four.
        """
        columns = self._outcome.contacts()
        rows = np.empty(len(columns["step"]), CONTACTS)
        for name in ("step", "time", "vertices", "point"):
            rows[name] = columns[name]
        rows["kind"] = KINDS[columns["kind"]]
        rows["pair"] = PAIRS[columns["pair"]]
        return rows

    @property
    def contact_count(self) -> int:
        """How many pairs of features touch, listed or not; a lower bound unless ``complete``."""
        return sum(self.to_json()["contacts"].values())

    @property
    def complete(self) -> bool:
        """Whether everything was decided that was asked."""
        return self.to_json()["complete"]

    def faces_in_contact(self, step: int) -> Integers:
        """Numbers of the faces in listed contacts of a step (from 1), ascending."""
        return self._outcome.faces_in_contact(whole(step, "step", 1))

    @property
    def statement(self) -> Json:
        """What exactly was asked, a dict of texts."""
        return self.to_json()["statement"]

    @property
    def inputs(self) -> list[Json]:
        """What was looked at, a list of dicts: name, bytes, SHA-256, type of numbers, vertices, cells, frames.

        The hash of frames in memory is that of all coordinates as little-endian doubles, (frames, vertices, 3).
        """
        return self.to_json()["inputs"]

    @property
    def notes(self) -> Names:
        """Remarks, a list of texts."""
        return self.to_json()["notes"]

    @property
    def claim(self) -> Json:
        """What was claimed, a dict as ``noli verify --claim-out`` writes it: ``noli.check(..., claim=...)`` takes it."""
        return json.loads(self._outcome.claim())

    def raise_unless_proved(self) -> Result:
        """Returns this result if its verdict is "proved", and not of an empty claim. Raises Contact, or NotProved."""
        if self.verdict == "proved" and not self.claim["empty"]:
            return self
        text = self._outcome.text(False).splitlines()[-1]
        if self.verdict != "contact":
            raise NotProved(text, self)
        raise Contact(text, self, self.first.time if self.first else None, self.contacts)

    def report(self, file: Path, *, title: Optional[str] = None, force: bool = False) -> None:
        """Writes a page for a browser: verdict, motion, contacts, statement. Frames in memory have to be as they were."""
        require_new(file, force)
        self._outcome.report(os.fspath(file), title or stem(file))

    def to_vtu(self, file: Path, *, number: int = 0, force: bool = False) -> None:
        """Writes everything at the time of a contact as a grid for ParaView; its cells have "contact": 1, 2, else 0.

        ``number`` is that of a listed contact, from 1; 0: the first of all. Frames in memory have to be as they were.
        """
        self._write_contact(file, ".vtu", number, force)

    def to_png(self, file: Path, *, number: int = 0, force: bool = False) -> None:
        """Writes a picture of a contact: the first feature's cells are red, the second's yellow."""
        self._write_contact(file, ".png", number, force)

    def _write_contact(self, file: Path, ending: str, number: int, force: bool) -> None:
        require_ending(file, ending)
        require_new(file, force)
        self._require_listed(number)
        self._outcome.write_contact(os.fspath(file), whole(number, "number", 0))

    def _require_listed(self, number: int) -> None:
        listed = self.to_json()["reports"]["listed"]
        if whole(number, "number", 0) > listed:
            raise UsageError(f"number: {number} is beyond the {listed} listed contacts (max_reports)")

    def plot(self, *, number: int = 0, backend: Optional[str] = None) -> Any:
        """Draws a contact with "matplotlib", "vedo" or "polyscope"; default: the first of these that is installed.

        Returns a figure of matplotlib.pyplot, a Plotter of vedo, or the module polyscope, with the meshes in it: its
        ``show()`` shows them.
        """
        from ._pictures import plot

        self._require_listed(number)
        return plot(self._outcome.contact_frame(whole(number, "number", 0)), backend)

    def text(self, *, details: bool = False) -> str:
        """What ``noli verify`` prints; with ``details``, as with --verbose."""
        return self._outcome.text(details)

    def __str__(self):
        return self.text()

    def __repr__(self):
        return f"<noli.Result: {self._outcome.text(False).splitlines()[-1]}>"

    def _repr_html_(self) -> str:
        from ._notebook import html_of

        return html_of(self)


def verify(
    frames: Frames,
    mesh: Optional[Mesh] = None,
    *,
    obstacles: Optional[Bodies] = None,
    proof: Optional[Path] = None,
    check: bool = True,
    min_distance: float = 0.0,
    ring: int = 1,
    only_new: bool = False,
    at_rest: bool = False,
    strict: bool = False,
    points: bool = False,
    merge_identical: bool = False,
    dimension: Optional[int] = None,
    keep_going: bool = False,
    first_only: bool = False,
    max_reports: int = 100,
    threads: int = 0,
    time_limit: Optional[float] = None,
    order: str = "checked",
    keys: Sequence[str] = (),
    polygons: str = "fan",
    ignore: Optional[Path] = None,
    reproduce: bool = False,
    scene_folder: Optional[Path] = None,
    force: bool = False,
    progress: Progress = None,
) -> Result:
    """Decides exactly whether anything touches between successive frames, or in the windows of a run.

    Every vertex moves along a straight line from one frame to the next. Coordinates are taken as they are, without a
    tolerance. A separate checker then checks a proof of the answer.

    Parameters
    ----------
    frames : array (frames, vertices, 2 or 3), list of arrays, generator of arrays, or names of files
        float32 or float64, in any order in memory; each frame is copied once, and hash and decision use the copy. A
        generator may be of any length: two frames are in memory at a time. Names: files in the order of time, a
        pattern ("cloth_*.obj"), a folder, a .npz file, or the folder of one run. A dict of name to names of files joins
        bodies into one mesh, each with frames of its own.
    mesh : CollisionMesh, or (n, 3) faces
        Needed for arrays; files have their own.
    obstacles : dict of name to a file, optional
        Bodies that stand still, beside bodies in files.
    proof : path, optional
        Where the proof is written, for ``noli.check`` and ``noli check``.
    check : bool
        Has the checker look at the proof: only then a verdict is "proved".
    min_distance : float
        All features must stay more than this apart, in the unit of the positions; those fewer than ``ring`` mesh edges
        apart need only be disjoint (``ring`` goes with ``min_distance`` alone).
    only_new : bool
        Leaves out pairs of cells that intersect in the first frame.
    at_rest : bool
        Takes each frame by itself: does the mesh intersect itself? One frame, (vertices, 3), is enough.
    strict : bool
        Also compares features of one cell with each other.
    points : bool
        Vertices without a cell are particles.
    merge_identical : bool
        Merges vertices whose coordinates are equal in all frames; reads the frames twice.
    dimension : 2 or 3, optional
        2 ignores z. Default: 2 if the first two frames have one z, else 3.
    keep_going : bool
        Goes through all steps instead of stopping after the first with contacts.
    first_only : bool
        Stops at any contact; ``first`` is then that one, and there may be earlier ones.
    max_reports : int
        How many contacts are listed; counts do not depend on it.
    threads : int
        0: all.
    time_limit : float, optional
        Seconds; what is not decided by then is "undecided".
    order : "checked", "natural" or "given"
        Of files. "checked": an error where they are given against the numbers in their names. "natural": by these numbers.
    keys : names
        Of the arrays of positions and faces in a .npz file, if they cannot be guessed.
    polygons : "fan" or "refuse"
        Polygons in files are cut into triangles, or are an error.
    ignore : path
        A file of groups whose cells are not compared (``noli verify --help``); for arrays, CollisionMesh has ``ignore``.
    reproduce, scene_folder : bool, path
        Integrates the windows of a run again that recorded only frames; where its scene's file was.
    force : bool
        Replaces an existing proof.
    progress : callable, True or None
        Called as ``progress(work, share)``; True shows a bar, with tqdm if it is installed.

    Returns
    -------
    Result

    Raises
    ------
    InputError, UsageError
        With the text that ``noli verify`` prints.
    OSError
        A proof that cannot be written.
    KeyboardInterrupt
        On Ctrl-C.
    """
    options: Json = {
        "check": bool(check),
        "min_distance": distance(min_distance, "min_distance"),
        "ring": whole(ring, "ring", 1, 255),
        "only_new": bool(only_new),
        "at_rest": bool(at_rest),
        "strict": bool(strict),
        "points": bool(points),
        "merge_identical": bool(merge_identical),
        "keep_going": bool(keep_going),
        "first_only": bool(first_only),
        "max_reports": whole(max_reports, "max_reports", 0),
        "threads": threads_of(threads),
        "reproduce": bool(reproduce),
        **dimension_of(dimension),
        **time_limit_of(time_limit),
    }
    if options["ring"] != 1 and options["min_distance"] == 0:
        raise UsageError("ring: has no effect without min_distance; pass both")
    if first_only and keep_going:
        raise UsageError("first_only, keep_going: expected one of them at most")
    bodies = bodies_in_files(frames, obstacles)
    names = file_names(frames)
    if proof is not None:
        require_new(proof, force, names or ())
        options["proof"] = os.fspath(proof)
    if names is not None and len(names) == 1 and names[0].endswith(".npy") and mesh is not None:
        frames, names = np.load(names[0], mmap_mode="r"), None
    if at_rest and isinstance(frames, np.ndarray) and frames.ndim == 2:
        frames = frames[np.newaxis]
    of_files = {"order": order, "keys": words(keys), "polygons": polygons, "ignore": ignore, "scene_folder": scene_folder}
    if names is None:
        refuse_options_of_files(of_files)
        given = given_frames(frames, mesh)
        with progress_of(progress) as told:
            return Result(_core.Outcome(given, given.mesh, options, told))
    if mesh is not None:
        raise UsageError("mesh: frames in files have their own; expected none")
    options["order"] = choice(order, "order", ORDERS)
    options["keys"] = words(keys)
    options["bodies"] = bodies
    if choice(polygons, "polygons", ("fan", "refuse")) == "refuse":
        options["refuse_polygons"] = True
    if ignore is not None:
        options["ignore"] = os.fspath(ignore)
    if scene_folder is not None:
        options["scene_folder"] = os.fspath(scene_folder)
    with progress_of(progress) as told:
        return Result(_core.Outcome(names, None, options, told))
