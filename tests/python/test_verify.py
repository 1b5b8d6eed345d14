# SPDX-License-Identifier: Apache-2.0
import hashlib
import json
import os

import noli
import numpy as np
from support import TestCase, comparable, falling_sheet, json_of_command, run_noli


class Verify(TestCase):
    def setUp(self):
        super().setUp()
        self.V, self.F, self.bodies = falling_sheet()

    def test_says_what_the_command_says(self):
        for frames in (self.V, self.V[:4]):
            for dtype in (np.float64, np.float32):
                found = noli.verify(frames.astype(dtype), self.F).to_json()
                self.assertEqual(comparable(found), comparable(json_of_command(frames.astype(dtype), self.F)))

    def test_options_are_those_of_the_command(self):
        options = {
            "min_distance": (0.05, ["--min-distance", "0.05"]),
            "keep_going": (True, ["--keep-going"]),
            "first_only": (True, ["--first-only"]),
            "at_rest": (True, ["--static"]),
            "strict": (True, ["--strict"]),
            "points": (True, ["--points"]),
            "only_new": (True, ["--only-new"]),
            "merge_identical": (True, ["--merge-identical"]),
            "dimension": (3, ["--dimension", "3"]),
            "max_reports": (3, ["--max-reports", "3"]),
            "check": (False, ["--no-check"]),
        }
        for name, (value, words) in options.items():
            with self.subTest(name):
                found = noli.verify(self.V, self.F, threads=1, **{name: value}).to_json()
                self.assertEqual(comparable(found), comparable(json_of_command(self.V, self.F, "--threads", "1", *words)))

    def test_first_contact(self):
        result = noli.verify(self.V, noli.CollisionMesh(self.F, bodies=self.bodies))
        self.assertEqual(result.verdict, "contact")
        self.assertEqual(result.first.step, 4)
        self.assertAlmostEqual(result.first.time, 1 / 3, places=12)
        self.assertEqual(result.first.kind, "crossing")
        self.assertEqual(result.first.bodies, ("floor", "sheet"))
        self.assertAlmostEqual(result.first.point[2], 0)
        self.assertEqual(len(result.contacts), 100)
        self.assertTrue(np.all(result.contacts["step"] == 4))
        self.assertEqual(result.contact_count, sum(result.to_json()["contacts"].values()))
        faces = result.faces_in_contact(4)
        self.assertTrue(len(faces) > 0 and np.all(faces < len(self.F)))
        self.assertEqual(len(result.faces_in_contact(1)), 0)

    def test_every_way_to_hold_frames_gives_the_same(self):
        expected = comparable(noli.verify(self.V, self.F, keep_going=True).to_json())
        ways = {
            "fortran": np.asfortranarray(self.V),
            "reversed twice": self.V[::-1][::-1],
            "strided": np.repeat(self.V, 2, axis=1)[:, ::2],
            "other byte order": self.V.astype(">f8"),
            "list": list(self.V),
            "tuple of lists": tuple(frame.tolist() for frame in self.V),
            "generator": (frame for frame in self.V),
            "read only": self.V.view(),
        }
        ways["read only"].flags.writeable = False
        for name, frames in ways.items():
            with self.subTest(name):
                self.assertEqual(comparable(noli.verify(frames, self.F, keep_going=True).to_json()), expected)

    def test_hash_is_that_of_the_coordinates(self):
        for frames in (self.V, self.V[:4].astype(np.float32), iter(list(self.V[:4]))):
            held = list(frames)
            result = noli.verify(iter(held) if not isinstance(frames, np.ndarray) else frames, self.F, keep_going=True)
            hashed = hashlib.sha256(np.array(held).astype("<f8").tobytes()).hexdigest()
            self.assertEqual(result.inputs[0]["sha256"], hashed)
            self.assertEqual(result.inputs[0]["frames"], len(held))

    def test_all_frames_of_an_array_are_hashed_even_after_a_contact(self):
        result = noli.verify(self.V, self.F)
        self.assertEqual(result.inputs[0]["sha256"], hashlib.sha256(self.V.tobytes()).hexdigest())

    def test_two_dimensions(self):
        flat = self.V[:2, :, :2].copy()
        flat[1] += 0.25
        result = noli.verify(flat, noli.CollisionMesh(edges=[[0, 1], [2, 3]]))
        self.assertEqual(result.statement["dimension"], 2)
        self.assertEqual(result.verdict, "proved")

    def test_what_is_ignored(self):
        consecutive = noli.CollisionMesh(self.F, bodies=self.bodies, ignore=[("floor", "sheet")])
        self.assertEqual(noli.verify(self.V, consecutive).verdict, "proved")
        order = np.random.default_rng(1).permutation(self.V.shape[1])
        place = np.argsort(order)
        mixed = noli.CollisionMesh(
            place[self.F], bodies={name: place[of] for name, of in self.bodies.items()}, ignore=[("floor", "sheet")]
        )
        result = noli.verify(self.V[:, order], mixed)
        self.assertEqual(result.verdict, "proved")
        self.assertIn("floor", str(result.statement["excluded"]))
        mixed.ignore = [("floor", "floor")]
        self.assertEqual(noli.verify(self.V[:, order], mixed).verdict, "contact")

    def test_files_and_folders(self):
        np.savez(self.folder / "motion.npz", vertices=self.V, faces=self.F)
        self.assertEqual(noli.verify(self.folder / "motion.npz").first.step, 4)
        fixed = noli.repair(self.V, self.F, output=self.folder / "f_%02d.obj")
        self.assertEqual(fixed.verdict, "proved")
        names = [self.folder / f"f_{k:02}.obj" for k in range(len(fixed.frames))]
        self.assertEqual(noli.verify(names).verdict, "proved")
        self.assertEqual(noli.verify(str(self.folder / "f_*.obj")).verdict, "proved")
        with self.assertRaisesRegex(noli.InputError, "order natural"):
            noli.verify(names[::-1])
        self.assertEqual(noli.verify(names[::-1], order="natural").verdict, "proved")
        V, mesh = noli.read_frames(names)
        self.assertTrue(np.array_equal(V, fixed.frames))
        self.assertTrue(np.array_equal(mesh.faces, self.F))

    def test_bodies_in_files(self):
        for body, of in self.bodies.items():
            faces = self.F[np.isin(self.F, of).all(axis=1)] - of[0]
            noli.repair(self.V[:, of], faces, output=self.folder / f"{body}_%d.obj")
        (self.folder / "still.obj").write_bytes((self.folder / "floor_0.obj").read_bytes())
        names = {"floor": str(self.folder / "floor_*.obj"), "sheet": str(self.folder / "sheet_*.obj")}
        result = noli.verify(names)
        self.assertEqual(result.first.bodies, ("floor", "sheet"))
        self.assertEqual(result.first.step, 4)
        proof = self.folder / "bodies.noli"
        result = noli.verify({"sheet": names["sheet"]}, obstacles={"floor": self.folder / "still.obj"}, proof=proof)
        self.assertEqual((result.verdict, result.first.step), ("contact", 4))
        found = noli.check(proof, {"sheet": names["sheet"]}, obstacles={"floor": self.folder / "still.obj"})
        self.assertEqual(found.verdict, "refuted")
        mended = noli.repair(names, fixed="floor")
        self.assertEqual(mended.verdict, "proved")
        self.assertTrue(np.array_equal(mended.frames[mended.given_times][:, :64], self.V[:, :64]))
        again = noli.repair(self.V, noli.CollisionMesh(self.F, bodies=self.bodies), fixed=["floor"])
        self.assertTrue(np.array_equal(again.frames, mended.frames))
        for call in (
            lambda: noli.verify({"a": self.V}),
            lambda: noli.verify(self.V, self.F, obstacles={"a": "b.obj"}),
            lambda: noli.repair(self.V, noli.CollisionMesh(self.F, bodies=self.bodies), fixed=["wall"]),
            lambda: noli.repair(names, fixed=["wall"]),
        ):
            with self.assertRaises(noli.UsageError):
                call()

    def test_proof(self):
        proof = self.folder / "sheet.noli"
        mesh = noli.CollisionMesh(self.F)
        result = noli.verify(self.V[:4], mesh, proof=proof).raise_unless_proved()
        with self.assertRaisesRegex(noli.UsageError, "exists already"):
            noli.verify(self.V[:4], mesh, proof=proof)
        for verified in (False, True):
            if verified and not os.path.exists(os.path.join(os.environ["NOLI_BUILD"], "app", "noli_check_verified")):
                continue  # where there is no Coq
            self.assertEqual(noli.check(proof, self.V[:4], mesh, verified=verified).verdict, "accepted")
            self.assertEqual(noli.check(proof, iter(self.V[:4]), mesh, verified=verified).verdict, "accepted")
            self.assertEqual(noli.check(proof, self.V[:3], mesh, verified=verified).verdict, "rejected")
            self.assertEqual(noli.check(proof, self.V[:4] + 1, mesh, require=["distance=1"], verified=verified).verdict, "rejected")
        accepted = noli.check(proof, self.V[:4], mesh, claim=result.claim)
        self.assertEqual(accepted.verdict, "accepted")
        self.assertIn("ACCEPTED", accepted._repr_html_())
        with self.assertRaises(noli.NotProved):
            noli.check(proof, self.V[:3], mesh).raise_unless_accepted()
        with self.assertRaisesRegex(noli.UsageError, "require"):
            noli.check(proof, self.V[:4], mesh, require=["nonsense=1"])
        self.assertIsInstance(noli.check(proof, self.V[:4], mesh).to_json()["claim"], dict)

    def test_parts_of_a_proof(self):
        V, F, _ = falling_sheet(60, 40, 0.02)
        proof, names = self.folder / "long.noli", []
        for k, x in enumerate(V):
            names.append(self.folder / f"f{k:02}.obj")
            rows = [f"v {a!r} {b!r} {c!r}\n" for a, b, c in x.tolist()] + [f"f {a} {b} {c}\n" for a, b, c in (F + 1).tolist()]
            names[-1].write_text("".join(rows))
        noli.verify(names, proof=proof, keep_going=True).raise_unless_proved()
        self.assertGreater(proof.stat().st_size, 4 << 20)  # worth several checkers
        shares = []
        several = noli.check(proof, names, threads=4, progress=lambda work, share: shares.append((work, share)))
        self.assertEqual(several.verdict, "accepted")
        self.assertEqual(several.to_json(), noli.check(proof, names, threads=1).to_json())
        self.assertEqual({work for work, _ in shares}, {"check"})
        self.assertTrue(all(0 <= share <= 1 for _, share in shares))
        with self.assertRaisesRegex(noli.UsageError, "threads"):
            noli.check(proof, names, threads=-1)
        file = self.folder / "3.json"
        parts = [noli.check(proof, names, require=[f"steps={steps}"]) for steps in ("21..", "1..3")]
        file.write_text(json.dumps(noli.check(proof, names, require=["steps=4..20"]).to_json()))
        joined = noli.join_checks([parts[0], parts[1].to_json(), file])
        self.assertEqual(joined.words, several.words)
        self.assertEqual(joined.claim, several.claim)
        with self.assertRaisesRegex(noli.InputError, "answers.0.: begins with step 21, and no answer is about steps 4 to 20"):
            noli.join_checks(parts)
        with self.assertRaises(noli.UsageError):
            noli.join_checks([])
        part = noli.check(proof, names, require=["steps=3..5"])
        self.assertEqual(part.verdict, "accepted")
        self.assertEqual(part.claim["part"]["first"], 3)
        self.assertEqual(noli.check(proof, names, require=["steps=39..40"]).verdict, "rejected")
        # In memory the numbers are the same.
        self.assertEqual(noli.check(proof, V, F).verdict, "accepted")
        V[7, 3, 2] -= 0.5
        self.assertEqual(noli.check(proof, V, F).verdict, "rejected")
        self.assertEqual(noli.check(proof, V, F, require=["steps=1..5"]).verdict, "accepted")

    def test_what_the_mesh_ignores_may_be_left_out_of_a_proof(self):
        proof = self.folder / "ignored.noli"
        mesh = noli.CollisionMesh(self.F, bodies=self.bodies, ignore=[("floor", "sheet")])
        noli.verify(self.V, mesh, proof=proof).raise_unless_proved()
        self.assertEqual(noli.check(proof, self.V, mesh).verdict, "accepted")
        self.assertEqual(noli.check(proof, self.V, self.F).verdict, "rejected")
        other = noli.CollisionMesh(self.F, bodies=self.bodies, ignore=[("floor", "floor")])
        self.assertEqual(noli.check(proof, self.V, other).verdict, "rejected")

    def test_empty_claims_are_no_proofs(self):
        result = noli.verify(self.V, [[0, 1, 2]])
        self.assertIn("empty", str(result))
        with self.assertRaises(noli.NotProved):
            result.raise_unless_proved()
        self.assertIn("125 of the 128 vertices belong to no cell and are ignored", result.notes)

    def test_bodies_that_do_not_cover_everything(self):
        mesh = noli.CollisionMesh(self.F, bodies={"sheet": self.bodies["sheet"]})
        self.assertEqual(noli.verify(self.V, mesh).first.bodies, ("", "sheet"))

    def test_one_frame_at_rest(self):
        self.assertEqual(noli.verify(self.V[0], self.F, at_rest=True).verdict, "proved")
        np.save(self.folder / "V.npy", self.V)
        self.assertEqual(noli.verify(self.folder / "V.npy", self.F).first.step, 4)

    def test_a_contact_has_a_witness(self):
        proof = self.folder / "contact.noli"
        self.assertEqual(noli.verify(self.V, self.F, proof=proof).verdict, "contact")
        self.assertEqual(noli.check(proof, self.V, self.F).verdict, "refuted")

    def test_raise_unless_proved(self):
        with self.assertRaises(noli.Contact) as raised:
            noli.verify(self.V, self.F).raise_unless_proved()
        self.assertAlmostEqual(raised.exception.time, 1 / 3)
        self.assertEqual(len(raised.exception.pairs), 100)
        with self.assertRaises(noli.NotProved):
            noli.verify(self.V[:4], self.F, check=False).raise_unless_proved()
        x = np.concatenate([self.V[:1, :64], self.V[:1, :64] + [0.01, 0.02, 0]], axis=1)
        with self.assertRaises(noli.Contact) as raised:
            noli.verify(np.repeat(x, 2, axis=0), self.F, dimension=3).raise_unless_proved()
        self.assertIn("from its beginning", str(raised.exception))
        self.assertIsNone(raised.exception.time)
        self.assertIsNone(raised.exception.result.first)

    def test_no_bool(self):
        for thing in (noli.verify(self.V, self.F), noli.time_of_impact(self.V[0], self.V[1], self.F)):
            with self.assertRaises(TypeError):
                bool(thing)

    def test_shows_itself(self):
        result = noli.verify(self.V, noli.CollisionMesh(self.F, bodies=self.bodies))
        self.assertTrue(str(result).splitlines()[-1].startswith("CONTACT  step 4"))
        self.assertIn("CONTACT", repr(result))
        self.assertNotIn("--", str(result))
        page = result._repr_html_()
        self.assertIn("CONTACT", page)
        self.assertIn("crossing", page)
        self.assertEqual(json.loads(json.dumps(result.to_json())), result.to_json())

    def test_report(self):
        result = noli.verify(self.V, self.F)
        try:
            result.report(self.folder / "page.html")
        except noli.UsageError as error:
            self.skipTest(str(error))
        self.assertIn("contact", (self.folder / "page.html").read_text(encoding="utf-8"))
        with self.assertRaisesRegex(noli.UsageError, "exists already"):
            result.report(self.folder / "page.html")
        self.V[2, 3, 1] += 1e-9
        with self.assertRaisesRegex(noli.InputError, "has changed"):
            result.report(self.folder / "other.html")

    def test_pictures(self):
        result = noli.verify(self.V, self.F)
        grid_file = self.folder / "first.vtu"
        result.to_vtu(grid_file)
        frames, _ = noli.read_frames([grid_file])
        x = self.V[3] + result.first.time * (self.V[4] - self.V[3])
        self.assertTrue(np.allclose(frames[0], x, atol=1e-15))
        self.assertIn(b"contact", grid_file.read_bytes())
        shown = result._outcome.contact_frame(0)
        self.assertEqual(set(np.flatnonzero(shown["marks"] == 2)), {result.to_json()["first"]["cells"][1][0]})
        try:
            result.to_png(self.folder / "first.png", number=3)
            self.assertTrue((self.folder / "first.png").read_bytes().startswith(b"\x89PNG"))
        except noli.UsageError as error:
            self.assertIn("built without", str(error))
        with self.assertRaisesRegex(noli.UsageError, "beyond the 100 listed contacts"):
            result.to_vtu(self.folder / "none.vtu", number=101)
        with self.assertRaisesRegex(noli.InputError, "no contact"):
            noli.verify(self.V[:4], self.F).to_vtu(self.folder / "none.vtu")
        with self.assertRaisesRegex(noli.UsageError, "spent"):
            noli.verify(iter(self.V), self.F).to_vtu(self.folder / "none.vtu")
        self.V[0, 0, 0] += 1
        with self.assertRaisesRegex(noli.InputError, "other frames"):
            result.to_vtu(self.folder / "none.vtu")
        with self.assertRaisesRegex(noli.UsageError, "backend"):
            noli.verify(self.V[1:], self.F).plot(backend="pencil")

    def test_plot(self):
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("there is no matplotlib")
        figure = noli.verify(self.V, self.F).plot(backend="matplotlib")
        figure.savefig(self.folder / "plot.png")
        self.assertTrue((self.folder / "plot.png").read_bytes().startswith(b"\x89PNG"))

    def test_progress(self):
        told = []
        noli.verify(self.V, self.F, keep_going=True, progress=lambda work, share: told.append((work, share)))
        self.assertTrue(told and all(work in ("look", "verify") and 0 <= share <= 1 for work, share in told))

        def fails(work, share):
            raise ZeroDivisionError

        with self.assertRaises(ZeroDivisionError):
            noli.verify(self.V, self.F, progress=fails)

    def test_undecided(self):
        result = noli.verify(self.V, self.F, time_limit=1e-9)
        self.assertEqual(result.verdict, "undecided")
        self.assertFalse(result.complete)

    def test_least_distance(self):
        self.assertEqual(noli.verify(self.V[:4], self.F, min_distance=0.01).verdict, "proved")
        self.assertEqual(noli.verify(self.V[:4], self.F, min_distance=0.5).verdict, "too_near")


