"""Compiles and runs C sources on the device (vorion-clang, vorion-sim) and as rv32 Linux programs (the packaged clang,
qemu-riscv32): the same ILP32 types, but one lane after the other and no compiler of ours."""

import dataclasses
import glob
import os
import resource
import signal
import subprocess

FOLDER = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.normpath(os.path.join(FOLDER, *[os.pardir] * 4))
TIMEOUT = 600       # seconds for one step, which takes less than a few on a calm machine
LINUX_SECONDS = 3   # of processor time, for programs that take hundredths
MAX_WARP_INSTRUCTIONS = 100_000_000
# C lets a compiler take for granted that most loops end, and then drop the code that leads to one that does not. Random sources
# may have such loops, and both sides are to agree about them.
LOOPS = "-fno-finite-loops"
LEVELS = ["-O0", "-O1", "-O2", "-O3", "-Os"]
# What of compiler-rt rv32imf needs for the programs made here.
BUILTINS = ["udivmoddi4", "udivdi3", "umoddi3", "divdi3", "moddi3", "fixsfdi", "fixunssfdi", "floatdisf", "floatundisf", "adddf3", "subdf3",
            "muldf3", "divdf3", "comparedf2", "extendsfdf2", "truncdfsf2", "fixdfsi", "fixunsdfsi", "fixdfdi", "fixunsdfdi",
            "floatsidf", "floatunsidf", "floatdidf", "floatundidf", "fp_mode", "popcountsi2", "muldi3", "lshrdi3", "ashrdi3",
            "ashldi3"]


class Refused(Exception):
    """The compiler for the device does not take the program."""


class Wrong(Exception):
    """The device did something else than the rv32 program, or did not end."""


class Endless(Exception):
    """The rv32 program does not end in time, which random sources that loop may not."""


@dataclasses.dataclass(frozen=True)
class Configuration:
    """How the device's program is compiled."""
    level: str
    zicond: bool
    zbb: bool

    def extensions(self):
        """Beyond rv32imaf."""
        return ["zicsr", *["zicond"] * self.zicond, "zacas", "zba", *["zbb"] * self.zbb, "zbs", "xvortex", "xvorion"]

    def flags(self):
        return [self.level, "_".join(["-march=rv32imaf", *self.extensions()])]

    def attributes(self):
        """The same for vorion-llc."""
        return ",".join("+" + name for name in ["m", "a", "f", *self.extensions()])

    def __str__(self):
        return self.level + ("" if self.zicond else " without Zicond") + ("" if self.zbb else " without Zbb")


CONFIGURATIONS = [Configuration(level, zicond, zbb) for level in LEVELS for zicond in (True, False) for zbb in (True, False)]


def run(command, **options):
    return subprocess.run(command, stderr=subprocess.PIPE, check=False, timeout=TIMEOUT, **options)


def failure(result):
    """Of a command, in a line."""
    text = result.stderr.decode(errors="replace")
    errors = [line for line in text.splitlines() if "error" in line] or text.splitlines()
    return f"exit code {result.returncode}: " + "; ".join(errors[:2])[:300]


class Linux:
    """rv32imf under qemu-riscv32."""

    FLAGS = ["--target=riscv32-unknown-linux-gnu", "-march=rv32imaf", "-mabi=ilp32f", "-ffp-contract=off", "-fno-math-errno",
             "-fno-pic", "-mno-relax", "-nostdlibinc", "-w", LOOPS]

    def __init__(self, folder):
        """Compiles into the folder what all programs link."""
        sources = os.path.join(os.environ.get("VORION_SOURCES") or os.path.join(ROOT, "build", "sources"),
                               "llvm", "compiler-rt", "lib", "builtins")
        objects = os.path.join(folder, "builtins")
        os.makedirs(objects, exist_ok=True)
        self.library = sorted(glob.glob(os.path.join(objects, "*.o")))
        if len(self.library) != len(BUILTINS):
            subprocess.run(["clang-19", *self.FLAGS, "-O1", "-ffreestanding", "-c",
                            *(os.path.join(sources, f"{name}.c") for name in BUILTINS)], cwd=objects, check=True, timeout=TIMEOUT)
            self.library = sorted(glob.glob(os.path.join(objects, "*.o")))

    def run(self, source, base, defines=(), level="-O1"):
        """The program's standard output. Files are `base` with an ending."""
        program = base + ".linux"
        built = run(["clang-19", *self.FLAGS, level, f"-I{FOLDER}", *defines, "-nostdlib", "-static", "-fuse-ld=lld", source,
                     *self.library, "-o", program])
        if built.returncode:
            raise RuntimeError(f"{source}: the packaged compiler fails: {failure(built)}")
        ran = self.execute(program)
        if ran.returncode:
            raise RuntimeError(f"{source}: under qemu-riscv32: {failure(ran)}")
        return ran.stdout

    def as_written(self, source, base):
        """The program's standard output where nothing is optimised; None if it does not end in time."""
        try:
            return self.run(source, base, level="-O0")
        except Endless:
            return None

    @staticmethod
    def execute(program, seconds=LINUX_SECONDS):
        # Not the time by the clock, which says little on a busy machine.
        ran = run(["qemu-riscv32", "-cpu", "rv32,zba=true,zbb=true,zbs=true", program], stdout=subprocess.PIPE,
                  preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1)))
        if ran.returncode in (-signal.SIGXCPU, 128 + signal.SIGXCPU):
            raise Endless
        return ran


class Device:
    """vorion-clang and vorion-sim, which are on the path."""

    def compile(self, source, base, configuration, options=(), ending=".elf"):
        program = base + ending
        built = run(["vorion-clang", "-w", *configuration.flags(), "-fno-math-errno", LOOPS, f"-I{FOLDER}", *options, source,
                     "-o", program])
        if built.returncode:
            raise Refused(failure(built))
        return program

    def run(self, program, base, groups, lanes, arguments, start, most=MAX_WARP_INSTRUCTIONS):
        """What the buffer `out`, the first argument, holds in the end, having held `start`."""
        with open(base + ".start", "wb") as file:
            file.write(start)
        options = [text for argument in (f"inout:{base}.start@{base}.out", *arguments) for text in ("--arg", argument)]
        try:
            ran = run(["vorion-sim", "--set", "host_threads=1", "--set", f"max_instructions={most}", program,
                       "--global", str(groups * lanes), "--local", str(lanes), *options])
        except subprocess.TimeoutExpired:
            raise Wrong(f"no end within {TIMEOUT} s") from None
        if ran.returncode:
            raise Wrong(failure(ran))
        with open(base + ".out", "rb") as file:
            return file.read()
