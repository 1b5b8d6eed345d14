# SPDX-License-Identifier: Apache-2.0
"""Scenes in motion, certified window by window."""

from __future__ import annotations

import json
import os
import tempfile
from typing import Any, List, NoReturn, Optional, Tuple, Union

from . import _core
from ._errors import InputError, NotProved, UsageError
from ._options import distance, threads_of, time_limit_of
from ._types import Floats, Json, Path
from ._words import no_truth


class Window:
    """A piece of a run's time that was decided to be free of contact, and is on disk.

    Attributes
    ----------
    index : int
        From 1.
    begin, end : float
        [s]
    positions, velocities : (vertices, 3) float64
        At its end [m], [m/s].
    energies : dict
        At its end [J]: "kinetic", "potential" by kind of force, and "total", their sum. Of the window [J]: the works
        "damping_work", "held_work" and "restitution_work", and "integration", the error of finite steps.
    momentum, angular_momentum : list of 3
        [N s], [N m s]
    frames : list of (time, (vertices, 3) float64)
        Within it, in a run that recorded only frames; else empty.

    In a run of ``noli.repair`` velocities are 0. There, and in a run of an earlier version, energies and momenta are empty.
    """

    index: int
    begin: float
    end: float
    positions: Floats
    velocities: Floats
    energies: Json
    momentum: List[float]
    angular_momentum: List[float]
    frames: List[Tuple[float, Floats]]

    def __init__(self, found: Json) -> None:
        self.__dict__.update(found)

    def __repr__(self):
        return f"<noli.Window {self.index}: {self.begin} s to {self.end} s>"


class Simulation:
    """Windows, one after another; see ``simulate``. After the last, ``result`` says how the run ended.

    The simulation goes on in the background, at most one window ahead. ``close()``, the end of a ``with`` block, and an
    exception in the loop end it at the last committed window; ``resume=True`` goes on from there.
    """

    def __bool__(self) -> NoReturn:
        no_truth(self)

    def __init__(self, scene: Union[Path, Json], run: Path, options: Json) -> None:
        self.run = os.fspath(run)
        self._scene_file: Any = None
        if isinstance(scene, dict):
            text = _text_of(scene)
            self._scene_file = tempfile.NamedTemporaryFile("w", suffix=".json")
            self._scene_file.write(text)
            self._scene_file.flush()
            file = self._scene_file.name
        elif isinstance(scene, (str, os.PathLike)) and not os.fspath(scene).lstrip().startswith("{"):
            file = os.fspath(scene)
        else:
            raise UsageError("scene: expected the name of a file, or a dict (json.loads makes one of text)")
        self._simulation = _core.Simulation(file, self.run, options)

    def __iter__(self) -> Simulation:
        return self

    def __next__(self) -> Window:
        try:
            found = self._simulation.next()
        except (InputError, UsageError) as error:
            name = self._scene_file.name if self._scene_file is not None else None
            self.close()
            if name is None or name not in str(error):
                raise
            raise type(error)(str(error).replace(name, "scene")) from None
        except BaseException:
            self.close()
            raise
        if found is None:
            self.close()
            raise StopIteration
        return Window(found)

    def __enter__(self) -> Simulation:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the simulation at the last committed window."""
        self._simulation.close()
        if self._scene_file is not None:
            self._scene_file.close()

    @property
    def result(self) -> Optional[Json]:
        """A dict, as ``noli simulate --json`` writes it; None while it goes on, or if it failed."""
        return json.loads(self._simulation.json())

    @property
    def verdict(self) -> Optional[str]:
        """"no_contact", "contact", "too_near", "not_finite", "unstable" or "undecided"; None while it goes on."""
        return None if self.result is None else self.result["verdict"]

    def finish(self) -> Simulation:
        """Goes through all windows that are left, and returns this. Raises NotProved unless nothing touched."""
        for _ in self:
            pass
        if self.verdict != "no_contact":
            raise NotProved(self._simulation.text().splitlines()[-1], self)
        return self

    def __repr__(self):
        return f"<noli.Simulation: {self.run}, {self.verdict or 'going on'}>"


def simulate(
    scene: Union[Path, Json],
    run: Path,
    *,
    short: bool = False,
    resume: bool = False,
    force: bool = False,
    prove: bool = True,
    until: Optional[float] = None,
    past_duration: bool = False,
    ignore_space: bool = False,
    threads: int = 0,
    time_limit: Optional[float] = None,
) -> Simulation:
    """Runs a scene by the method of "Asynchronous Contact Mechanics" (Harmon et al. 2009), certified window by window.

    Parameters
    ----------
    scene : path, or dict
        docs/reference/scene.md says what can be in it, as does ``noli schema scene``. Meshes in files that a dict names
        are found from the working folder.
    run : path
        The folder that is made for it; ``noli.verify(run)`` verifies it again, from its files alone.
    short : bool
        The scene's short form.
    resume, force : bool
        Goes on with the run in the folder; replaces it.
    until : float
        Simulated time to stop at [s]; beyond the scene's duration only with ``past_duration``.
    prove, ignore_space, threads, time_limit
        As ``noli simulate`` has them; the limit in seconds.

    Returns
    -------
    Simulation
        An iterator of Window.

    Raises
    ------
    InputError, UsageError, OSError
        When the first window is asked for.
    """
    if resume and force:
        raise UsageError("resume, force: expected one of them at most")
    options: Json = {
        "short": bool(short),
        "resume": bool(resume),
        "force": bool(force),
        "prove": bool(prove),
        "past_duration": bool(past_duration),
        "ignore_space": bool(ignore_space),
        "threads": threads_of(threads),
        **time_limit_of(time_limit),
    }
    if until is not None:
        options["until"] = distance(until, "until")
    return Simulation(scene, run, options)


def _text_of(scene):
    """A dict as JSON. Raises InputError."""
    try:
        return json.dumps(_with_whole_paths(scene), default=lambda array: array.tolist(), allow_nan=False)
    except (AttributeError, TypeError, ValueError) as error:
        raise InputError(f"scene: expected texts, finite numbers, lists, arrays and dicts: {error}") from None


def _with_whole_paths(value):
    """The scene with each "file" of a mesh made absolute."""
    if isinstance(value, list):
        return [_with_whole_paths(item) for item in value]
    if not isinstance(value, dict):
        return value
    return {
        key: os.path.abspath(item) if key == "file" and isinstance(item, (str, os.PathLike)) else _with_whole_paths(item)
        for key, item in value.items()
    }
