# SPDX-License-Identifier: Apache-2.0
import json
import os
import struct

import noli
import numpy as np
from support import TestCase, falling_sheet, reports_are_there, run_noli


def scene(record):
    return {
        "noli_scene": 1, "title": "A falling sheet", "duration": 0.03, "window": 0.01, "record": record, "frame_rate": 200,
        "gravity": [0, 0, -9.81],
        "bodies": [{"name": "sheet", "mesh": {"grid": {"size": [1, 1], "cells": [3, 3]}},
                    "material": {"young": 2e4, "density": 200, "thickness": 0.001}}],
    }  # fmt: skip


class Runs(TestCase):
    def simulated(self, record="full"):
        run = self.folder / record
        noli.simulate(scene(record), run).finish()
        return noli.open_run(run)

    def test_its_windows_are_those_of_the_simulation(self):
        run = self.folder / "run"
        made = list(noli.simulate(scene("full"), run))
        found = list(noli.open_run(run))
        self.assertEqual(len(found), 3)
        for one, other in zip(made, found):
            self.assertEqual((one.index, one.begin, one.end), (other.index, other.begin, other.end))
            self.assertTrue(np.array_equal(one.positions, other.positions))
            self.assertEqual(one.energies, other.energies)
            self.assertEqual(other.frames, [])

    def test_what_it_is(self):
        run = self.simulated()
        self.assertEqual((run.title, run.dimension, run.record), ("A falling sheet", 3, "full"))
        self.assertEqual((len(run), run.windows, run.end), (3, 3, 0.03))
        self.assertEqual(run.mesh.vertex_count, 16)
        self.assertEqual(len(run.mesh.bodies["sheet"]), 16)
        self.assertIn("3 windows", repr(run))

    def test_positions(self):
        run = self.simulated()
        ends = [window.positions for window in run]
        found = run.positions([0.03, 0.01, 0.02, 0.01])
        for k, end in enumerate((2, 0, 1, 0)):
            self.assertTrue(np.array_equal(found[k], ends[end]), k)
        one = run.positions(0.015)
        self.assertEqual(one.shape, (16, 3))
        self.assertTrue((one[:, 2] < ends[0][:, 2]).all() and (one[:, 2] > ends[1][:, 2]).all())
        self.assertEqual(run.positions([]).shape, (0, 16, 3))
        for wrong in (-0.001, 0.031, float("nan"), float("inf")):
            with self.assertRaises(noli.InputError):
                run.positions([0.01, wrong])
        with self.assertRaises(noli.UsageError):
            run.positions([[0.01]])

    def test_recorded_frames(self):
        run = self.simulated("frames")
        frames = [frame for window in run for frame in window.frames]
        self.assertEqual([round(200 * time) for time, _ in frames], [0, 1, 2, 3, 4, 5, 6])
        self.assertEqual(frames[0][1].shape, (16, 3))
        with self.assertRaisesRegex(noli.InputError, "recorded only frames"):
            run.positions(0.01)

    def test_exports_what_the_command_exports(self):
        run = self.simulated()
        told = []
        count = run.export(self.folder / "out" / "%02d.ply", fps=100, progress=lambda work, share: told.append(work))
        self.assertEqual(count, 4)
        run_noli("export", run.folder, "--fps", "100", "-o", self.folder / "command" / "%02d.ply", expected=0)
        for k in range(4):
            name = f"{k:02}.ply"
            self.assertEqual((self.folder / "out" / name).read_bytes(), (self.folder / "command" / name).read_bytes())
        with self.assertRaisesRegex(noli.UsageError, "exist"):
            run.export(self.folder / "out" / "%02d.ply")
        for wrong in (0, -1, float("nan"), float("inf")):
            with self.assertRaisesRegex(noli.UsageError, "fps"):
                run.export(self.folder / "out" / "%02d.ply", fps=wrong)

    def test_pictures(self):
        run = self.simulated()
        file = self.folder / "at.png"
        run.to_png(file, 0.02, size=(200, 100), view=(1, 0, 0.2), zoom="sheet")
        self.assertEqual(struct.unpack(">II", file.read_bytes()[16:24]), (200, 100))
        with self.assertRaisesRegex(noli.UsageError, "exists already"):
            run.to_png(file, 0.02)
        with self.assertRaisesRegex(noli.InputError, "0.03"):
            run.to_png(file, 1, force=True)
        self.assertEqual(run.export(self.folder / "film" / "%d.png", fps=100, size=(64, 64)), 4)
        with self.assertRaisesRegex(noli.UsageError, "are for pictures"):
            run.export(self.folder / "out" / "%d.ply", size=(64, 64))
        for wrong in ({"view": (0, 0, 0)}, {"size": (1, 1)}, {"size": (100,)}, {"zoom": "nobody"}):
            with self.assertRaises(noli.UsageError):
                run.to_png(file, 0.02, force=True, **wrong)

    def test_page_and_explanation(self):
        run = self.simulated()
        page = self.folder / "run.html"
        if reports_are_there():
            run.report(page)
            self.assertIn("A falling sheet", page.read_text(encoding="utf-8"))
            with self.assertRaisesRegex(noli.UsageError, "is read"):
                run.report(self.folder / "full" / "manifest.json", force=True)
        else:
            with self.assertRaisesRegex(noli.UsageError, "built without reports"):
                run.report(page)
        _, out, _ = run_noli("explain", run.folder, "--json", "-", expected=0)
        self.assertEqual(run.explain(), json.loads(out))

    def test_of_a_repair(self):
        V, F, bodies = falling_sheet()
        mesh = noli.CollisionMesh(F, bodies=bodies)
        repaired = noli.repair(V, mesh, run=self.folder / "kept", output=self.folder / "out" / "%d.ply")
        run = noli.open_run(self.folder / "kept")
        self.assertEqual(run.end, len(V) - 1)
        for window in run:
            self.assertEqual((window.energies, window.momentum), ({}, []))
            frame = repaired.frames[repaired.times == window.end][0]
            self.assertTrue(np.array_equal(window.positions, frame))
        with self.assertRaisesRegex(noli.InputError, "a repair has no energies"):
            run.explain()
        heads = []
        for given in (False, True):
            repaired.to_png(self.folder / f"{given}.png", 4, given=given)
            heads.append((self.folder / f"{given}.png").read_bytes()[16:24])
        self.assertEqual(*heads)
        for wrong in (-1, 5.5, float("nan")):
            with self.assertRaisesRegex(noli.InputError, "time: expected"):
                repaired.to_png(self.folder / "no.png", wrong)
        with self.assertRaisesRegex(noli.UsageError, "pass output="):
            noli.repair(V, mesh).to_png(self.folder / "no.png", 1)

    def test_a_fork_opens_it_again(self):
        windows = iter(self.simulated())
        next(windows)
        child = os.fork()
        if child == 0:
            try:
                next(windows)
            except noli.UsageError:
                os._exit(0)
            os._exit(1)
        self.assertEqual(os.waitpid(child, 0)[1], 0)
        self.assertEqual([window.index for window in windows], [2, 3])

    def test_damage_is_an_error(self):
        run = self.simulated()
        file = self.folder / "full" / "trajectory.blocks"
        bytes_ = bytearray(file.read_bytes())
        bytes_[-500] ^= 1
        file.write_bytes(bytes_)
        with self.assertRaises(noli.InputError):
            list(run)
        with self.assertRaises(noli.InputError):
            run.positions(0.03)
        with self.assertRaises(noli.InputError):
            noli.open_run(self.folder)
