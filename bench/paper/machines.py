"""The machines that are measured: those of isasim/configs by name, and what differs from one of them."""

import functools
import json
import os
import subprocess

import scenes

# A prototype for each of the two cores that the text allows, and the scaled machine of the same core.
PROTOTYPES = ("prototype", "prototype-forwarding")
SCALED = {"prototype": "scaled", "prototype-forwarding": "scaled-forwarding"}
NAMED = (*PROTOTYPES, *SCALED.values())

FOLDER = os.path.join("isasim", "configs")
# Clusters and sockets a cluster, by rasterizers; the scaled machine's clusters of four sockets where they are enough.
SHAPES = {1: (1, 1), 2: (1, 2), 4: (1, 4), **{count: (count // 4, 4) for count in (8, 16, 32, 64, 128, 256, 512, 1024)}}
# Stacks of 64 KiB a lane would take more than there is above the image (docs/abi.md), so those of large machines are smaller.
MOST_CORES_OF_LARGE_STACKS = 1024
SMALL_STACKS = 16 << 10
SMALL = {
    "one-core": {"clusters": 1, "sockets_per_cluster": 1, "cores_per_socket": 1},
    "twelve-cores": {"clusters": 2, "sockets_per_cluster": 2, "cores_per_socket": 3},
}


def parameters(name):
    """All that the configuration of a machine of isasim/configs says."""
    with open(os.path.join(scenes.ROOT, FOLDER, name + ".json"), encoding="utf-8") as f:
        return json.load(f)


def _of_rasterizers(count):
    """`scaled` with so many rasterizers, each with its four cores; memory as it is."""
    clusters, sockets = SHAPES[count]
    cores = parameters("scaled")["cores_per_socket"]
    stacks = {"stack_bytes": SMALL_STACKS} if count * cores > MOST_CORES_OF_LARGE_STACKS else {}
    return {"machine": "scaled", "clusters": clusters, "sockets_per_cluster": sockets, "cores_per_socket": cores, **stacks}


def changed(name, **settings):
    """The name of a machine with other values; __ stands for the dots of a setting."""
    return "+".join([name, *(f"{key.replace('__', '.')}={value}" for key, value in sorted(settings.items()))])


def _with(base, settings):
    """A configuration in which settings, key=value, have other values."""
    for setting in settings:
        key, value = setting.split("=")
        *groups, last = key.split(".")
        place = base
        for group in groups:
            place = place.setdefault(group, {})
        place[last] = int(value)
    return base


def config(name):
    """The configuration, as VORION_CONFIG takes it: of a named machine, of <count>-rasterizers, of
    scaled-<count>-channels, of one of SMALL, or of one of these that is changed()."""
    name, *settings = name.split("+")
    if settings:
        return _with(config(name), settings)
    if name.endswith("-rasterizers"):
        return _of_rasterizers(int(name.removesuffix("-rasterizers")))
    if name.endswith("-channels"):
        count = int(name.removesuffix("-channels").removeprefix("scaled-"))
        return {"machine": "scaled", "timing": {"dram": {"channels": count}}}
    return dict(SMALL[name]) if name in SMALL else {"machine": name}


def channels(name):
    """How many channels its DRAM has, or None for one of SMALL, which no section asks."""
    differs = config(name)
    if "machine" not in differs:
        return None
    return {**parameters(differs["machine"])["timing"]["dram"], **differs.get("timing", {}).get("dram", {})}["channels"]


@functools.cache
def fetch_interval(name):
    """Cycles between two instructions of a warp on a machine of isasim/configs, from the simulator's table of presets: with
    one warp a core cannot issue more often."""
    lines = subprocess.run(["vorion-sim", "--print-timing-parameters"], check=True, capture_output=True,
                           text=True).stdout.splitlines()
    heads, values = ([cell.strip(" `") for cell in next(line for line in lines if line.startswith(start)).split("|")]
                     for start in ("| parameter", "| `fetch_interval`"))
    return int(values[heads.index(parameters(name)["timing"]["core"]["preset"])])


def shown(name):
    """How to name it on a command line."""
    return name if name in NAMED else "'" + json.dumps(config(name), separators=(",", ":")) + "'"
