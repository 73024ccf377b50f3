# SPDX-License-Identifier: GPL-3.0-or-later
"""What pip runs: CMake builds argil._native as for every other use. Downloads nothing."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCES = Path(__file__).parent.resolve()
BYTES_FOR_A_COMPILER = 1.5e9


def project_version():
    text = (SOURCES / "CMakeLists.txt").read_text()
    return re.search(r"project\(Argil VERSION ([0-9.]+)", text).group(1)


def jobs():
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    return int(os.environ.get("ARGIL_JOBS", max(1, min(os.cpu_count(), memory // BYTES_FOR_A_COMPILER))))


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        for program in ("cmake", "ninja"):
            if shutil.which(program) is None:
                sys.exit(f"there is no {program}, which builds argil; install what it needs: "
                         "./cmake/setup.sh build package")
        made = Path(self.build_temp).resolve() / "cmake"
        target = Path(self.get_ext_fullpath(extension.name)).resolve()
        subprocess.run(["cmake", "-S", SOURCES, "-B", made, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                        "-DARGIL_BUILD_EVALUATION=OFF", "-DARGIL_BUILD_PYTHON=ON",
                        f"-DPython_EXECUTABLE={sys.executable}",
                        *os.environ.get("CMAKE_ARGS", "").split()], check=True)
        subprocess.run(["cmake", "--build", made, "--target", "argil_python", "-j", str(jobs())], check=True)
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(made / "python" / "argil" / target.name, target)
        subprocess.run(["strip", "--strip-unneeded", target], check=True)
        # The client of `argil bridge` is one file, which Blender uses without this package, too.
        shutil.copyfile(SOURCES / "examples/blender/argil_bridge.py", target.parent / "bridge.py")


setup(version=project_version(), ext_modules=[Extension("argil._native", sources=[])],
      cmdclass={"build_ext": CMakeBuild})
