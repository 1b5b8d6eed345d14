# SPDX-License-Identifier: Apache-2.0
"""What the tests share: small motions, and the command to compare with."""

import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
NOLI = os.environ["NOLI"]


def grid(n, z=0.0, shift=(0.0, 0.0)):
    """A square sheet of n × n vertices, and its faces."""
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n), indexing="ij")
    vertices = np.stack([x.ravel() + shift[0], y.ravel() + shift[1], np.full(n * n, z)], 1)
    i = np.arange(n * n).reshape(n, n)
    corners = i[:-1, :-1], i[1:, :-1], i[1:, 1:], i[:-1, 1:]
    faces = [np.stack([corners[0], corners[a], corners[b]], -1).reshape(-1, 3) for a, b in ((1, 2), (2, 3))]
    return vertices, np.concatenate(faces)


def falling_sheet(n=8, frames=6, drop=0.3):
    """(frames, 2 n², 3), faces, and the vertices of both bodies: a sheet falls through another in step 4."""
    lower, faces = grid(n)
    motion = [np.concatenate([lower, grid(n, 1 - drop * k, (0.013, 0.007))[0]]) for k in range(frames)]
    bodies = {"floor": np.arange(n * n), "sheet": np.arange(n * n, 2 * n * n)}
    return np.array(motion), np.concatenate([faces, faces + n * n]), bodies


def run_noli(*arguments, expected=None):
    """The exit code, standard output and standard error of the command."""
    done = subprocess.run([NOLI, *map(str, arguments)], capture_output=True, text=True, check=False)
    if expected is not None and done.returncode != expected:
        raise AssertionError(f"{arguments}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.returncode, done.stdout, done.stderr


def json_of_command(frames, faces, *options):
    """What ``noli verify --json`` writes about these frames in a .npz file."""
    with tempfile.TemporaryDirectory() as folder:
        file = os.path.join(folder, "frames.npz")
        np.savez(file, vertices=frames, faces=faces)
        result = os.path.join(folder, "result.json")
        run_noli("verify", file, "--keys", "vertices,faces", "--json", result, "-q", *options)
        with open(result, encoding="utf-8") as text:
            return json.load(text)


def comparable(result):
    """Without what names files, or is of the clock."""
    result = {key: value for key, value in result.items() if key not in ("inputs", "timing", "notes")}
    result["statement"] = {k: v for k, v in result["statement"].items() if k not in ("order", "notes")}
    return result


def reports_are_there():
    _, out, _ = run_noli("--version", expected=0)
    return "without reports" not in out


class TestCase(unittest.TestCase):
    """With a folder of its own, which vanishes."""

    maxDiff = 600

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
