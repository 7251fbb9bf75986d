#!/usr/bin/env python3
"""Random instruction streams, compared register by register with qemu-riscv32.

Each seed gives a program (random_program.py) that runs as a Linux user program under QEMU and as a kernel on
vorion-sim, on one lane of one core; the logs of all registers after every block must be the same bit for bit. Odd
seeds run on a core of one lane, even ones on lane 0 of sixteen.

exit codes: 0 no difference, 1 differences (the seed's files are kept), 2 usage
"""

import argparse
import collections
import concurrent.futures
import itertools
import json
import os
import shutil
import struct
import subprocess
import sys

INPUTS = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(INPUTS)))
sys.path += [os.path.join(ROOT, "intrinsics", "generate"), INPUTS]
import assembly  # noqa: E402
import random_program  # noqa: E402
from records import Records  # noqa: E402

NAMES = [f"x{n}" for n in range(1, 32)] + [f"f{n}" for n in range(32)] + ["fcsr"]
CHECKPOINT = 4 * len(NAMES)
PASS_BYTES = random_program.BLOCKS * CHECKPOINT + random_program.SCRATCH
LOG_BYTES = random_program.PASSES * PASS_BYTES
# The machine has neither double precision nor compressed instructions, and f registers are 32 bits wide.
QEMU = ["qemu-riscv32", "-cpu", "rv32,c=false,d=false,zba=true,zbb=true,zbs=true"]
TIMEOUT = 300  # seconds for one program on one machine; it takes less than one


def build(folder, generator, records):
    """Writes and links the two programs into the folder."""
    def at(name):
        return os.path.join(folder, name)
    with open(at("program.s"), "w", encoding="utf-8") as file:
        file.write("\n".join(generator.lines) + "\n")
    with open(at("table.s"), "w", encoding="utf-8") as file:
        file.write("table:\n" + "".join(f"  .word {word:#010x}\n" for word in generator.table))
    numbers = dict([*assembly.numbers(records), *assembly.offsets(records)])
    symbols = {name: numbers[name] for name in ("VX_LAUNCH_ARGS", "VX_ARG_GLOBAL")}
    symbols["VX_TMC"] = next(r.Match for r in records.of("Instruction") if r.Mnemonic == "vx_tmc")
    symbols |= {name: getattr(random_program, name) for name in ("PASSES", "SCRATCH", "TABLE_STEP")}
    symbols["LOG_BYTES"] = LOG_BYTES
    image = [f"--defsym={name}={value:#x}" for name, value in numbers.items() if name.startswith("VX_IMAGE_")]
    for source in ("frame", "linux", "vorion"):
        subprocess.run(["llvm-mc-19", "--triple=riscv32", "--mattr=+m,+a,+f", "--target-abi=ilp32f", "--filetype=obj",
                        *(f"--defsym={name}={value:#x}" for name, value in symbols.items()), "-I", folder,
                        os.path.join(INPUTS, "streams", f"{source}.s"), "-o", at(f"{source}.o")], check=True)
    for machine in ("linux", "vorion"):
        subprocess.run(["ld.lld-19", *image, "-T", os.path.join(ROOT, "libdevice", "start", "vorion.ld"),
                        at(f"{machine}.o"), at("frame.o"), "-o", at(f"{machine}.elf")], check=True)


def execute(folder, seed, simulator):
    """Runs both programs, whose logs are then linux.log and vorion.log; returns what went wrong, None if nothing."""
    try:
        return execute_in_time(folder, seed, simulator)
    except subprocess.TimeoutExpired as expired:
        return f"{expired.cmd[0]} did not end within {TIMEOUT} s"


def execute_in_time(folder, seed, simulator):
    def at(name):
        return os.path.join(folder, name)
    config = {"clusters": 1, "sockets_per_cluster": 1, "cores_per_socket": 1, "host_threads": 1,
              "lanes_per_warp": 1 if seed % 2 else 16, "global_bytes": 1 << 24}
    with open(at("config.json"), "w", encoding="utf-8") as file:
        json.dump(config, file)
    with open(at("linux.log"), "wb") as log:
        theirs = subprocess.run([*QEMU, at("linux.elf")], stdout=log, stderr=subprocess.PIPE, timeout=TIMEOUT)
    if theirs.returncode != 0:
        return f"qemu-riscv32 ended with {theirs.returncode}: {theirs.stderr.decode()}"
    ours = subprocess.run([simulator, at("vorion.elf"), "--config", at("config.json"), "--global", "1", "--local", "1",
                           "--arg", f"out:{LOG_BYTES}@{at('vorion.log')}"], stderr=subprocess.PIPE, timeout=TIMEOUT)
    if ours.returncode != 0:
        return f"vorion-sim ended with {ours.returncode}: {ours.stderr.decode()}"
    return None


