# SPDX-License-Identifier: Apache-2.0
"""Noli: did anything touch? Exact verification of moving meshes, with proofs.

    import numpy as np, noli
    result = noli.verify(V, faces)      # V: (frames, vertices, 3)
    print(result)                       # PROVED  12 frames, 11 steps: nothing touches

Units: positions and distances have the caller's unit of length; times are in [0, 1] of a step, in seconds for a run.
Threads: any number of threads may call at once, and work goes on without the interpreter's lock (GIL). Calls on one
object wait for each other. Arrays that are being read must not be written to.
"""

from . import _programs as _programs
from ._audit import Audit, Finding, audit_ccd, fuzz_queries
from ._check import Checked, check, join_checks
from ._core import commit as __commit__
from ._core import version as __version__
from ._errors import Contact, InputError, NoliError, NotProved, Stopped, UsageError, WriteError
from ._mesh import CollisionMesh
from ._queries import (
    Contacts,
    contacts,
    edge_edge_contact,
    vertex_edge_contact,
    vertex_face_contact,
    vertex_vertex_contact,
)
from ._repair import Repaired, read_frames, repair
from ._run import Run, open_run
from ._simulate import Simulation, Window, simulate
from ._steps import (
    Certifier,
    FreeStep,
    Impact,
    Intersections,
    LeastDistance,
    collision_free_step,
    largest_min_distance,
    self_intersections,
    time_of_impact,
)
from ._verify import FirstContact, Result, verify

__all__ = [
    "Audit",
    "Certifier",
    "Checked",
    "CollisionMesh",
    "Contact",
    "Contacts",
    "Finding",
    "FirstContact",
    "FreeStep",
    "Impact",
    "InputError",
    "Intersections",
    "LeastDistance",
    "NoliError",
    "NotProved",
    "Repaired",
    "Result",
    "Run",
    "Simulation",
    "Stopped",
    "UsageError",
    "Window",
    "WriteError",
    "audit_ccd",
    "check",
    "collision_free_step",
    "contacts",
    "edge_edge_contact",
    "fuzz_queries",
    "join_checks",
    "largest_min_distance",
    "open_run",
    "read_frames",
    "repair",
    "self_intersections",
    "simulate",
    "time_of_impact",
    "verify",
    "vertex_edge_contact",
    "vertex_face_contact",
    "vertex_vertex_contact",
]
