# SPDX-License-Identifier: Apache-2.0
"""Does a proof hold?"""

from __future__ import annotations

import json
import os
import tempfile
from typing import NoReturn, Optional, Sequence, Union

from . import _core
from ._errors import InputError, NotProved, UsageError
from ._frames import bodies_in_files, file_names, given_frames
from ._options import ORDERS, choice, refuse_options_of_files, threads_of, words
from ._types import Bodies, Claim, Frames, Json, Mesh, Names, Path, Progress
from ._words import no_truth, progress_of


class Checked:
    """What a checker said. It is not a bool: ask ``verdict``.

    Attributes
    ----------
    verdict : str
        "accepted": what was asked is proved. "refuted": a witness shows that it is not so. "rejected": neither.
    words : str
        The checker's own words.
    claim : dict or None
        What was proved or refuted, field by field (proofs/FORMAT.md, section 6).
    weaker : list of str
        What makes that less than everything.
    """

    def __init__(self, check: _core.Check) -> None:
        self._check = check
        self._json: Json = json.loads(check.json())
        self.verdict: str = self._json["verdict"]
        self.words: str = self._json["words"]
        self.claim: Optional[Json] = self._json["claim"]
        self.weaker: Names = self._json["weaker"]

    def __bool__(self) -> NoReturn:
        no_truth(self)

    def to_json(self) -> Json:
        """A dict, as ``noli check --json`` writes it."""
        return self._json

    def raise_unless_accepted(self) -> Checked:
        """Returns this if the proof was accepted. Raises NotProved."""
        if self.verdict != "accepted":
            raise NotProved(self.words.splitlines()[0] if self.words else self.verdict, self)
        return self

    def text(self) -> str:
        """What ``noli check`` prints."""
        return self._check.text()

    def __str__(self):
        return self.text()

    def __repr__(self):
        return f"<noli.Checked: {self.text().splitlines()[-1]}>"

    def _repr_html_(self) -> str:
        from ._notebook import html_of_check

        return html_of_check(self)


def check(
    proof: Path,
    frames: Optional[Frames] = None,
    mesh: Optional[Mesh] = None,
    *,
    require: Sequence[str] = (),
    claim: Claim = None,
    verified: bool = False,
    order: str = "checked",
    obstacles: Optional[Bodies] = None,
    threads: int = 0,
    progress: Progress = None,
) -> Checked:
    """Has a separate program check a proof about these frames, or about a run.

    Parameters
    ----------
    proof : path
        Written by ``noli.verify(..., proof=...)``; or the folder of a run, without frames: its own proof.
    frames, mesh, order, obstacles
        As for ``noli.verify``. A generator can be read once.
    require : list of str
        Fields of the claim that is asked for, "distance=0.001" for example (``noli check --help``). "steps=40..60" looks
        at these steps alone, "steps=40..40" at one, "steps=40.." at all from there on; "steps=40" asks for the first 40
        at least. Default: frames in motion, all steps, every cell, no merged vertices, no least distance, and nothing
        left out except what the mesh ignores.
    claim : path or dict
        All fields at once: ``Result.claim``, or the file of ``noli verify --claim-out``.
    verified : bool
        Asks noli_check_verified, whose soundness is proved in Coq.
    threads : int
        Number of checkers that share the steps; 0: one per processor. Frames in memory, and short proofs, use one.
    progress : callable, True or None
        As for ``noli.verify``.

    Returns
    -------
    Checked

    Raises
    ------
    InputError, UsageError, NoliError
        No such proof, no such checker.
    """
    proof = os.fspath(proof)
    if frames is None:
        if not os.path.isdir(proof):
            raise UsageError("expected a run's folder, or a proof and its frames or run")
        proof, frames = os.path.join(proof, "proof.blocks"), proof
    if not os.path.exists(proof):
        raise InputError(f"{proof}: does not exist; expected a proof")
    asked = words(require)
    of_steps = [word for word in asked if word.split("=")[0] == "steps"]
    part = of_steps[0] if len(of_steps) == 1 and ".." in of_steps[0] else None
    if part is not None:
        asked.remove(part)
    asked += [word for word in _fields(claim) if word.split("=")[0] not in {own.split("=")[0] for own in asked}]
    options: Json = {
        "order": choice(order, "order", ORDERS),
        "bodies": bodies_in_files(frames, obstacles),
        "threads": threads_of(threads),
    }
    if part is not None:
        options["part"] = part[len("steps=") :]
    names = file_names(frames)
    if names is None:
        refuse_options_of_files({"order": order})
    elif mesh is not None:
        raise UsageError("mesh: frames in files have their own; expected none")
    given = given_frames(frames, mesh) if names is None else names
    with progress_of(progress) as told:
        checked = Checked(_core.Check(proof, given, asked, bool(verified), options, told))
    fault = "rejected: the command line, "
    if checked.words.startswith(fault):
        raise UsageError(checked.words.splitlines()[0][len(fault) :])
    return checked


def join_checks(answers: Sequence[Union[Checked, Json, Path]]) -> Checked:
    """Joins the answers about all parts of a proof into one, as ``noli check --join`` does. Nothing is checked again.

    Parameters
    ----------
    answers : list of Checked, dicts of ``Checked.to_json``, or files that ``noli check --json`` wrote
        Each about a part: ``require=["steps=1..20"]``, the last one with an open end, ``require=["steps=21.."]``.

    Returns
    -------
    Checked

    Raises
    ------
    InputError
        Unless all accept parts of one proof, asked for alike, that cover each of its steps once.
    """
    if isinstance(answers, (str, os.PathLike, dict, Checked)) or not answers:
        raise UsageError("answers: expected a list of answers about parts")
    return Checked(_core.Check.joined([_named(k, answer) for k, answer in enumerate(answers)]))


def _named(k, answer):
    """The name of an answer, for errors, and its text."""
    if isinstance(answer, (str, os.PathLike)):
        with open(answer, encoding="utf-8", errors="surrogateescape") as file:
            return os.fspath(answer), file.read()
    return f"answers[{k}]", json.dumps(answer.to_json() if isinstance(answer, Checked) else answer)


def _fields(claim):
    if claim is None:
        return []
    if not isinstance(claim, dict):
        return _core.read_claim_file(os.fspath(claim))
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(claim, file)
        file.flush()
        return _core.read_claim_file(file.name)
