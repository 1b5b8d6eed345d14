# SPDX-License-Identifier: Apache-2.0
import json
import shutil
import threading

import noli
import numpy as np
from support import ROOT, TestCase, run_noli

SCENE = {
    "noli_scene": 1,
    "duration": 0.05,
    "window": 0.01,
    "record": "full",
    "gravity": [0, 0, -9.81],
    "bodies": [
        {
            "name": name,
            "mesh": {"grid": {"size": [1, 1], "cells": [2, 2]}},
            "transform": {"translate": [0, 0, z]},
            "material": {"young": 2e4, "density": 200, "thickness": 0.001},
        }
        for name, z in (("upper", 1), ("lower", 0))
    ],
}


class Simulate(TestCase):
    def test_windows(self):
        run = self.folder / "run"
        windows = list(noli.simulate(SCENE, run))
        self.assertEqual([w.index for w in windows], [1, 2, 3, 4, 5])
        self.assertEqual(windows[0].positions.shape, (18, 3))
        self.assertTrue(np.all(windows[4].positions[:, 2] < windows[0].positions[:, 2]))
        total = [w.energies["total"] for w in windows]
        self.assertTrue(np.allclose(total, total[0], rtol=1e-6))
        for a, b in zip(windows, windows[1:]):
            self.assertEqual(a.end, b.begin)
        self.assertEqual(noli.verify(run).verdict, "proved")
        self.assertEqual(noli.check(run).verdict, "accepted")

    def test_bytes_are_those_of_the_command(self):
        scene = self.folder / "scene.json"
        scene.write_text(json.dumps(SCENE), encoding="utf-8")
        run_noli("simulate", scene, "-o", self.folder / "command", expected=0)
        noli.simulate(scene, self.folder / "python").finish()
        for name in ("trajectory.blocks", "proof.blocks"):
            self.assertEqual((self.folder / "command" / name).read_bytes(), (self.folder / "python" / name).read_bytes())

    def test_stops_and_goes_on(self):
        whole, run = self.folder / "whole", self.folder / "run"
        noli.simulate(SCENE, whole).finish()
        with noli.simulate(SCENE, run) as simulation:
            for window in simulation:
                if window.index == 2:
                    break
        self.assertEqual(simulation.verdict, "undecided")
        more = noli.simulate(SCENE, run, resume=True)
        rest = [w.index for w in more]
        self.assertEqual(rest, list(range(rest[0], 6)))
        self.assertLessEqual(rest[0], 5)
        self.assertEqual(more.verdict, "no_contact")
        self.assertEqual((run / "trajectory.blocks").read_bytes(), (whole / "trajectory.blocks").read_bytes())

    def test_threads_share_a_simulation(self):
        simulation = noli.simulate(SCENE, self.folder / "run")
        self.assertIn("going on", repr(simulation))
        seen = []

        def work():
            seen.extend(window.index for window in simulation)
            simulation.close()

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertLessEqual(len(seen), 5)
        self.assertEqual(len(seen), len(set(seen)))
        self.assertIn(simulation.verdict, ("no_contact", "undecided"))

    def test_numpy_in_a_scene(self):
        noli.simulate({**SCENE, "gravity": np.array([0, 0, -1.0])}, self.folder / "run").finish()

    def test_an_exception_in_the_loop_ends_it(self):
        run = self.folder / "run"
        with self.assertRaises(ZeroDivisionError):
            with noli.simulate(SCENE, run) as simulation:
                for _ in simulation:
                    raise ZeroDivisionError
        self.assertEqual(simulation.verdict, "undecided")
        shutil.rmtree(run)

    def test_a_run_that_recorded_frames_is_made_again(self):
        run = self.folder / "run"
        noli.simulate(dict(SCENE, record="frames", frame_rate=100), run).finish()
        with self.assertRaises(noli.NoliError):
            noli.verify(run)
        self.assertEqual(noli.verify(run, reproduce=True).verdict, "proved")

    def test_what_is_no_scene(self):
        run = self.folder / "run"
        for wrong, text in (
            (["a list"], "expected the name of a file, or a dict"),
            (json.dumps(SCENE), "expected the name of a file, or a dict"),
            (dict(SCENE, duration=float("nan")), "finite numbers"),
            (dict(SCENE, title=b"bytes"), "expected texts"),
            (dict(SCENE, duration=-1), "^scene: /duration"),
        ):
            with self.assertRaisesRegex(noli.NoliError, text):
                noli.simulate(wrong, run).finish()
        with self.assertRaisesRegex(noli.UsageError, "resume, force"):
            noli.simulate(SCENE, run, resume=True, force=True)
        self.assertFalse(run.exists())

    def test_contact(self):
        scene = ROOT / "scenes" / "sheet_through_sheet.json"
        simulation = noli.simulate(scene, self.folder / "run", short=True)
        with self.assertRaises(noli.NotProved):
            simulation.finish()
        self.assertEqual(simulation.verdict, "contact")

    def test_bad_scenes(self):
        for scene in ({}, {**SCENE, "duration": -1}, {**SCENE, "unknown": 1}, "no_such_file.json"):
            with self.assertRaises(noli.NoliError):
                noli.simulate(scene, self.folder / "run").finish()
        noli.simulate(SCENE, self.folder / "run").finish()
        with self.assertRaisesRegex(noli.UsageError, "exists"):
            noli.simulate(SCENE, self.folder / "run").finish()

    def test_meshes_in_files_are_found_from_the_working_folder(self):
        (self.folder / "triangle.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        body = {"name": "one", "mesh": {"file": str(self.folder / "triangle.obj")}, "material": SCENE["bodies"][0]["material"]}
        noli.simulate({**SCENE, "bodies": [body], "duration": 0.01}, self.folder / "run").finish()
