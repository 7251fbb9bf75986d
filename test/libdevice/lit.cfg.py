# Programs in C for the device, run on the simulator. Many compile the same
# source for the host and compare what the two print.
import os

import lit.formats

config.name = "libdevice"
config.test_format = lit.formats.ShTest(execute_external=False)
config.suffixes = [".c", ".test"]
config.excludes = ["Inputs"]
config.test_source_root = os.path.dirname(__file__)
root = os.path.dirname(os.path.dirname(config.test_source_root))
build = os.path.abspath(lit_config.params.get("build", os.path.join(root, "build", "release")))
config.test_exec_root = os.path.join(build, "test", "libdevice")
config.environment["PATH"] = os.pathsep.join(
    [os.path.join(build, "bin"), "/usr/lib/llvm-19/bin", os.environ["PATH"]])
config.substitutions += [
    ("%root", root),
    ("%inputs", os.path.join(config.test_source_root, "Inputs")),
]
