"""The machines that are measured, by name; all parameters come from isasim/configs and are changed by name only."""

import json
import os

import scenes

FOLDER = os.path.join("isasim", "configs")
# Clusters and sockets a cluster, by rasterizers; scaled.json's clusters of four sockets where they are enough.
SHAPES = {1: (1, 1), 2: (1, 2), 4: (1, 4), 8: (2, 4), 16: (4, 4), 32: (8, 4), 64: (16, 4), 128: (32, 4)}
# The simulator has room for 240 cores, so beyond this many rasterizers get fewer than four each.
MOST_CORES = 128


def _of_rasterizers(text):
    """<count>-rasterizers: scaled.json with that many, each with its four cores while there is room; memory as it is."""
    count = int(text)
    config = config_of("scaled")
    config["clusters"], config["sockets_per_cluster"] = SHAPES[count]
    config["cores_per_socket"] = min(config["cores_per_socket"], MOST_CORES // count)
    return config


def _with_channels(text):
    """scaled-<count>-channels: scaled.json with that many DRAM channels."""
    config = config_of("scaled")
    config["timing"]["dram"]["channels"] = int(text)
    return config


def config_of(name):
    with open(os.path.join(scenes.ROOT, FOLDER, name + ".json"), encoding="utf-8") as f:
        return json.load(f)


SMALL = {
    "one-core": {"clusters": 1, "sockets_per_cluster": 1, "cores_per_socket": 1},
    "twelve-cores": {"clusters": 2, "sockets_per_cluster": 2, "cores_per_socket": 3},
}


def config(name):
    """The configuration, as VORION_CONFIG takes it."""
    if name.endswith("-rasterizers"):
        return _of_rasterizers(name.removesuffix("-rasterizers"))
    if name.endswith("-channels"):
        return _with_channels(name.removesuffix("-channels").removeprefix("scaled-"))
    return dict(SMALL[name]) if name in SMALL else config_of(name)


def shown(name):
    """How to name it on a command line."""
    if os.path.exists(os.path.join(scenes.ROOT, FOLDER, name + ".json")):
        return os.path.join(FOLDER, name + ".json")
    return "'" + json.dumps(config(name), separators=(",", ":")) + "'"