def disassemble(lines):
    """The text of the .word lines up to the first other line."""
    words = [int(line.split()[1], 16) for line in itertools.takewhile(lambda line: ".word" in line, lines)]
    code = "\n".join(" ".join(f"{byte:#x}" for byte in struct.pack("<I", word)) for word in words)
    text = subprocess.run(["llvm-mc-19", "--disassemble", "--triple=riscv32", "--mattr=+m,+a,+f,+zba,+zbb,+zbs"],
                          input=code, text=True, check=True, stdout=subprocess.PIPE).stdout
    return text.replace("\t.text\n", "").rstrip()


def difference(ours, theirs, lines):
    """The first difference of two logs, in words; None if there is none."""
    if len(ours) != LOG_BYTES or len(theirs) != LOG_BYTES:
        return f"{len(ours)} and {len(theirs)} bytes of log, expected {LOG_BYTES}"
    if ours == theirs:
        return None
    place = next(n for n in range(0, LOG_BYTES, 4) if ours[n:n + 4] != theirs[n:n + 4])
    (our,), (their,) = (struct.unpack_from("<I", log, place) for log in (ours, theirs))
    number, within = divmod(place, PASS_BYTES)
    block = within // CHECKPOINT
    values = f"{our:#010x}, qemu-riscv32 has {their:#010x}"
    if block >= random_program.BLOCKS:
        return f"pass {number}, scratch + {within - block * CHECKPOINT:#x}: {values}"
    return (f"pass {number}, block {block}, {NAMES[within % CHECKPOINT // 4]}: {values}; the block:\n"
            + disassemble(lines[lines.index(f"# block {block}") + 1:]))


def compare(seed, folder, simulator):
    """One seed: {"seed", "counts" by mnemonic, "wrong": text or None}. Keeps the files if something is wrong."""
    folder = os.path.join(folder, f"seed-{seed}")
    os.makedirs(folder, exist_ok=True)
    records = Records()
    generator = random_program.Generator(records, seed)
    build(folder, generator, records)
    wrong = execute(folder, seed, simulator)
    if wrong is None:
        logs = []
        for machine in ("vorion", "linux"):
            with open(os.path.join(folder, f"{machine}.log"), "rb") as file:
                logs.append(file.read())
        wrong = difference(*logs, generator.lines)
    if wrong is None:
        shutil.rmtree(folder)
    else:
        wrong = f"seed {seed}: {wrong}\nfiles: {folder}"
    return {"seed": seed, "counts": {name: random_program.PASSES * n for name, n in generator.counts.items()},
            "wrong": wrong}


def results(options, done):
    """Results in the order of seeds, endlessly: those done before, then new ones, `jobs` at a time."""
    seeds = itertools.count(options.first_seed)
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        running = collections.deque()
        while True:
            while len(running) < options.jobs:
                seed = next(seeds)
                running.append(done[seed] if seed in done else
                               pool.submit(compare, seed, options.folder, options.simulator))
            oldest = running.popleft()
            yield oldest if isinstance(oldest, dict) else oldest.result()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--simulator", default=os.path.join(ROOT, "build", "dev", "bin", "vorion-sim"))
    parser.add_argument("--folder", default=os.path.join(ROOT, "build", "random-streams"),
                        help="where files and results go")
    parser.add_argument("--instructions", type=int, default=100_000, help="compare at least so many")
    parser.add_argument("--first-seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--resume", action="store_true", help="use the results of earlier runs of this version that the folder has")
    options = parser.parse_args()
    for program in (QEMU[0], options.simulator):
        if not shutil.which(program):
            parser.error(f"{program}: no such program")

    os.makedirs(options.folder, exist_ok=True)
    ledger = os.path.join(options.folder, "results.jsonl")
    done = {}
    if options.resume and os.path.exists(ledger):
        with open(ledger, encoding="utf-8") as file:
            done = {result["seed"]: result for result in map(json.loads, file) if not result["wrong"]}

    counts, seeds, wrong = collections.Counter(), [], 0
    with open(ledger, "a" if options.resume else "w", encoding="utf-8") as file:
        for result in results(options, done):
            seeds.append(result["seed"])
            counts.update(result["counts"])
            if result["seed"] not in done:
                file.write(json.dumps(result) + "\n")
                file.flush()
            if result["wrong"]:
                wrong += 1
                print(result["wrong"], flush=True)
            if counts.total() >= options.instructions:
                break

    print("instructions compared, by mnemonic:")
    for name, number in sorted(counts.items()):
        print(f"  {name:<10} {number:>9}")
    known = set(counts)
    left_out = [r.Mnemonic for r in Records().of("Rv32") if r.Mnemonic not in known]
    print(f"not compared: {', '.join(left_out)}")
    print(f"seeds {seeds[0]} to {seeds[-1]}: {counts.total()} instructions of {sum(n > 0 for n in counts.values())} "
          f"of {len(known)} mnemonics, {wrong} seeds with differences")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
