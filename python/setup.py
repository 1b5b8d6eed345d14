# SPDX-License-Identifier: Apache-2.0
"""The wheel: what CMake builds, and the modules around it.

    pip wheel --no-build-isolation --no-deps python/

It needs no network. NOLI_BUILD names a build folder of CMake to use; default: build/wheel. The libraries of the system
that the module is linked with (GMP, MPFR, oneTBB, fmt, pugixml, libzip) have to be where the wheel is installed.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent
BUILD = pathlib.Path(os.environ.get("NOLI_BUILD", ROOT / "build" / "wheel")).absolute()
PROGRAMS = ("noli_check", "noli_check_verified", "noli_series")


def version():
    """That of the project."""
    return re.search(r"^project\(noli VERSION ([0-9.]+)", (ROOT / "CMakeLists.txt").read_text(), re.MULTILINE)[1]


def build():
    """The module and the programs beside it."""
    if not (BUILD / "CMakeCache.txt").exists():
        options = ["-DCMAKE_BUILD_TYPE=Release", "-DNOLI_WITH_PYTHON=ON", "-DNOLI_BUILD_TESTS=OFF"]
        if shutil.which("npm"):
            options.append("-DNOLI_WITH_REPORT=ON")
        command = ["cmake", "-S", ROOT, "-B", BUILD, "-G", "Ninja", f"-DPython_EXECUTABLE={sys.executable}", *options]
        subprocess.run(command, check=True)
    make = ["cmake", "--build", BUILD, "--parallel", str(os.cpu_count()), "--target"]
    subprocess.run([*make, "noli_python"], check=True)
    targets = subprocess.run(["cmake", "--build", BUILD, "--target", "help"], check=True, capture_output=True, text=True)
    if "noli_check_verified" in targets.stdout:  # where there is Coq
        subprocess.run([*make, "noli_check_verified"], check=True)


class BuildWithCMake(build_py):
    """Puts the module and the programs into the package."""

    def run(self):
        super().run()
        build()
        package = pathlib.Path(self.build_lib) / "noli"
        programs = package / "programs"
        programs.mkdir(parents=True, exist_ok=True)
        name = "_core" + sysconfig.get_config_var("EXT_SUFFIX")
        module = BUILD / "python" / "noli" / name
        if not module.exists():
            sys.exit(f"{module}: is not there; expected a build for this Python ({sys.executable})")
        subprocess.run(["strip", "--strip-unneeded", "-o", package / name, module], check=True)
        for name in PROGRAMS:
            if (BUILD / "app" / name).exists():
                shutil.copy2(BUILD / "app" / name, programs / name)


class OfThisMachine(Distribution):
    """The wheel is for one kind of machine and one version of Python."""

    def has_ext_modules(self):
        return True


setup(
    version=version(),
    packages=["noli"],
    package_data={"noli": ["py.typed", "*.pyi"]},
    cmdclass={"build_py": BuildWithCMake},
    distclass=OfThisMachine,
)
