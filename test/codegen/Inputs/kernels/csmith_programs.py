#!/usr/bin/env python3
"""csmith's programs on all lanes, compared lane by lane with the same C as a plain rv32 program.

Each lane has its own copy of the program's global variables, some of which start with other values in each lane. What
is compared is a lane's checksum of them in the end. Optimisation and extensions change from seed to seed.

exit codes: 0 no difference, 1 a program differs or is refused (the seed's files are kept), 2 usage
"""

import functools
import os
import shutil
import sys

import csmith_source
import seeds
from csmith_source import LANES
from machines import CONFIGURATIONS, Device, Endless, Linux, Refused, Wrong
from module import SHARED_START, SHARED_WORDS

# Lanes that part may need as many instructions as all their plain programs together, of which each has seconds of a processor.
MAX_WARP_INSTRUCTIONS = 4_000_000_000


def check(linux, seed, folder):
    configuration = CONFIGURATIONS[seed * 7 % len(CONFIGURATIONS)]
    base = os.path.join(folder, "program")
    source = base + ".c"
    with open(source, "w", encoding="utf-8") as file:
        file.write(csmith_source.source(seed, folder))
    try:
        expected = linux.run(source, base)
    except Endless:
        return {"seed": seed, "counts": {"endless as a plain program": 1}, "bad": []}
    try:
        device = Device()
        program = device.compile(source, base, configuration)
        start = bytes(4 * LANES) + SHARED_START.to_bytes(4, "little") * SHARED_WORDS
        got = device.run(program, base, 1, LANES, ["u32:0", f"u32:{LANES}", "local:256"], start, MAX_WARP_INSTRUCTIONS)
        # csmith takes addresses of unions' members, and an optimiser may take accesses by other types for others'
        # (-fstrict-aliasing).
        if got != expected and got == linux.as_written(source, base):
            return {"seed": seed, "counts": {"levels differ": 1}, "bad": []}
        bad = [] if got == expected else [f"{configuration}: wrong: lanes " + " ".join(
            str(lane) for lane in range(LANES) if got[4 * lane:4 * lane + 4] != expected[4 * lane:4 * lane + 4])]
    except (Refused, Wrong) as problem:
        # A loop of 2^32 rounds ends at once where the optimiser of one compiler knows its result, and only there.
        if "limit reached" in str(problem) and linux.as_written(source, base) is None:
            return {"seed": seed, "counts": {"endless as a plain program": 1}, "bad": []}
        bad = [f"{configuration}: {type(problem).__name__.lower()}: {problem}"]
    if bad:
        return {"seed": seed, "counts": {"bad": 1}, "bad": bad}
    results = {expected[4 * lane:4 * lane + 4] for lane in range(LANES)}
    return {"seed": seed, "counts": {"same": 1, "lanes differ": int(len(results) > 1)}, "bad": []}


def main():
    parser = seeds.options(__doc__, "csmith-programs", "programs")
    chosen = parser.parse_args()
    if not shutil.which("csmith"):
        parser.error("csmith: no such program, expected Debian's package of that name")
    os.makedirs(chosen.folder, exist_ok=True)
    todo = range(chosen.first, chosen.first + chosen.count)
    counts, bad_seeds, spent = seeds.check_all(chosen, todo, functools.partial(check, Linux(chosen.folder)))
    print(f"seeds {todo[0]} to {todo[-1]}: {counts['same']} programs same (in {counts['lanes differ']} of them lanes come to different results), "
          f"{counts['bad']} bad, {counts['endless as a plain program']} endless as a plain program, {counts['levels differ']} that "
          f"differ by level as a plain program; {spent}")
    return 1 if bad_seeds else 0


if __name__ == "__main__":
    sys.exit(main())
