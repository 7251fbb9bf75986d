#!/usr/bin/env python3
"""Makes calls of our programs fail one after the other, and demands that each run ends as it should.

usage: faults.py [--only NAME] [--share N] [--kinds write,rename,...] [--out FOLDER] [--jobs N] BUILD

Programs: splat render, train, accuracy and convert, and vorion-sim, on small scenes of our own. First each runs whole, and the
calls that it makes of open, write, close, rename, fsync, mmap and memory allocation are counted; of allocations, one a place
(a place is the 14 innermost callers). Then it runs once for each of them, and that one call fails. A run is good if it

- ends by itself in two minutes, and by no signal;
- ends with 0 and the same results, or with 3 (5 for memory) and one line, and what the line says is an error of the program;
- leaves of each result the old file, the new one, or none, never a part of one, and nothing beside them.

Prints what is not good and where the call came from, and the counts; the exit code is 1 if there was any. What has run is
kept in FOLDER (default: BUILD/faults) and not run again while the programs are the same. --share N runs every N-th case.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import shutil
import signal
import subprocess
import sys

KINDS = ("open", "write", "close", "rename", "fsync", "mmap", "alloc")
# elfutils 0.188 does not look whether the table of a unit's abbreviations was allocated (__libdw_intern_next_unit), so no
# caller can tell. A run that such an allocation of libdw's own ends by SIGSEGV counts, but not as ours.
UNCHECKED = "failed libdw.so"
HERE = os.path.dirname(os.path.abspath(__file__))
SCENE = os.path.join(HERE, "..", "render", "Inputs", "scene.py")

class Scenario:
    """A program, what it reads (made once) and what it writes."""

    def __init__(self, name, command, outputs):
        self.name, self.command, self.outputs, self.program = name, command, outputs, command[0]


RENDER = ["splat", "render", "one.ply", "--cameras", "one.json", "--view", "front"]
SCENARIOS = [
    Scenario("convert", ["splat", "convert", "one.ply", "-o", "out.ply"], ["out.ply"]),
    Scenario("info", ["splat", "info", "one.ply", "--json", "out.json"], ["out.json"]),
    Scenario("render", RENDER + ["-o", "out.png", "--json", "out.json", "--depth", "depth.pfm"],
             ["out.png", "out.json", "depth.pfm"]),
    Scenario("train", ["splat", "train", "capture", "-o", "out.ply", "--iterations", "2", "--json", "out.json",
                       "--checkpoint", "state", "--max-gaussians", "100"],
             ["out.ply", "out.json", "state"]),
    Scenario("accuracy", ["splat", "accuracy", "one.ply", "--cameras", "one.json", "-o", "out", "--only", "exp=table@front"],
             ["out/points/exp=table@front.json"]),
    Scenario("sim", ["vorion-sim", "kernel.elf", "--kernel", "twice", "--global", "64", "--local", "16", "--arg",
                     "buf@in.bin", "--arg", "out:256@out.bin", "--stats=stats.json", "--profile=profile.txt",
                     "--timeline", "timeline.json"],
             ["out.bin", "stats.json", "profile.txt"]),
]


def tell(text):
    print(text, flush=True)


def call(command, folder, environment, timeout):
    """Runs a command in a process group of its own, all of which ends with it."""
    process = subprocess.Popen(command, cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                               start_new_session=True)
    try:
        out, err = process.communicate(timeout=timeout)
        return process.returncode, err.decode(errors="replace")
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return "no end", ""


def skeleton(value):
    """A JSON document but for its numbers, which may be times."""
    if isinstance(value, dict):
        return {key: skeleton(v) for key, v in value.items()}
    if isinstance(value, list):
        return [skeleton(v) for v in value]
    return 0 if isinstance(value, (int, float)) else value


def content(path):
    """Of a result, to be compared; None if there is none."""
    if not os.path.exists(path):
        return None
    with open(path, "rb") as f:
        data = f.read()
    if data == b"old":
        return "old"
    if path.endswith((".html", ".txt")):  # with times in them
        return "whole text" if data.endswith(b"\n") else "half"
    if not path.endswith(".json"):
        return data
    try:
        document = json.loads(data)
    except ValueError:
        return "half"
    if isinstance(document, dict):
        document.pop("program", None)  # which folder it ran in, and a commit that may be unreadable
    return skeleton(document)


class Runner:
    def __init__(self, build, out):
        self.build, self.out = build, out
        self.library = os.path.join(build, "lib", "libvorion-failing-calls.so")
        self.inputs = os.path.join(out, "inputs")
        if not os.path.exists(self.inputs):
            making = self.inputs + ".making"
            shutil.rmtree(making, ignore_errors=True)
            os.makedirs(making)
            prepare(making)
            os.rename(making, self.inputs)

    def version(self, scenario):
        """Of what a scenario's results come from."""
        files = [f"bin/{scenario.program}", "lib/libvorion-failing-calls.so"]
        if scenario.program == "splat":
            files += ["lib/libvorion-runtime.so", "pocl/lib/libvorion-pocl.so"]
        all_of_them = hashlib.sha256()
        for file in files:
            with open(os.path.join(self.build, file), "rb") as f:
                all_of_them.update(f.read())
        return all_of_them.hexdigest()[:16]

    def run(self, scenario, case, fault, timeout=120):
        """Runs it in a folder of its own; exit code, what it said, its log and its results."""
        folder = os.path.join(self.out, "work", f"{scenario.name}-{case}")
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(self.inputs, folder, ignore=shutil.ignore_patterns("samples"))
        for output in scenario.outputs:
            if os.path.dirname(output) == "":
                with open(os.path.join(folder, output), "w") as f:
                    f.write("old")
        log = os.path.join(folder, "log")
        environment = os.environ | {"LD_PRELOAD": self.library, "VORION_FAULT": fault, "VORION_FAULT_LOG": log,
                                    "VORION_FAULT_PROGRAM": scenario.program,
                                    "POCL_CACHE_DIR": os.path.join(self.out, "cache")}
        code, said = call(scenario.command, folder, environment, timeout)
        with open(log) if os.path.exists(log) else open(os.devnull) as f:
            log = f.read().splitlines()
        results = {o: content(os.path.join(folder, o)) for o in scenario.outputs}
        strays = sorted(n for n in os.listdir(folder) if n.startswith(".vorion"))
        shutil.rmtree(folder, ignore_errors=True)
        return code, said, log, results, strays

    def whole(self, scenario, fault):
        """A run without faults: its log and its results."""
        code, said, log, results, strays = self.run(scenario, "whole", fault, timeout=600)  # compiles kernels
        if code != 0 or strays or None in results.values():
            sys.exit(f"{scenario.name} does not run without faults: {code} {said} {strays} {list(results)}")
        return log, results

    def cases(self, scenario, kinds):
        """"KIND:N" of every call."""
        log, results = self.whole(scenario, "write:0")
        cases = []
        for kind, count in (line.split() for line in log):
            if kind in kinds and kind != "alloc":
                cases += [f"{kind}:{n}" for n in range(1, int(count) + 1)]
        if "alloc" in kinds:
            log, _ = self.whole(scenario, "alloc:0")
            cases += [f"alloc:{line.split()[1]}" for line in log if line.startswith("place")]
        # A program that starts itself has the same numbers twice.
        return list(dict.fromkeys(cases)), results

    def check(self, scenario, case, whole):
        """What is not good about a run in which one call fails, and where that was."""
        code, said, log, results, strays = self.run(scenario, case.replace(":", "-"), case)
        place = next((line for line in log if line.startswith("failed")), "not reached")
        lines = [line for line in said.splitlines() if "error" in line]
        problems = []
        if code == -signal.SIGSEGV and place.startswith(UNCHECKED):
            return {"case": case, "problems": [], "code": code, "said": "", "place": place}
        if code not in (0, 3, 5):
            problems.append(f"ended with {code}")
        if code in (3, 5) and (len(lines) != 1 or not lines[0].startswith(scenario.program + ": error: ")):
            problems.append(f"{len(lines)} lines of errors")
        for output, result in results.items():
            if result != whole[output] and (code == 0 or result not in (None, "old")):
                problems.append(f"{output} is {'not what it was' if code == 0 else 'neither old nor new'}")
        if strays:
            problems.append(f"left {', '.join(strays)}")
        return {"case": case, "problems": problems, "code": code, "said": said[-2000:] if problems else "", "place": place}


