# SPDX-License-Identifier: Apache-2.0
"""Where the programs are that this package starts: the checkers of proofs, and noli_series, which reads HDF5."""

from __future__ import annotations

import atexit
import os
import pathlib
import shutil

from . import _core


def find():
    """The folder programs/ in the package, else that of noli_check on the PATH."""
    inside = pathlib.Path(__file__).parent / "programs"
    if (inside / "noli_check").exists():
        return inside
    found = shutil.which("noli_check")
    return pathlib.Path(found).parent if found else None


atexit.register(_core.end_all_work)  # threads that are still at work would be torn out of it
os.register_at_fork(after_in_child=_core.forget_all_work)  # the parent's threads are not in the child

folder = find()
if folder is not None:
    _core.keep_programs_in(os.fspath(folder))
