"""A view of the command line and a machine, and two pictures by one process: what the programs share that draw with the clock."""

import json
import os
import subprocess
import sys

import scenes


def add_view(parser):
    parser.add_argument("scene")
    parser.add_argument("--cameras", required=True)
    parser.add_argument("--view", required=True)


def machine(config):
    """All values of a machine, by its name or its file; the default one if that is None."""
    given = ["--config", config] if config else []
    return json.loads(subprocess.run(["vorion-sim", *given, "--print-default-config"], check=True,
                                     capture_output=True, text=True).stdout)


def scene_of(args):
    """The scene of add_view()'s arguments."""
    return scenes.with_views(args.scene, args.cameras, (args.view,))


def cameras_of(file):
    """The records of a cameras.json."""
    with open(file, encoding="utf-8") as f:
        return json.load(f)


def pair(scene, cameras, folder, *options, **variables):
    """What `splat render --json` says of each of two pictures that it draws one after the other; ends the program if it fails."""
    file, path = os.path.join(folder, "pair.json"), os.path.join(folder, "report.json")
    with open(file, "w", encoding="utf-8") as f:
        json.dump([dict(camera, id=number, img_name=str(number)) for number, camera in enumerate(cameras)], f)
    done = subprocess.run(["splat", "render", scene, "--cameras", file, "--view", "all", "-o", os.path.join(folder, "picture.pfm"), "--json", path,
                           *options], env=dict(os.environ, **variables), capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit("error: " + done.stderr.strip().splitlines()[-1])
    with open(path, encoding="utf-8") as f:
        return json.load(f)["pictures"]
