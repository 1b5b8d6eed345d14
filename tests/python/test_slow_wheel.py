# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import shutil
import subprocess
import sys

from support import ROOT, TestCase


class Wheel(TestCase):
    def test_it_is_built_offline_and_works_in_a_bare_environment(self):
        sources = self.folder / "sources" / "python"
        shutil.copytree(ROOT / "python", sources, ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
        shutil.copy(ROOT / "CMakeLists.txt", sources.parent)
        pip = [sys.executable, "-m", "pip", "--isolated", "--disable-pip-version-check"]
        subprocess.run(
            [*pip, "wheel", "--no-index", "--no-build-isolation", "--no-deps", sources, "-w", self.folder, "-q"], check=True
        )
        (wheel,) = self.folder.glob("noli-*.whl")
        place = self.folder / "bare"
        # numpy is the system's: there is no network to have another one from.
        subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", place], check=True)
        python = place / "bin" / "python"
        install = [python, "-m", "pip", "--isolated", "--disable-pip-version-check", "install", "--no-index", "--no-deps", "-q"]
        subprocess.run([*install, wheel], check=True)
        environment = {"PATH": "/usr/bin:/bin", "HOME": str(self.folder)}
        smoke = pathlib.Path(__file__).with_name("smoke.py")
        done = subprocess.run(
            [python, smoke], cwd=self.folder, env=environment, capture_output=True, text=True, check=False
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("works here", done.stdout)
        where = subprocess.run(
            [python, "-c", "import noli; print(noli.__file__)"], env=environment, capture_output=True, text=True, check=True
        )
        self.assertTrue(where.stdout.startswith(os.fspath(place)))
