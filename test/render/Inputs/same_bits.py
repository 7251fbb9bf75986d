"""The same bits of a picture on every named machine and preset of a core, with and without the clock, with the clock's
switches turned over, and for 1, 2 and 4 host threads, which change no cycle either.

usage: same_bits.py SCENE CAMERAS OPTION...   (of splat render; draws view `front`)
"""

import itertools
import json
import os
import subprocess
import sys
import tempfile

THREADS = (1, 2, 4)


def printed(option):
    return json.loads(subprocess.run(["vorion-sim", option], check=True, capture_output=True, text=True).stdout)


def draw(config, clock, threads):
    """The picture's bytes, and the cycles of each of the frame's stages."""
    with tempfile.TemporaryDirectory() as folder:
        picture, report = os.path.join(folder, "out.pfm"), os.path.join(folder, "out.json")
        subprocess.run(["splat", "render", SCENE, "--cameras", CAMERAS, "--view", "front", "-o", picture, "--json", report,
                        *(["--time"] if clock else []), *OPTIONS], check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "VORION_CONFIG": json.dumps({**config, "host_threads": threads})})
        with open(report, encoding="utf-8") as f:
            stages = json.load(f).get("time", {"stages": []})["stages"]
        with open(picture, "rb") as f:
            return f.read(), [stage["time"]["cycles"] for stage in stages if "time" in stage]


SCENE, CAMERAS, *OPTIONS = sys.argv[1:]
schema = printed("--print-config-schema")["properties"]
default = printed("--print-default-config")["timing"]
# Of a parameter whose values are 0 and 1 each is a choice.
switches = {group: {name: 1 - default[group][name] for name, values in members["properties"].items()
                    if (values.get("minimum"), values.get("maximum")) == (0, 1)}
            for group, members in schema["timing"]["properties"].items() if "properties" in members}
configs = [{"machine": name} for name in schema["machine"]["enum"]]
configs += [{"timing": {"core": {"preset": name}}, "warps_per_core": 4}
            for name in schema["timing"]["properties"]["core"]["properties"]["preset"]["enum"]]
configs += [{"timing": switches}, {"timing": {"host": {"dma_engines": 2}, "core": {"dcache_kib": 16}}}]

first, differing = None, 0
for config, clock in itertools.product(configs, (False, True)):
    cycles = None
    # What no clock reads needs no further threads.
    for threads in THREADS if clock or "machine" in config else THREADS[-1:]:
        picture, its = draw(config, clock, threads)
        first, cycles = first or picture, cycles or its
        if picture != first or its != cycles or bool(its) != clock:
            print(f"{json.dumps(config)}, {threads} threads, clock {clock}: other {'bits' if picture != first else 'cycles'}")
            differing += 1
sys.exit(differing != 0)
