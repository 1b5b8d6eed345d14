# SPDX-License-Identifier: Apache-2.0
import threading

import noli
import numpy as np
from support import TestCase, falling_sheet


class Repair(TestCase):
    def setUp(self):
        super().setUp()
        self.V, self.F, self.bodies = falling_sheet()
        self.mesh = noli.CollisionMesh(self.F, bodies=self.bodies)

    def test_free_motions_stay_bit_for_bit(self):
        found = noli.repair(self.V[:4], self.mesh)
        self.assertEqual(found.verdict, "proved")
        self.assertTrue(np.array_equal(found.frames, self.V[:4]))
        self.assertEqual(found.times.tolist(), [0, 1, 2, 3])

    def test_others_are_mended(self):
        self.assertEqual(noli.verify(self.V, self.mesh).verdict, "contact")
        found = noli.repair(self.V, self.mesh).raise_unless_proved()
        self.assertTrue(np.array_equal(found.frames[:4], self.V[:4]))
        self.assertFalse(np.array_equal(found.frames[found.given_times], self.V))
        self.assertEqual(noli.verify(found.frames, self.mesh).verdict, "proved")
        self.assertIn("PROVED", str(found))
        self.assertEqual([step["step"] for step in found.changed], [4, 5])

    def test_fixed_vertices_move_as_given(self):
        floor = self.bodies["floor"]
        for fixed in (floor, np.isin(np.arange(128), floor)):
            found = noli.repair(self.V, self.mesh, fixed=fixed)
            self.assertEqual(found.verdict, "proved")
            self.assertTrue(np.array_equal(found.frames[found.given_times][:, floor], self.V[:, floor]))
        # Where both are fixed there is no way.
        found = noli.repair(self.V, self.mesh, fixed=np.arange(128))
        self.assertEqual(found.verdict, "cannot_be")
        self.assertEqual(found.to_json()["obstacle"]["step"], 4)
        self.assertTrue(np.array_equal(found.frames, self.V[:4]))
        with self.assertRaises(noli.NotProved):
            found.raise_unless_proved()
        with self.assertRaisesRegex(noli.UsageError, r"range\(8\) are the first 8"):
            noli.repair(self.V, self.mesh, fixed=8)
        with self.assertRaisesRegex(noli.UsageError, "expected 128 values, one for each vertex"):
            noli.repair(self.V, self.mesh, fixed=np.ones(100, bool))

    def test_options(self):
        proof = self.folder / "mended.noli"
        found = noli.repair(
            self.V, self.mesh, masses=np.linspace(1, 2, 128), friction=0.2, restitution=0.5, thickness=0.01, spread=2, proof=proof
        )
        self.assertEqual(found.verdict, "proved")
        self.assertEqual(noli.check(proof, found.frames, self.mesh).verdict, "accepted")

    def test_output(self):
        pattern = self.folder / "out" / "f%03d.ply"
        found = noli.repair(self.V, self.mesh, output=pattern)
        V, _ = noli.read_frames(self.folder / "out")
        self.assertTrue(np.array_equal(V, found.frames))
        with self.assertRaisesRegex(noli.UsageError, "exist"):
            noli.repair(self.V, self.mesh, output=pattern)
        again = noli.repair(self.V, self.mesh, output=pattern, force=True)
        self.assertTrue(np.array_equal(again.frames, found.frames))

    def test_run(self):
        run = self.folder / "run"
        found = noli.repair(self.V, self.mesh, run=run)
        self.assertEqual(found.to_json()["run"], str(run))
        self.assertIn(f"Their motion: {run}", found.text())
        self.assertNotIn("times.csv", found.text())
        kept = noli.verify(run)
        self.assertEqual((kept.verdict, kept.to_json()["steps"]), ("proved", len(self.V) - 1))
        with self.assertRaisesRegex(noli.UsageError, "exists already"):
            noli.repair(self.V, self.mesh, run=run)
        noli.repair(self.V, self.mesh, run=run, force=True)

    def test_report(self):
        found = noli.repair(self.V, self.mesh, output=self.folder / "out" / "f%03d.ply")
        try:
            found.report(self.folder / "page.html", title="two sheets")
        except noli.UsageError as error:
            self.assertIn("built without reports", str(error))
            self.skipTest(str(error))
        page = (self.folder / "page.html").read_text(encoding="utf-8")
        self.assertIn("two sheets", page)
        self.assertIn("How far vertices end from their given positions", page)
        self.assertIn("<iframe", found._repr_html_())
        with self.assertRaisesRegex(noli.UsageError, "exists already"):
            found.report(self.folder / "page.html")
        with self.assertRaisesRegex(noli.UsageError, "is read"):
            found.report(self.folder / "out" / "f001.ply", force=True)
        with self.assertRaisesRegex(noli.UsageError, "output="):
            noli.repair(self.V, self.mesh).report(self.folder / "other.html")
        spent = noli.repair(iter(self.V), self.mesh, output=self.folder / "spent" / "f%03d.ply")
        with self.assertRaisesRegex(noli.UsageError, "generator"):
            spent.report(self.folder / "other.html")
        self.V[2, 3, 1] += 1e-9
        with self.assertRaisesRegex(noli.InputError, "^frames: have changed"):
            found.report(self.folder / "other.html")
        self.assertFalse((self.folder / "other.html").exists())

    def test_shows_itself(self):
        page = noli.repair(self.V, self.mesh)._repr_html_()
        self.assertIn("PROVED", page)
        self.assertIn("<td>4</td><td>128</td><td>0.1544</td>", page)
        self.assertEqual([row.split("</td>")[0] for row in page.split("<tr><td>")[1:]], ["4", "5"])
        self.assertNotIn("<iframe", page)
        self.assertNotIn("<table", noli.repair(self.V[:4], self.mesh)._repr_html_())

    def test_threads_may_share_a_result(self):
        """Frames of a list are asked for in the interpreter's thread of each call."""
        found = noli.repair(list(self.V), self.mesh, output=self.folder / "out" / "f%03d.ply")
        failures = []

        def work(k):
            try:
                for _ in range(5):
                    found.report(self.folder / f"{k}.html", force=True)
            except Exception as error:
                if "built without reports" not in str(error):
                    failures.append(error)

        threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join(timeout=60)
            self.assertFalse(thread.is_alive())
        self.assertEqual(failures, [])

    def test_resume(self):
        pattern = self.folder / "f%03d.ply"
        whole = noli.repair(self.V, self.mesh, output=pattern)
        for part in (self.V, self.V + 0.0):
            again = noli.repair(part, self.mesh, output=pattern, resume=True)
            self.assertTrue(np.array_equal(again.frames, whole.frames))
        with self.assertRaisesRegex(noli.InputError, "different frames"):
            noli.repair(self.V * 2, self.mesh, output=pattern, resume=True)
        with self.assertRaisesRegex(noli.UsageError, "output="):
            noli.repair(self.V, self.mesh, resume=True)
        self.assertEqual(whole.to_json()["inputs"][0]["file"], "frames")
        self.assertIn("Times of the frames", str(whole))
        self.assertNotIn("Times of the frames", str(noli.repair(self.V, self.mesh)))

    def test_of_files_and_generators(self):
        names = self.folder / "g%d.obj"
        found = noli.repair(iter(self.V), self.mesh, output=names)
        again = noli.repair(str(self.folder / "g*.obj"))
        self.assertTrue(np.array_equal(found.frames, again.frames))

    def test_what_is_ignored(self):
        free = noli.CollisionMesh(self.F, bodies=self.bodies, ignore=[("floor", "sheet")])
        found = noli.repair(self.V, free)
        self.assertEqual(found.verdict, "proved")
        self.assertTrue(np.array_equal(found.frames, self.V))

    def test_bad_input(self):
        with self.assertRaisesRegex(noli.UsageError, "no vertex 128"):
            noli.repair(self.V, self.mesh, fixed=[128])
        with self.assertRaises(noli.InputError):
            noli.repair(np.full_like(self.V, np.inf), self.mesh)
        with self.assertRaisesRegex(noli.InputError, "^masses"):
            noli.repair(self.V, self.mesh, masses=np.zeros(128))
        with self.assertRaisesRegex(noli.InputError, "^frames"):
            noli.repair(self.V[:1], self.mesh)
        for wrong in ({"masses": "heavy"}, {"spread": -1}, {"dimension": 5}, {"restitution": 2}, {"friction": -1},
                      {"thickness": 0}, {"order": "natural"}, {"ignore": "a.json"}, {"time_limit": -1}):
            with self.assertRaises(noli.UsageError):
                noli.repair(self.V, self.mesh, **wrong)
