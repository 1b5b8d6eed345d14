# SPDX-License-Identifier: Apache-2.0
"""Run by an interpreter that has the package installed: from arrays to a proof, with nothing else around."""

import os
import tempfile

import noli
import numpy as np

face = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
frames = np.array([face + [[0.2, 0.2, z], [0.3, 0.2, z + 1], [0.2, 0.3, z + 1]] for z in (2.0, 1.0, -1.0)])
faces = [[0, 1, 2], [3, 4, 5]]
with tempfile.TemporaryDirectory() as folder:
    proof = os.path.join(folder, "smoke.noli")
    noli.verify(frames[:2], faces, proof=proof).raise_unless_proved()
    assert noli.check(proof, frames[:2], faces).verdict == "accepted"
    found = noli.verify(frames, faces)
    assert (found.verdict, found.first.step, found.first.time) == ("contact", 2, 0.5), found
    assert noli.repair(frames, faces).verdict == "proved"
    assert noli.vertex_face_contact(frames[1, [3, 0, 1, 2]], frames[2, [3, 0, 1, 2]]).time[0] == 0.5
print("noli", noli.__version__, "works here")
