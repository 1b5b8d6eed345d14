# SPDX-License-Identifier: Apache-2.0
"""What documents show runs as it stands there."""

import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
import textwrap
import unittest

import noli
import numpy as np
from support import ROOT, TestCase, falling_sheet, reports_are_there


class Snippets(TestCase):
    def setUp(self):
        super().setUp()
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder)

    def run_all(self, page):
        text = (ROOT / page).read_text(encoding="utf-8")
        snippets = re.findall(r"^```python\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
        names = {}
        for snippet in snippets:
            with contextlib.redirect_stdout(io.StringIO()):
                exec(compile(snippet, page, "exec"), names)
        return len(snippets)

    @unittest.skipUnless(reports_are_there(), "built without reports")
    def test_the_tutorial(self):
        self.assertGreater(self.run_all("docs/python.md"), 12)
        for name in ("first.png", "first.vtu", "fall.noli", "fall.html"):
            self.assertTrue((self.folder / name).exists(), name)

    def test_readme(self):
        self.assertGreater(self.run_all("README.md"), 0)


class Examples(TestCase):
    def run_example(self, name, *arguments):
        done = subprocess.run(
            [sys.executable, ROOT / "examples" / name, *arguments], capture_output=True, text=True, check=False
        )
        return done.returncode, done.stdout + done.stderr

    def test_meshio(self):
        try:
            import meshio
        except ImportError:
            self.skipTest("there is no meshio")
        V, F, _ = falling_sheet()
        for ending in (".vtk", ".msh", ".stl"):
            names = []
            for k, x in enumerate(V):
                names.append(str(self.folder / f"f{k}{ending}"))
                with contextlib.redirect_stdout(io.StringIO()):
                    meshio.Mesh(x, [("triangle", F)]).write(names[-1])
            code, said = self.run_example("meshio_frames.py", *names)
            self.assertEqual(code, 1, said)
            self.assertIn("CONTACT  step 4", said)
            code, said = self.run_example("meshio_frames.py", *names[:4])
            self.assertEqual(code, 0, said)
            self.assertIn("PROVED", said)
        x = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], float)
        names = []
        for k in range(2):
            names.append(str(self.folder / f"t{k}.vtk"))
            meshio.Mesh(x + k, [("tetra", np.array([[0, 1, 2, 3], [1, 2, 3, 4]]))]).write(names[-1])
        code, said = self.run_example("meshio_frames.py", *names)
        self.assertEqual(code, 0, said)
        self.assertIn("6 cells", said)
        # Two blocks share a side, which is inside.
        for k in range(2):
            tetra = [("tetra", np.array([[0, 1, 2, 3]])), ("tetra", np.array([[1, 2, 3, 4]]))]
            meshio.Mesh(x + k, tetra).write(names[k])
        self.assertIn("6 cells", self.run_example("meshio_frames.py", *names)[1])
        # Files with different cells, and a file that does not exist.
        meshio.Mesh(x, [("tetra", np.array([[0, 1, 2, 3]]))]).write(names[1])
        code, said = self.run_example("meshio_frames.py", *names)
        self.assertEqual(code, 3, said)
        self.assertIn("another mesh", said)
        self.assertEqual(self.run_example("meshio_frames.py", "no_such_file.vtk")[0], 3)
        self.assertEqual(self.run_example("meshio_frames.py")[0], 3)

    def test_blender(self):
        """Debian's Blender, where it is (`scripts/test --all` installs it)."""
        blender = shutil.which("blender")
        if blender is None:
            self.skipTest("there is no Blender")
        make = self.folder / "make.py"
        make.write_text(
            textwrap.dedent(
                f"""
                import bpy
                bpy.ops.wm.read_factory_settings(use_empty=True)
                bpy.ops.mesh.primitive_plane_add(size=4)
                bpy.ops.mesh.primitive_cube_add(size=1, location=(0.1, 0.2, 2))
                cube = bpy.context.object
                for frame, z in ((1, 2), (2, 1), (3, 0.6), (4, -0.2)):
                    cube.location.z = z
                    cube.keyframe_insert("location", frame=frame)
                for curve in cube.animation_data.action.fcurves:
                    for key in curve.keyframe_points:
                        key.interpolation = "LINEAR"
                bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, 4
                bpy.ops.wm.save_as_mainfile(filepath={str(self.folder / "fall.blend")!r})
                """
            ),
            encoding="utf-8",
        )
        subprocess.run([blender, "-b", "-P", make], check=True, capture_output=True)
        frames = self.folder / "frames.npz"
        words = [blender, "-b", self.folder / "fall.blend", "-P", ROOT / "examples" / "blender_frames.py", "--", frames]
        subprocess.run(words, check=True, capture_output=True)
        data = np.load(frames)
        self.assertEqual(data["vertices"].shape, (4, 12, 3))
        self.assertEqual(len(data["faces"]), 14)
        self.assertEqual(noli.verify(frames).first.step, 3)
