# SPDX-License-Identifier: Apache-2.0
"""The types that people's editors see are true."""

import os
import pathlib
import shutil
import subprocess
import sys
import textwrap

from support import TestCase

HERE = pathlib.Path(__file__).parent


class Types(TestCase):
    def setUp(self):
        super().setUp()
        if shutil.which("mypy", path="/usr/bin") is None:
            self.skipTest("there is no mypy (scripts/setup)")

    def run_tool(self, *words):
        environment = {"PATH": "/usr/bin:/bin", "PYTHONPATH": os.environ["PYTHONPATH"], "MYPYPATH": os.environ["PYTHONPATH"]}
        return subprocess.run(
            ["/usr/bin/" + words[0], *words[1:]], cwd=self.folder, env=environment, capture_output=True, text=True, check=False
        )

    def test_the_stub_of_the_module_in_cpp(self):
        done = self.run_tool("stubtest", "noli._core", "--allowlist", str(HERE / "stubtest_allowlist.txt"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_package_is_typed(self):
        done = self.run_tool("mypy", "--ignore-missing-imports", "-p", "noli")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_program_of_a_user(self):
        program = self.folder / "mine.py"
        program.write_text(
            textwrap.dedent(
                """
                import noli
                import numpy as np

                result = noli.verify(np.zeros((2, 3, 3)), [[0, 1, 2]])
                word: str = result.verdict
                first = result.first
                if first is not None:
                    when: float = first.time
                free = noli.collision_free_step(np.zeros((3, 3)), np.ones((3, 3)), [[0, 1, 2]])
                share: float = free.step
                for window in noli.simulate({}, "run"):
                    energy: float = window.energies["total"]
                """
            ),
            encoding="utf-8",
        )
        done = self.run_tool("mypy", "--strict", "mine.py")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        program.write_text(program.read_text(encoding="utf-8") + "number: int = result.verdict\n", encoding="utf-8")
        done = self.run_tool("mypy", "--strict", "mine.py")
        self.assertIn("Incompatible types", done.stdout)


