# The lit tests of everything that works from the command line, one folder a
# kind. usage: lit --param build=BUILD_FOLDER test[/FOLDER]
#
# A feature stands for a program or library of the build, or data beside the
# repository; a test that needs one says REQUIRES: and is skipped where it is
# missing, which is printed below.
import glob
import os
import platform
import shutil
import subprocess
import sys

import lit.formats

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
build = os.path.abspath(lit_config.params.get("build", os.path.join(root, "build", "dev")))

config.name = "vorion"
config.test_format = lit.formats.ShTest(execute_external=False)
config.suffixes = [".ll", ".mir", ".s", ".c", ".cl", ".test"]
config.excludes = ["Inputs", "tools"]
config.test_source_root = os.path.join(root, "test")
config.test_exec_root = os.path.join(build, "test")
config.environment["PATH"] = os.pathsep.join(
    [os.path.join(build, "bin"), "/usr/lib/llvm-19/bin", os.environ["PATH"]])
config.environment["VORION_ROOT"] = build
# PyOpenCL would keep programs for later runs, which then test an older build.
config.environment["PYOPENCL_NO_CACHE"] = "1"
packages = config.environment["PYTHONPATH"] = os.path.join(build, "lib", "python3", "dist-packages")
config.substitutions += [
    ("%root", root),
    ("%build", build),
    # What header tests include when nothing is installed yet.
    ("%include", os.path.join(build, "intrinsics", "generated", "include")),
    ("%python", f'"{sys.executable}"'),
    # The one that has NumPy, and for which the package vorion is built.
    ("%debian-python", "/usr/bin/python3"),
    ("%data", os.path.join(root, "..", "shared", "data")),
]

programs = ["vorion-clang", "vorion-compiler", "vorion-cl-link", "vorion-explorer", "vorion-link", "vorion-llc", "vorion-mc", "vorion-objdump", "vorion-opt", "vorion-sim",
            "isasim-decode-words", "isasim-raster-tiles", "isasim-raster-triangles",
            "splat", "splat-check-gradients", "splat-figures", "splat-fixture", "splat-hard-cases", "splat-reference", "splat-scene-samples", "splat-capture-samples", "splat-reader-work", "sample-radixsort", "sample-vecadd"]
features = {name: os.path.join(build, "bin", name) for name in programs}
features["vorion-runtime"] = os.path.join(build, "lib", "libvorion-runtime.so")
# What makes calls of programs fail (test/faults).
features["failing-calls"] = os.path.join(build, "lib", "libvorion-failing-calls.so")
# What keeps clang-tidy out of the system's headers (test/lint).
features["own-declarations"] = os.path.join(build, "lib", "libvorion-own-declarations.so")
# The OpenCL platform of the build and no other, as scripts/env.sh has it.
features["vorion-device"] = config.environment["OCL_ICD_VENDORS"] = os.path.join(build, "etc", "OpenCL", "vendors")
features["vorion-python"] = os.path.join(packages, "vorion", "__init__.py")
features["torch"] = "/usr/lib/python3/dist-packages/torch"
features["jsonschema"] = "/usr/lib/python3/dist-packages/jsonschema"
features["data"] = os.path.join(root, "..", "shared", "data")
# LLVM's own tests, as scripts/fetch-source.sh leaves them.
features["llvm-tests"] = os.path.join(os.environ.get("VORION_SOURCES") or os.path.join(root, "build", "sources"), "llvm-tests")
features["gdb-multiarch"] = shutil.which("gdb-multiarch") or "gdb-multiarch"
features["qemu-riscv32"] = shutil.which("qemu-riscv32") or "qemu-riscv32"
features["qemu-x86_64"] = shutil.which("qemu-x86_64") or "qemu-x86_64"
features["spirv-as"] = shutil.which("spirv-as") or "spirv-as"
features["csmith"] = shutil.which("csmith") or "csmith"
features["chromium"] = shutil.which("chromium") or "chromium"
features["mkdocs"] = shutil.which("mkdocs") or "mkdocs"
features["mypy"] = shutil.which("mypy") or "mypy"
features["python3-pip"] = "/usr/lib/python3/dist-packages/pip"
features["lintian"] = shutil.which("lintian") or "lintian"
for formatter_or_shell in ("mandoc", "man", "zsh", "fish"):
    features[formatter_or_shell] = shutil.which(formatter_or_shell) or formatter_or_shell
# Packages of the npm registry, where scripts/peers.sh installs them.
modules = os.path.join(root, "build", "peers", "node_modules")
config.substitutions.append(("%modules", modules))
for package, path in (("splat-transform", "@playcanvas/splat-transform"), ("gaussian-splats-3d", "@mkkellogg/gaussian-splats-3d"),
                      ("playcanvas", "playcanvas"), ("babylonjs", "babylonjs-loaders")):
    features[f"npm-{package}"] = os.path.join(modules, path)
# Programs that splat calls.
for program in ("colmap", "ffmpeg"):
    features[program] = shutil.which(program) or program
# Peers that read pictures, as Debian's packages install them for %debian-python.
for package, path in (("python3-pil", "PIL"), ("python3-opencv", "cv2")):
    features[package] = next(iter(glob.glob(f"/usr/lib/python3/dist-packages/{path}*")), f"/usr/lib/python3/dist-packages/{path}")
features["mpirun"] = shutil.which("mpirun") or "mpirun"
features["verilator"] = shutil.which("verilator") or "verilator"
features["yosys"] = shutil.which("yosys") or "yosys"
features["valgrind"] = shutil.which("valgrind") or "valgrind"
features["slurm"] = shutil.which("slurmctld", path=os.environ["PATH"] + ":/usr/sbin") or "slurmctld"
features["parallel"] = shutil.which("parallel") or "parallel"
if platform.machine() == "x86_64":
    config.available_features.add("x86-host")
else:
    lit_config.note(f"x86-host is missing: tests that require it are skipped (this is {platform.machine()})")
config.substitutions.append(("%llvm-tests", features["llvm-tests"]))
if shutil.which("unshare") and subprocess.run(
        ["unshare", "-rm", "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True, check=False).returncode == 0:
    config.available_features.add("own-mounts")
else:
    lit_config.note("own-mounts is missing: tests that require it are skipped (unshare -rm may not mount a tmpfs)")
# Root starts programs of the build as a user that is nobody.
if os.geteuid() == 0 and subprocess.run(
        ["test", "-x", os.path.join(build, "bin", "splat")], user=65534, group=65534, extra_groups=[], check=False).returncode == 0:
    config.available_features.add("other-user")
else:
    lit_config.note("other-user is missing: tests that require it are skipped (root alone runs programs as another user, who must "
                    "reach the build)")
try:
    with open("/proc/cpuinfo", encoding="utf-8") as cpus:
        flags = cpus.read().split()
except OSError:
    flags = []
if {"avx2", "bmi2", "fma"} <= set(flags):
    config.available_features.add("avx2-host")
else:
    lit_config.note("avx2-host is missing: tests that require it are skipped (this processor has no AVX2)")
for feature, path in features.items():
    if os.path.exists(path):
        config.available_features.add(feature)
    else:
        lit_config.note(f"{feature} is missing: tests that require it are skipped ({path} does not exist)")
