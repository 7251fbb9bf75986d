"""A view drawn with the clock on a machine of one's own: what the programs that vary the clock's parameters share."""

import json
import os
import subprocess
import sys


def add_view(parser):
    parser.add_argument("scene")
    parser.add_argument("--cameras", required=True)
    parser.add_argument("--view", required=True)


def machine(config):
    """All values of a machine, by its name or its file; the default one if that is None."""
    given = ["--config", config] if config else []
    return json.loads(subprocess.run(["vorion-sim", *given, "--print-default-config"], check=True,
                                     capture_output=True, text=True).stdout)


def picture(folder):
    """The picture of the last frame that was rendered into the folder."""
    return os.path.join(folder, "picture.pfm")


def report(args, folder, *options, **variables):
    """What `splat render --json` says of the view under these variables, and None; or None and its error."""
    path = os.path.join(folder, "report.json")
    done = subprocess.run(
        ["splat", "render", args.scene, "--cameras", args.cameras, "--view", args.view, "-o", picture(folder), "--json", path, *options],
        env=dict(os.environ, **variables), capture_output=True, text=True)
    if done.returncode != 0:
        return None, done.stderr.strip().splitlines()[-1]
    with open(path, encoding="utf-8") as file:
        return json.load(file), None


def cameras_of(file):
    """The records of a cameras.json."""
    with open(file, encoding="utf-8") as f:
        return json.load(f)


def pair(scene, cameras, folder, *options, **variables):
    """What `splat render --json` says of each of two pictures that it draws one after the other; ends the program if it fails."""
    file, path = os.path.join(folder, "pair.json"), os.path.join(folder, "report.json")
    with open(file, "w", encoding="utf-8") as f:
        json.dump([dict(camera, id=number, img_name=str(number)) for number, camera in enumerate(cameras)], f)
    done = subprocess.run(["splat", "render", scene, "--cameras", file, "--view", "all", "-o", picture(folder), "--json", path,
                           *options], env=dict(os.environ, **variables), capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit("error: " + done.stderr.strip().splitlines()[-1])
    with open(path, encoding="utf-8") as f:
        return json.load(f)["pictures"]


def render(args, config, folder, *options):
    """The frame's time on that machine, as `splat render --json` has it, or {"error": text}."""
    found, error = report(args, folder, "--time", *options, VORION_CONFIG=json.dumps(config))
    return {"error": error} if error else found["time"]
