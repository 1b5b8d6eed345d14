# SPDX-License-Identifier: Apache-2.0
"""Python's results are the command's, field by field: fuzzed motions, and the real frames of NOLI_DATA."""

import json
import os
import pathlib

import noli
import numpy as np
from support import ROOT, TestCase, comparable, json_of_command, run_noli

MOTIONS = 500


def random_motion(rng):
    """A small motion on a coarse grid of numbers, where features are often in special positions."""
    vertices, frames = int(rng.integers(3, 16)), int(rng.integers(2, 6))
    kind = rng.integers(3)
    if kind == 0:
        V = rng.integers(-2, 3, (frames, vertices, 3)).astype(float)
    elif kind == 1:
        V = rng.normal(size=(frames, vertices, 3)) * 10.0 ** rng.integers(-200, 200)
    else:  # a body that moves as a whole, past another
        V = np.repeat(rng.normal(size=(1, vertices, 3)), frames, axis=0)
        V[:, vertices // 2 :] += np.arange(frames)[:, np.newaxis, np.newaxis] * rng.normal(size=3)
    if rng.integers(8) == 0:
        V[..., 2] = 0
    F = np.array([rng.choice(vertices, 3, replace=False) for _ in range(rng.integers(1, 8))])
    return (V.astype(np.float32) if rng.integers(4) == 0 and np.abs(V).max() < 1e30 else V), F


def random_options(rng):
    options, words = {}, []
    for name, word in (("keep_going", "--keep-going"), ("strict", "--strict"), ("points", "--points"), ("at_rest", "--static")):
        if rng.integers(4) == 0:
            options[name] = True
            words.append(word)
    if rng.integers(6) == 0:
        distance = float(10.0 ** rng.integers(-3, 1))
        options["min_distance"] = distance
        words += ["--min-distance", repr(distance)]
    elif rng.integers(6) == 0:
        options["only_new"] = True
        words.append("--only-new")
    return options, words


class Equal(TestCase):
    def test_fuzzed_motions(self):
        verdicts = {}
        for number in range(MOTIONS):
            rng = np.random.default_rng(number)
            (V, F), (options, words) = random_motion(rng), random_options(rng)
            with self.subTest(number=number, options=options):
                found = noli.verify(V, F, threads=1, **options)
                verdicts[found.verdict] = verdicts.get(found.verdict, 0) + 1
                expected = json_of_command(V, F, "--threads", "1", *words)
                self.assertEqual(comparable(found.to_json()), comparable(expected))
                if found.verdict in ("proved", "no_contact") and len(V) > 1 and not options.get("at_rest"):
                    self.assertFalse(noli.time_of_impact(V[0], V[1], F).touches and not options.get("only_new"))
        self.assertGreater(min(verdicts.get("proved", 0), verdicts.get("contact", 0)), MOTIONS // 10, verdicts)

    def test_real_frames(self):
        data = pathlib.Path(os.environ.get("NOLI_DATA", ROOT.parent / "shared" / "data")) / "frames"
        if not data.is_dir():
            self.skipTest(f"{data} is not there")
        for folder in sorted(data.iterdir()):
            names = sorted(path for path in folder.iterdir() if path.suffix in (".ply", ".obj"))
            with self.subTest(folder.name):
                self.compare_real(names)

    def compare_real(self, files):
        result = self.folder / "result.json"
        run_noli("verify", *files, "--order", "natural", "--no-check", "--keep-going", "--json", result, "--force", "-q")
        command = json.loads(result.read_text(encoding="utf-8"))
        V, mesh = noli.read_frames(files)
        for frames in (V, iter(V)):
            found = noli.verify(frames, mesh, check=False, keep_going=True).to_json()
            self.assertEqual(comparable(found), comparable(command))
        for a, b in zip(V, V[1:]):
            impact = noli.time_of_impact(a, b, mesh)
            whole = noli.verify([a, b], mesh, check=False).to_json()
            self.assertEqual(impact.touches, whole["verdict"] == "contact")
            if impact.touches and whole["initial_intersections"] == 0:
                self.assertEqual(impact.time, whole["first"]["time"])
            free = noli.collision_free_step(a, b, mesh)
            if free.free:
                self.assertEqual(noli.verify([a, free.positions], mesh, check=False).verdict, "no_contact")
                self.assertLessEqual(free.step, min(impact.time, 1))
            else:
                self.assertGreater(noli.self_intersections(a, mesh).count, 0)
