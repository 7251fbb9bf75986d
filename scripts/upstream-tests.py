#!/usr/bin/env python3
"""Runs LLVM's own RISC-V tests (CodeGen and MC, from the source package that
the backend is built from) with the packaged tools and with ours: no test that
passes with the packaged tools may fail with ours.

Prints the counts for both and the tests that differ. What has been run with
the same tools is not run again, so a run that broke off goes on where it
stopped; --again forgets it. The tests come from
`scripts/fetch-source.sh llvm-tests`.
"""

import argparse
import collections
import json
import os
import shutil
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
LLVM = "/usr/lib/llvm-19"
LIT = os.path.join(LLVM, "build", "utils", "lit", "lit.py")
# The tools that contain the target; all others are the packaged ones.
TOOLS = {"llc": "vorion-llc", "opt": "vorion-opt", "llvm-mc": "vorion-mc", "llvm-objdump": "vorion-objdump"}
# The whole set is run in this many parts, each kept when done.
PARTS = 24
GOOD = ("PASS", "XFAIL", "FLAKYPASS")

# The packaged LLVM has no assertions; the rest is what the tests of these two folders ask for.
CONFIG = """import os
import lit.formats
config.name = "{toolset}"
config.test_format = lit.formats.ShTest(execute_external=False)
config.suffixes = [".ll", ".mir", ".s"]
config.test_source_root = {source!r}
config.test_exec_root = {folder!r}
config.targets = {{"RISCV"}}
config.available_features.update(["riscv-registered-target", "target=x86_64-pc-linux-gnu"])
config.environment["PATH"] = os.pathsep.join({path!r})
"""


def fail(code, message):
    print(f"upstream-tests: error: {message}", file=sys.stderr)
    sys.exit(code)


def stamp(programs):
    """What the tools are: results of other ones are not used."""
    described = []
    for program in programs:
        if not os.access(program, os.X_OK):
            fail(3, f"{program}: no such program, expected the packaged tools and a build of ours")
        status = os.stat(program)
        described.append(f"{program} {status.st_size} {status.st_mtime_ns}")
    return "\n".join(described)


class Toolset:
    """One set of tools and what is known of the tests with it."""

    def __init__(self, name, folder, source, path, programs):
        self.name, self.folder, self.stamp = name, folder, stamp(programs)
        os.makedirs(folder, exist_ok=True)
        text = CONFIG.format(toolset=name, source=source, folder=folder, path=path)
        with open(os.path.join(folder, "lit.cfg.py"), "w", encoding="utf-8") as file:
            file.write(text)

    def run(self, part, parts, jobs, again):
        """{test: lit's code} of one part of all tests."""
        kept = os.path.join(self.folder, f"{part}-of-{parts}.json")
        if not again and os.path.exists(kept):
            with open(kept, encoding="utf-8") as file:
                result = json.load(file)
            if result["tools"] == self.stamp:
                return result["codes"]
        raw = kept + ".lit"
        if os.path.exists(raw):
            os.remove(raw)
        done = subprocess.run([sys.executable, LIT, "-q", "--order=lexical", "-j", str(jobs), "--num-shards", str(parts), "--run-shard",
                               str(part), "-o", raw, self.folder], stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode not in (0, 1) or not os.path.exists(raw):
            fail(70, f"lit ended with {done.returncode}: {done.stdout.decode(errors='replace')[-2000:]}")
        with open(raw, encoding="utf-8") as file:
            tests = json.load(file)["tests"]
        os.remove(raw)
        codes = {test["name"].split(" :: ", 1)[1]: test["code"] for test in tests}
        with open(os.path.join(self.folder, f"{part}-of-{parts}.log"), "wb") as file:
            file.write(done.stdout)
        with open(kept + ".part", "w", encoding="utf-8") as file:
            json.dump({"tools": self.stamp, "codes": codes}, file)
        os.replace(kept + ".part", kept)
        return codes


def compare(packaged, ours):
    """The tests of which the packaged tools make more than ours."""
    return sorted(test for test, code in packaged.items() if code in GOOD and ours.get(test) not in GOOD)


def report(results):
    for name, codes in results.items():
        counts = collections.Counter(codes.values())
        good = sum(counts[code] for code in GOOD)
        skipped = counts["UNSUPPORTED"]
        print(f"{name}: {len(codes)} tests, {good} passed, {len(codes) - good - skipped} failed, "
              f"{skipped} not for these tools")
    differences = compare(results["packaged"], results["ours"])
    for test in differences:
        print(f"DIFFERS {test}: {results['packaged'][test]} packaged, {results['ours'].get(test, 'not run')} ours")
    print(f"{len(differences)} differences")
    return differences


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="exit codes: 0 no differences, 1 differences, 2 usage, "
                                     "3 the tests or a tool are missing, 70 lit itself failed")
    parser.add_argument("--build", default=os.path.join(ROOT, "build", "dev"), help="build folder with our tools")
    parser.add_argument("--tests", default=os.path.join(ROOT, "build", "sources", "llvm-tests"),
                        help="where the tests were unpacked")
    parser.add_argument("--tools", help="folder with programs to run in place of ours, under the packaged names")
    parser.add_argument("--work", help="where results are kept (default: upstream-tests/ of the build folder)")
    parser.add_argument("--every", type=int, metavar="N", help="run only every Nth test, in the order of their names")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--again", action="store_true", help="run also what has been run")
    parser.add_argument("--json", help="where the result goes (default: result.json beside the logs)")
    options = parser.parse_args()
    if options.every is not None and options.every < 1 or options.jobs < 1:
        parser.error("--every and --jobs take numbers from 1")

    source = os.path.join(os.path.abspath(options.tests), "llvm", "test")
    if not os.path.isdir(source):
        fail(3, f"{source}: no such folder, expected it from scripts/fetch-source.sh llvm-tests")
    build = os.path.abspath(options.build)
    work = os.path.abspath(options.work or os.path.join(build, "upstream-tests"))
    packaged = os.path.join(LLVM, "bin")
    links = os.path.abspath(options.tools) if options.tools else os.path.join(work, "bin")
    if not options.tools:
        shutil.rmtree(links, ignore_errors=True)
        os.makedirs(links)
        for theirs, mine in TOOLS.items():
            os.symlink(os.path.join(build, "bin", mine), os.path.join(links, theirs))
    rest = [packaged, "/usr/bin", "/bin"]
    toolsets = [
        Toolset("packaged", os.path.join(work, "packaged"), source, rest, [os.path.join(packaged, t) for t in TOOLS]),
        Toolset("ours", os.path.join(work, "ours"), source, [links] + rest, [os.path.join(links, t) for t in TOOLS]),
    ]
    parts = options.every or PARTS
    wanted = [1] if options.every else range(1, PARTS + 1)
    results = {toolset.name: {} for toolset in toolsets}
    for part in wanted:
        for toolset in toolsets:
            results[toolset.name].update(toolset.run(part, parts, options.jobs, options.again))
        if len(wanted) > 1:
            found = len(compare(results["packaged"], results["ours"]))
            print(f"part {part} of {parts}: {len(results['ours'])} tests, {found} differences so far",
                  file=sys.stderr, flush=True)
    differences = report(results)
    path = options.json or os.path.join(work, "result.json")
    with open(path + ".part", "w", encoding="utf-8") as file:
        json.dump({"tools": {t.name: t.stamp.splitlines() for t in toolsets}, "every": options.every or 1,
                   "differences": differences, "codes": results}, file, indent=1)
    os.replace(path + ".part", path)
    return 1 if differences else 0


if __name__ == "__main__":
    sys.exit(main())
