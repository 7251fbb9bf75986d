"""A view of the command line and a machine, and two pictures by one process: what the programs share that draw with the clock."""

import dataclasses
import json
import os
import subprocess

import scenes
import study


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


def pair(of, cameras, folder, *options, **variables):
    """What `splat render --json` says of each of two pictures of a scene that it draws one after the other."""
    file = os.path.join(folder, "pair.json")
    with open(file, "w", encoding="utf-8") as f:
        json.dump([dict(camera, id=number, img_name=str(number)) for number, camera in enumerate(cameras)], f)
    both, = study.reports([study.render("pair", dataclasses.replace(of, cameras=file), "all", *options, **variables)])
    return both["pictures"]