class BadInput(TestCase):
    def setUp(self):
        super().setUp()
        self.V, self.F, _ = falling_sheet(4)

    def refused(self, pattern, *arguments, error=noli.InputError, **options):
        with self.assertRaisesRegex(error, pattern):
            noli.verify(*arguments, **options)

    def test_shapes(self):
        self.refused("shape", self.V[0], self.F)
        self.refused("shape", self.V[..., :1], self.F)
        self.refused("shape", self.V[..., np.newaxis], self.F)
        self.refused("single frame", self.V[:1], self.F)
        self.refused("31 positions", [self.V[0], self.V[1][:-1]], self.F)
        self.refused("shape", [self.V[0], self.V[1][0]], self.F)
        self.refused("found none", [], self.F)
        self.refused("yielded none", iter([]), self.F)
        self.refused("single frame", iter([self.V[0]]), self.F)
        self.refused("shape", self.V, np.arange(8))
        self.refused("shape", self.V, np.zeros((2, 4), int))

    def test_types(self):
        self.refused("object", self.V.astype(object), self.F)
        self.refused("complex", self.V.astype(complex), self.F)
        self.refused("whole numbers", self.V, self.F.astype(float))
        self.refused("not exact", np.full((2, 3, 3), 2**53 + 1), [[0, 1, 2]])
        self.refused("masked", np.ma.masked_less(self.V, 0.5), self.F)
        self.refused("expected names", 5, self.F)
        self.assertEqual(noli.verify(np.arange(18).reshape(2, 3, 3), [[0, 1, 2]]).verdict, "proved")
        if np.finfo(np.longdouble).nmant > 52:
            self.refused("not exact", self.V.astype(np.longdouble) + np.longdouble(2) ** -60, self.F)

    def test_numbers(self):
        for bad in (np.nan, np.inf, -np.inf):
            V = self.V.copy()
            V[2, 5, 1] = bad
            self.refused(r"frames\[2\]: vertex 5", V, self.F)
            self.refused(r"frames\[2\]: vertex 5", iter(V), self.F)

    def test_vertices(self):
        self.refused("vertex 32 does not exist", self.V, [[0, 1, 32]])
        self.refused("no vertex -1", self.V, [[0, 1, -1]])
        self.refused("no vertex 4294967296", self.V, np.array([[0, 1, 2**32]]))
        self.refused("positions of 32 vertices; expected 40", self.V, noli.CollisionMesh(self.F, vertex_count=40))
        self.refused("need a mesh", self.V, error=noli.UsageError)
        self.refused("no faces, edges or points", self.V, noli.CollisionMesh())
        with self.assertRaisesRegex(noli.InputError, "also belongs to another body"):
            noli.verify(self.V, noli.CollisionMesh(self.F, bodies={"a": [0, 1], "b": [1]}, ignore=[("a", "b")]))
        with self.assertRaisesRegex(noli.UsageError, "expected a pair of bodies"):
            noli.CollisionMesh(self.F, bodies={"a": [0]}, ignore=[("a", "c")])
        with self.assertRaisesRegex(noli.InputError, "row 0 has vertices of a and no body"):
            noli.CollisionMesh(self.F, bodies={"a": [0], "b": [1]})
        with self.assertRaisesRegex(noli.UsageError, "expected a pair of bodies"):
            noli.CollisionMesh(self.F, bodies={"a": [], "b": []}, ignore=["ab"])

    def test_more_rows_than_there_are_numbers(self):
        rows = np.broadcast_to(np.zeros(3), (2, 2**31, 3))
        self.refused("at most 2147483647", rows, [[0, 1, 2]])
        self.refused("at most 2147483647", self.V, np.broadcast_to(np.zeros(3, int), (2**31, 3)))

    def test_cells_that_are_parts_of_others_are_dropped(self):
        F = [[0, 1, 2], [3, 4, 5]]
        mesh = noli.CollisionMesh(F, edges=[[0, 1], [2, 3], [3, 2], [5, 4]], points=[0, 6, 6, 2])
        self.assertEqual(mesh.edges.tolist(), [[2, 3]])
        self.assertEqual(mesh.points.tolist(), [6])
        V = np.random.default_rng(1).normal(size=(2, 7, 3))
        self.assertIn(noli.verify(V, mesh).verdict, ("proved", "contact"))
        mesh.faces = np.array([[-1, 0, 1]])
        self.refused("vertex -1 does not exist", V, mesh)

    def test_outputs_that_would_destroy_something(self):
        folder, link, device = self.folder / "folder", self.folder / "link", "/dev/null"
        folder.mkdir()
        link.symlink_to(self.folder / "target")
        for place in (folder, link, device):
            self.refused("not a plain file", self.V, self.F, proof=place, force=True, error=noli.UsageError)
        self.assertTrue(folder.is_dir() and link.is_symlink() and not os.path.isfile(device))
        file = self.folder / "V.npz"
        np.savez(file, vertices=self.V, faces=self.F)
        before = file.read_bytes()
        self.refused("is read", file, proof=file, force=True, error=noli.UsageError)
        self.assertEqual(file.read_bytes(), before)
        proof = self.folder / "old.noli"
        proof.write_text("old")
        noli.verify(self.V, self.F, proof=proof, force=True)
        self.assertNotEqual(proof.read_bytes(), b"old")

    def test_a_mesh_stays_as_it_was_checked(self):
        faces = np.ascontiguousarray(self.F, np.int64)
        mesh = noli.CollisionMesh(faces)
        faces[:] = -1
        self.assertEqual(noli.verify(self.V, mesh).verdict, "contact")
        with self.assertRaises(ValueError):
            mesh.faces[0, 0] = -1

    def test_options_of_files_with_arrays(self):
        for option in ({"order": "natural"}, {"keys": ["a"]}, {"polygons": "refuse"}, {"ignore": "a.json"}, {"scene_folder": "."}):
            self.refused("frames in files", self.V, self.F, error=noli.UsageError, **option)
        with self.assertRaises(noli.UsageError):
            noli.check(__file__, self.V, self.F, order="natural")
        with self.assertRaises(noli.UsageError):
            noli.check(__file__, ["a.obj", "b.obj"], order="nonsense")

    def test_options_that_do_not_go_together(self):
        V, F, _ = falling_sheet()
        for options, text in (
            ({"ring": 3}, "without min_distance"),
            ({"first_only": True, "keep_going": True}, "expected one of them at most"),
            ({"min_distance": "1mm"}, "min_distance: expected a number"),
            ({"time_limit": "soon"}, "time_limit: expected a number"),
            ({"time_limit": 0}, "a positive number of seconds"),
        ):
            with self.assertRaisesRegex(noli.UsageError, text):
                noli.verify(V[:3], F, **options)

    def test_mixed_frames(self):
        self.refused(r"frames\[1\]: has 2 coordinates; expected 3", [self.V[0], self.V[1][:, :2]], self.F)
        mixed = noli.verify([self.V[0], self.V[1].astype(np.float32)], self.F)
        self.assertEqual(mixed.inputs[0]["numbers"], "float32/float64")

    def test_options(self):
        self.refused("threads", self.V, self.F, threads=-1, error=noli.UsageError)
        self.refused("threads", self.V, self.F, threads=10**9, error=noli.UsageError)
        self.refused("max_reports", self.V, self.F, max_reports=-1, error=noli.UsageError)
        self.refused("max_reports", self.V, self.F, max_reports=2**63, error=noli.UsageError)
        self.refused("time_limit", self.V, self.F, time_limit=np.nan, error=noli.UsageError)
        self.refused("min_distance", self.V, self.F, min_distance=-1, error=noli.UsageError)
        self.refused("min_distance", self.V, self.F, min_distance=np.nan, error=noli.UsageError)
        self.refused("dimension", self.V, self.F, dimension=4, error=noli.UsageError)
        self.refused("ring", self.V, self.F, ring=0, error=noli.UsageError)
        self.refused("time_limit", self.V, self.F, time_limit=0, error=noli.UsageError)

    def test_files_have_the_messages_of_the_command(self):
        bad = self.folder / "bad.obj"
        bad.write_text("v 0 0\n")
        for names in ([bad, bad], [self.folder / "none.obj"], [self.folder / "x.stl", bad]):
            code, _, err = run_noli("verify", *names)
            self.assertEqual(code, 3)
            with self.assertRaises(noli.NoliError) as raised:
                noli.verify(names)
            self.assertIn(str(raised.exception).split("; ")[0], err)

    def test_generators_may_fail(self):
        def frames():
            yield self.V[0]
            raise LookupError("mine")

        self.refused("mine", frames(), self.F, error=LookupError)
        self.refused("frames\\[1\\]", iter([self.V[0], "text"]), self.F)

    def test_a_proof_that_cannot_be_written(self):
        with self.assertRaises(OSError):
            noli.verify(self.V, self.F, proof=self.folder / "no" / "proof.noli")