def prepare(folder):
    """What the scenarios read."""
    run = lambda *command: subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    run(sys.executable, SCENE, "one", "one.ply", "one.json")
    run("splat-capture-samples", "samples")
    os.rename(os.path.join(folder, "samples", "captures", "transforms"), os.path.join(folder, "capture"))
    with open(os.path.join(folder, "kernel.cl"), "w") as f:
        f.write("kernel void twice(global const int *a, global int *b) { int i = get_global_id(0); b[i] = 2 * a[i]; }\n")
    run("vorion-clang", "kernel.cl", "-o", "kernel.elf")
    with open(os.path.join(folder, "in.bin"), "wb") as f:
        f.write(bytes(range(256)))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build")
    parser.add_argument("--only", choices=[s.name for s in SCENARIOS], action="append")
    parser.add_argument("--share", type=int, default=1)
    parser.add_argument("--kinds", default=",".join(KINDS))
    parser.add_argument("--out")
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    build = os.path.abspath(arguments.build)
    out = os.path.abspath(arguments.out or os.path.join(build, "faults"))
    os.makedirs(out, exist_ok=True)
    os.environ["PATH"] = os.path.join(build, "bin") + os.pathsep + os.environ["PATH"]
    os.environ.setdefault("OCL_ICD_VENDORS", os.path.join(build, "etc", "OpenCL", "vendors"))
    os.environ.setdefault("VORION_ROOT", build)
    runner = Runner(build, out)
    bad = 0
    for scenario in SCENARIOS:
        if arguments.only and scenario.name not in arguments.only:
            continue
        kept_file = os.path.join(out, f"{scenario.name}-{runner.version(scenario)}.jsonl")
        kept = {}
        if os.path.exists(kept_file):
            with open(kept_file) as f:
                kept = {row["case"]: row for row in map(json.loads, f.read().splitlines())}
        runner.whole(scenario, "write:0")  # fills the kernel cache
        cases, whole = runner.cases(scenario, arguments.kinds.split(","))
        cases = cases[::arguments.share]
        with open(kept_file, "a") as f, concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            for row in pool.map(lambda c: runner.check(scenario, c, whole), [c for c in cases if c not in kept]):
                kept[row["case"]] = row
                f.write(json.dumps(row) + "\n")
                f.flush()
        rows = [kept[c] for c in cases]
        for row in rows:
            if row["problems"]:
                bad += 1
                tell(f"{scenario.name} {row['case']}: {'; '.join(row['problems'])}\n  {row['place']}")
                for line in row["said"].splitlines():
                    tell(f"  | {line}")
        counts = {k: sum(r["case"].startswith(k + ":") for r in rows) for k in KINDS}
        ended = {c: sum(r["code"] == c for r in rows) for c in sorted({r["code"] for r in rows}, key=str)}
        tell(f"{scenario.name}: {len(rows)} cases ({', '.join(f'{k} {n}' for k, n in counts.items() if n)}); "
             f"ended with {', '.join(f'{c}: {n}' for c, n in ended.items())}")
    tell(f"{bad} not good")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
