# SPDX-License-Identifier: Apache-2.0
"""pip install ./training/python --no-build-isolation: CMake builds the native module, for the Python that pip is of.

STRIKER_BUILD names a build folder, from the root, whose module is taken as it is, in place of one of its own beside the
sources (build-python)."""

import os
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = os.path.abspath(os.path.join(os.path.dirname(__file__), "..", ".."))


class CMakeBuild(build_ext):
    def run(self):
        build = os.environ.get("STRIKER_BUILD")
        if build is None:
            build = os.path.join(ROOT, "build-python")
            subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DSTRIKER_TESTS=OFF", "-DSTRIKER_PYTHON=ON", f"-DPython_EXECUTABLE={sys.executable}"],
                           check=True)
            subprocess.run(["cmake", "--build", build, "--target", "striker_python"], check=True)
        to = os.path.join(self.build_lib, "striker")
        os.makedirs(to, exist_ok=True)
        native = os.path.join(build, "python", "striker", "_native" + sysconfig.get_config_var("EXT_SUFFIX"))
        if not os.path.isfile(native):
            sys.exit(f"setup.py: no {native}: STRIKER_BUILD is the whole path of a folder where striker_python was built, for this "
                     "Python; or leave it out")
        shutil.copy(native, to)


setup(packages=["striker"], package_dir={"striker": "striker"}, ext_modules=[Extension("striker._native", [])],
      cmdclass={"build_ext": CMakeBuild})
