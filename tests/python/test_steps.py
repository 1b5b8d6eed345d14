# SPDX-License-Identifier: Apache-2.0
import threading

import noli
import numpy as np
from support import TestCase, falling_sheet, grid


class Steps(TestCase):
    def setUp(self):
        super().setUp()
        self.V, self.F, bodies = falling_sheet()
        self.mesh = noli.CollisionMesh(self.F, bodies=bodies)

    def test_time_of_impact_is_that_of_verify(self):
        for a, b in ((3, 4), (0, 5), (1, 5)):
            impact = noli.time_of_impact(self.V[a], self.V[b], self.mesh)
            first = noli.verify(self.V[[a, b]], self.mesh).first
            self.assertEqual((impact.time, impact.kind, impact.pair), (first.time, first.kind, first.pair))
            self.assertEqual(impact.features, first.features)
            self.assertTrue(np.array_equal(impact.point, first.point))
        impact = noli.time_of_impact(self.V[0], self.V[1], self.mesh)
        self.assertFalse(impact.touches)
        self.assertEqual(float(impact), np.inf)

    def test_intersecting_at_the_beginning(self):
        x = np.concatenate([self.V[0][:64], self.V[0][:64] + [0.01, 0.02, 0]])
        impact = noli.time_of_impact(x, x + 1e-3, self.mesh)
        self.assertTrue(impact.touches)
        self.assertEqual(impact.time, 0)

    def test_free_step(self):
        for dtype in (np.float64, np.float32):
            for a, b in ((3, 4), (0, 5), (0, 1)):
                x_t0, x_t1 = self.V[a].astype(dtype), self.V[b].astype(dtype)
                free = noli.collision_free_step(x_t0, x_t1, self.mesh)
                self.assertTrue(free.free)
                self.assertEqual(free.positions.dtype, dtype)
                self.assertFalse(noli.time_of_impact(x_t0, free.positions, self.mesh).touches)
                self.assertEqual(noli.verify([x_t0, free.positions], self.mesh).verdict, "proved")
                touches = noli.time_of_impact(x_t0, x_t1, self.mesh)
                self.assertTrue(free.step <= touches.time and free.step >= 0.89 * min(1, touches.time))
        x = np.concatenate([self.V[0][:64], self.V[0][:64] + [0.01, 0.02, 0]])
        stuck = noli.collision_free_step(x, x + 1, self.mesh)
        self.assertFalse(stuck.free)
        self.assertEqual(stuck.step, 0)
        self.assertTrue(np.array_equal(stuck.positions, x))

    def test_free_step_in_two_dimensions(self):
        x_t0 = np.array([[0, 0], [1, 0], [0.5, 1], [0.5, 2]], float)
        x_t1 = x_t0.copy()
        x_t1[2:, 1] -= 1.5
        free = noli.collision_free_step(x_t0, x_t1, noli.CollisionMesh(edges=[[0, 1], [2, 3]]))
        self.assertEqual(free.positions.shape, (4, 2))
        self.assertTrue(0.5 < free.step < 2 / 3)

    def test_self_intersections(self):
        self.assertEqual(noli.self_intersections(self.V[0], self.mesh).count, 0)
        x = np.concatenate([grid(8)[0], grid(8)[0][:, [0, 2, 1]] + [0.05, 0.47, -0.5]])
        found = noli.self_intersections(x, self.mesh)
        command = noli.verify(x[np.newaxis], self.mesh, at_rest=True, max_reports=100_000).to_json()
        self.assertEqual(found.count, command["initial_intersections"])
        listed = [i["cells"] for i in command["initial_reports"]["intersections"]]
        self.assertEqual(found.pairs.tolist(), listed)
        self.assertGreater(found.count, 0)

    def test_largest_distance(self):
        found = noli.largest_min_distance(self.V[0], self.mesh)
        self.assertTrue(0 < found.allowed < found.limit)
        self.assertEqual(noli.verify(self.V[:1], self.mesh, at_rest=True, min_distance=found.allowed).verdict, "proved")
        self.assertEqual(noli.verify(self.V[:1], self.mesh, at_rest=True, min_distance=found.limit).verdict, "too_near")
        ring = noli.largest_min_distance(self.V[0], self.mesh, ring=3)
        self.assertGreater(ring.allowed, found.allowed)
        x = np.concatenate([self.V[0][:64], self.V[0][:64] + [0.01, 0.02, 0]])
        self.assertEqual(float(noli.largest_min_distance(x, self.mesh, dimension=3)), 0)
        self.assertIsNone(noli.largest_min_distance(np.eye(3), [[0, 1, 2]]))

    def test_certifier(self):
        with noli.Certifier(self.mesh, self.V[0]) as certifier:
            for x in self.V[1:4]:
                self.assertFalse(certifier.step(x).touches)
            with self.assertRaises(noli.Contact) as raised:
                certifier.step(self.V[4])
            self.assertAlmostEqual(raised.exception.time, 1 / 3)
            self.assertGreater(len(raised.exception.pairs), 0)
            self.assertEqual(certifier.steps, 3)
            self.assertTrue(np.array_equal(certifier.x, self.V[3]))
            shorter = self.V[3] + 0.3 * (self.V[4] - self.V[3])
            self.assertFalse(certifier.step(shorter).touches)
            with self.assertRaises(noli.Contact):
                certifier.step(self.V[4])
        x = np.concatenate([self.V[0][:64], self.V[0][:64] + [0.01, 0.02, 0]])
        with self.assertRaises(noli.Contact):
            noli.Certifier(self.mesh, x)

    def test_certifier_may_leave_the_plane_it_began_in(self):
        x, faces = grid(4)
        mesh = noli.CollisionMesh(faces)
        certifier = noli.Certifier(mesh, x)
        certifier.step(x + [0, 0, 1])
        folded = x + [0, 0, 1]
        folded[12:, 0] -= 0.5  # would overlap in the plane
        folded[12:, 2] += 0.5
        self.assertFalse(certifier.step(folded).touches)
        with self.assertRaises(noli.Contact):
            noli.Certifier(mesh, x, dimension=2).step(folded)

    def test_threads_share_an_object(self):
        certifier = noli.Certifier(self.mesh, self.V[0])
        found = []

        def work():
            for _ in range(20):
                try:
                    certifier.step(self.V[4])
                except noli.Contact as contact:
                    found.append(contact.time)

        threads = [threading.Thread(target=work) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(found, [noli.time_of_impact(self.V[0], self.V[4], self.mesh).time] * 80)

    def test_a_step_that_stays_where_it_intersects_is_not_free(self):
        x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.2, 0.2, -1], [0.3, 0.2, 1], [0.2, 0.3, 1]])
        for end in (x, x * -1 * -1, x + 0.25):
            free = noli.collision_free_step(x, end, [[0, 1, 2], [3, 4, 5]])
            self.assertFalse(free.free)
            self.assertEqual(free.step, 0)
            self.assertTrue(np.array_equal(free.positions, x))
        apart = x + np.array([[0, 0, 0]] * 3 + [[5, 0, 0]] * 3)
        self.assertTrue(noli.collision_free_step(apart, apart, [[0, 1, 2], [3, 4, 5]]).free)

    def test_two_threads_never_accept_a_step_between_their_own(self):
        lower, upper = self.V[0][:64], self.V[0][64:]
        start, above, below = (np.concatenate([lower, upper + shift]) for shift in ([5, 0, 1], [0, 0, 1], [0, 0, -3]))
        self.assertTrue(noli.time_of_impact(above, below, self.mesh).touches)
        for _ in range(20):
            certifier, accepted = noli.Certifier(self.mesh, start), []

            def go(x, certifier=certifier, accepted=accepted):
                try:
                    certifier.step(x)
                    accepted.append(x)
                except noli.Contact:
                    pass

            threads = [threading.Thread(target=go, args=(x,)) for x in (above, below)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            if len(accepted) == 2:  # start to one, and from there to the other
                self.assertFalse(noli.time_of_impact(*accepted, self.mesh).touches)

    def test_nothing_there(self):
        self.assertIsNone(noli.largest_min_distance(np.empty((0, 3)), np.empty((0, 3), int)))
        self.assertEqual(noli.self_intersections(np.empty((0, 3)), np.empty((0, 3), int)).count, 0)
        huge = self.V[0] * 1e308
        self.assertGreater(noli.largest_min_distance(huge, self.mesh).allowed, 0)
        for wrong in ({"ring": -1}, {"ring": 1000}, {"threads": -1}, {"dimension": 5}):
            with self.assertRaises(noli.UsageError):
                noli.largest_min_distance(self.V[0], self.mesh, **wrong)
        for wrong in ({"dimension": 0}, {"threads": -1}):
            with self.assertRaises(noli.UsageError):
                noli.Certifier(self.mesh, self.V[0], **wrong)

    def test_what_a_certifier_shows_changes_nothing(self):
        lower, faces = [[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2], [3, 4, 5]]
        certifier = noli.Certifier(faces, np.array(lower + [[1, 1, 1], [2, 1, 1], [1, 2, 1]], float))
        with self.assertRaises(noli.Contact):
            for _ in range(4):
                x = certifier.x
                x[3:, 2] -= 0.6
                certifier.step(x)
        self.assertEqual(certifier.steps, 1)
        for name in ("x", "steps"):
            with self.assertRaises(AttributeError):
                setattr(certifier, name, 0)

    def test_certifier_keeps_its_own_positions(self):
        x = self.V[0].copy()
        certifier = noli.Certifier(self.mesh, x)
        x[:] = self.V[1]
        certifier.step(x)
        x[:] = self.V[4]  # from V[1] to V[5] would touch, too, but not from V[4]
        with self.assertRaises(noli.Contact):
            certifier.step(x)

    def test_bad_input(self):
        for arguments in (
            (self.V[0], self.V[1][:-1], self.mesh),
            (self.V[0], self.V, self.mesh),
            (self.V[0], np.full_like(self.V[0], np.nan), self.mesh),
            (self.V[0], self.V[1], [[0, 1, 1000]]),
        ):
            for function in (noli.time_of_impact, noli.collision_free_step):
                with self.assertRaises(noli.InputError):
                    function(*arguments)
        with self.assertRaises(noli.InputError):
            noli.collision_free_step(self.V[0], self.V[1], self.mesh, safety=1)
        with self.assertRaises(noli.InputError):
            noli.Certifier(self.mesh, self.V[0]).step(self.V[0][:-1])

    def test_what_is_ignored(self):
        self.mesh.ignore = [("floor", "sheet")]
        self.assertFalse(noli.time_of_impact(self.V[0], self.V[5], self.mesh).touches)
        self.assertEqual(noli.collision_free_step(self.V[0], self.V[5], self.mesh).step, 1)
