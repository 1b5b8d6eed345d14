# SPDX-License-Identifier: Apache-2.0
import csv
import json
from fractions import Fraction

import noli
import numpy as np
from support import TestCase, run_noli


class Queries(TestCase):
    def test_both_answers_of_every_kind(self):
        face = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
        falling = [[[0.2, 0.2, 1], *face], [[0.2, 0.2, 1], *face], [[0.2, 0.2, 0], *face], [[0.2, 0.2, 1], *face]]
        ends = [[[0.2, 0.2, -1], *face], [[0.2, 0.2, 0.5], *face], [[0.2, 0.2, 0], *face], [[0.2, 0.2, 0], *face]]
        found = noli.vertex_face_contact(falling, ends)
        self.assertEqual(found.kind.tolist(), ["crossing", "apart", "persistent", "touching"])
        self.assertEqual(found.touches.tolist(), [True, False, True, True])
        self.assertEqual(found.time[[0, 2, 3]].tolist(), [0.5, 0, 1])
        self.assertTrue(np.isnan(found.time[1]))

        edges = [[-1, 0, 1], [1, 0, 1], [0, -1, 0], [0, 1, 0]]
        below = [[-1, 0, -2], [1, 0, -2], [0, -1, 0], [0, 1, 0]]
        found = noli.edge_edge_contact([edges, edges], [below, edges])
        self.assertEqual(found.touches.tolist(), [True, False])
        self.assertEqual(Fraction(found.time[0]).limit_denominator(1000), Fraction(1, 3))
        self.assertLess(Fraction(found.time[0]), Fraction(1, 3))

        for dimension in (2, 3):
            x_t0 = np.array([[0.5, 1, 0], [0, 0, 0], [1, 0, 0]])[:, :dimension]
            x_t1 = x_t0.copy()
            x_t1[0, 1] = -1
            found = noli.vertex_edge_contact([x_t0, x_t0], [x_t1, x_t0])
            self.assertEqual(found.kind.tolist(), ["crossing" if dimension == 2 else "touching", "apart"])
            points, there = x_t0[:2], x_t0[:2][::-1]
            found = noli.vertex_vertex_contact([points, points], [there, points])
            self.assertEqual(found.touches.tolist(), [True, False])

    def test_says_what_the_command_says(self):
        rng = np.random.default_rng(7)
        for pair, name in (("vertex_face", "vertex-face"), ("edge_edge", "edge-edge")):
            x = rng.integers(-3, 4, (2, 300, 4, 3)).astype(float)
            file = self.folder / f"{name}.csv"
            with open(file, "w", newline="", encoding="ascii") as out:
                rows = csv.writer(out)
                for i in range(300):
                    for t in (0, 1):
                        for p in range(4):
                            row = []
                            for number in x[t, i, p]:
                                row += [int(number), 1]
                            rows.writerow([*row, 0])
            _, out, _ = run_noli("ccd", file, "--times", "--json", "-")
            times = json.loads(out)["files"][0]["times"]
            found = noli.contacts(pair, x[0], x[1])
            self.assertEqual([t["query"] - 1 for t in times], np.flatnonzero(found.touches).tolist())
            self.assertEqual([t["time"] for t in times], found.time[found.touches].tolist())
            self.assertEqual([t["kind"] for t in times], found.kind[found.touches].tolist())
            self.assertTrue(np.any(found.touches) and not np.all(found.touches))

    def test_threads_and_times_change_nothing(self):
        x = np.random.default_rng(3).random((2, 5000, 4, 3))
        one, two = (noli.edge_edge_contact(x[0], x[1], threads=n) for n in (1, 2))
        self.assertTrue(np.array_equal(one.time, two.time, equal_nan=True))
        self.assertTrue(np.array_equal(one.touches, noli.edge_edge_contact(x[0], x[1], times=False).touches))
        self.assertEqual(len(one), 5000)

    def test_subnormal_numbers(self):
        tiny = 5e-324
        x_t0 = np.array([[tiny, 0], [0, tiny]])
        self.assertFalse(noli.vertex_vertex_contact(x_t0, x_t0).touches[0])
        self.assertEqual(noli.vertex_vertex_contact(x_t0, x_t0[::-1]).time[0], 0.5)
        self.assertTrue(noli.vertex_vertex_contact(x_t0, np.zeros((2, 2))).touches[0])

    def test_empty(self):
        self.assertEqual(len(noli.vertex_face_contact(np.empty((0, 4, 3)), np.empty((0, 4, 3)))), 0)

    def test_bad_input(self):
        good = np.zeros((5, 4, 3))
        for x_t0, x_t1 in ((good, good[:4]), (good[:, :3], good[:, :3]), (good[..., :2], good[..., :2]), (good, good * np.nan)):
            with self.assertRaises(noli.InputError):
                noli.vertex_face_contact(x_t0, x_t1)
        with self.assertRaises(noli.InputError):
            noli.contacts("face_face", good, good)
        for bad in (np.nan, np.inf, -np.inf):
            for row, place in ((4, (0, 0)), (2, (3, 2))):
                x = good.copy()
                x[(row, *place)] = bad
                for arguments in ((x, good), (good, x)):
                    with self.assertRaisesRegex(noli.InputError, f"query {row} has a number that is not finite"):
                        noli.vertex_face_contact(*arguments)
