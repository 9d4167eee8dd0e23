"""Builds the C++ module of the Python package by CMake; pyproject.toml has everything else.

The environment variable QUADLOOP_BUILD names a complete build folder, whose module is installed instead of a new one.
"""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = Path(__file__).parent.resolve()


class CMakeBuild(build_ext):
    def build_extension(self, ext):
        module = Path(self.get_ext_fullpath(ext.name)).resolve()
        build = Path(os.environ.get("QUADLOOP_BUILD") or self.build_temp).resolve()
        if "QUADLOOP_BUILD" not in os.environ:
            subprocess.run(["cmake", "--preset", "release", "-B", build, "-DQUADLOOP_TESTS=OFF", f"-DQUADLOOP_PYTHON={sys.executable}"],
                           cwd=ROOT, check=True)
            subprocess.run(["cmake", "--build", build, "--target", "quadloop_python", "quadloop_reader"], check=True)
        module.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(next((build / "python" / "quadloop").glob("_core*.so")), module)
        shutil.copy(build / "io" / "quadloop-reader", module.parent)  # the program that reads CGNS and tree files


VERSION = re.search(r"VERSION ([\d.]+) DESCRIPTION", (ROOT / "CMakeLists.txt").read_text()).group(1)
setup(version=VERSION, ext_modules=[Extension("quadloop._core", sources=[])], cmdclass={"build_ext": CMakeBuild})
