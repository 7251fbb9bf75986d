"""Takes the module in C++ from a build of the tree, or builds it there for the Python that runs this."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
TREE = pathlib.Path(os.environ.get("VORION_ROOT") or ROOT / "build" / "dev").resolve()
VERSION = re.search(r"project\(.*?VERSION\s+([\d.]+)", (ROOT / "CMakeLists.txt").read_text(), re.S)[1]


class FromTree(build_ext):
    """No compiler is called here: CMake knows how."""

    def build_extension(self, ext):
        name = "_machine" + sysconfig.get_config_var("EXT_SUFFIX")
        built = TREE / "lib" / "python3" / "dist-packages" / "vorion" / name
        if not (TREE / "CMakeCache.txt").exists():
            raise SystemExit(f"{TREE}: no build, expected one (cmake --workflow --preset dev), or VORION_ROOT to name it")
        if not built.exists():
            subprocess.run(["cmake", f"-DVORION_OTHER_PYTHON={sys.executable}", str(TREE)], check=True)
            subprocess.run(["cmake", "--build", str(TREE), "--target", "vorion_other_python"], check=True)
        target = pathlib.Path(self.get_ext_fullpath(ext.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(built, target)
        (target.parent / "_built.py").write_text(f'"""Made by setup.py."""\nROOT = {str(TREE)!r}\n')


# Nothing is written into the source's folder.
with tempfile.TemporaryDirectory(prefix="vorion") as work:
    setup(version=VERSION, packages=["vorion"], package_dir={"": "."}, package_data={"vorion": ["py.typed", "*.pyi"]},
          ext_modules=[Extension("vorion._machine", [])], cmdclass={"build_ext": FromTree},
          options={"build": {"build_base": work}, "egg_info": {"egg_base": work}})
