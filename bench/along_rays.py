#!/usr/bin/env python3
"""How near footprints come to densities along rays: the two tables of docs/cameras.md.

usage: bench/along_rays.py SCENES [--only WORD]

SCENES has guitar.compressed.ply, truck.splat, garden_outdoor.sog.d, room7k_sh3.ply and cameras/. The demo scene is made.
Draws 240x136 pixels in fp64 by `splat-reference`, and gives the PSNR beside `splat-reference --along-rays`.
--only measures the rows whose names have WORD in them.
"""

import argparse
import json
import os
import subprocess
import tempfile

import camera_sheet
import command_line
from cameras import FISHEYE, ROLLING

WIDTH, HEIGHT = 240, 136
FILES = {"guitar": "guitar.compressed.ply", "truck": "truck.splat", "garden_outdoor": "garden_outdoor.sog.d",
         "room7k_sh3": "room7k_sh3.ply"}
TURNING = camera_sheet.ROLLING
POINTS = ["--projection", "unscented"]


def plain(view):
    return view


def longer(view):
    return {**view, "fx": 8 * view["fx"], "fy": 8 * view["fy"]}


def distorted(view):
    return {**view, **camera_sheet.BARREL, "fx": 0.6 * view["fx"], "fy": 0.6 * view["fy"]}


def wide(view):
    return {**view, **FISHEYE, "fx": 0.4 * view["fx"], "fy": 0.4 * view["fy"]}


def sphere(view):
    return {**view, "camera_model": "EQUIRECTANGULAR"}


LENSES = {plain: "", longer: ", eight times the focal length", distorted: ", OpenCV's distortion",
          wide: ", wide fisheye", sphere: ", sphere"}

VIEWS = [("guitar", "front", plain), ("truck", "overview", plain), ("truck", "path", plain),
         ("garden_outdoor", "overview", plain), ("garden_outdoor", "path", plain), ("room7k_sh3", "front", plain),
         ("room7k_sh3", "close", plain), ("room7k_sh3", "front", longer), ("room7k_sh3", "front", distorted),
         ("room7k_sh3", "front", wide), ("room7k_sh3", "close", wide), ("room7k_sh3", "front", sphere),
         ("room7k_sh3", "close", sphere), ("truck", "overview", wide), ("truck", "overview", sphere),
         ("garden_outdoor", "overview", wide), ("garden_outdoor", "path", sphere), ("guitar", "front", wide),
         ("demo scene", "front", wide)]

SHUTTERS = [("garden_outdoor", "path", plain, ROLLING), ("garden_outdoor", "overview", plain, ROLLING),
            ("truck", "path", plain, ROLLING), ("room7k_sh3", "front", plain, ROLLING),
            ("guitar", "front", plain, ROLLING), ("room7k_sh3", "front", wide, ROLLING),
            ("truck", "path", plain, TURNING), ("room7k_sh3", "front", plain, TURNING)]


class Judge:
    """Draws views of the scenes, each once."""

    def __init__(self, scenes, folder):
        self.scenes, self.folder, self.known = scenes, folder, {}

    def files(self, scene):
        if scene in FILES:
            return os.path.join(self.scenes, FILES[scene]), os.path.join(self.scenes, "cameras", scene + ".json")
        demo, cameras = os.path.join(self.folder, "demo.ply"), os.path.join(self.folder, "demo.json")
        if not os.path.exists(demo):
            subprocess.run(["splat", "demo-scene", "-o", demo, "--cameras", cameras], check=True, stdout=subprocess.DEVNULL)
        return demo, cameras

    def draw(self, scene, record, options, name):
        """Writes the picture NAME.npz, and gives the report."""
        cameras, said = os.path.join(self.folder, "c.json"), os.path.join(self.folder, "said.json")
        with open(cameras, "w", encoding="utf-8") as f:
            json.dump([record], f)
        subprocess.run(["splat-reference", self.files(scene)[0], "--cameras", cameras, "--view", record["img_name"], "-o",
                        os.path.join(self.folder, name + ".npz"), "--json", said, *options],
                       check=True, stdout=subprocess.DEVNULL)
        with open(said, encoding="utf-8") as f:
            return json.load(f)

    def psnr(self, record, scene, options, judge):
        """Of footprints with the options beside the picture of the judge, and what their drawing said."""
        said = self.draw(scene, record, options, "footprints")
        compared = os.path.join(self.folder, "compared.json")
        subprocess.run(["splat", "compare", os.path.join(self.folder, judge + ".npz"),
                        os.path.join(self.folder, "footprints.npz"), "--json", compared],
                       check=True, stdout=subprocess.DEVNULL)
        with open(compared, encoding="utf-8") as f:
            return json.load(f)["psnr_db"], said

    def record(self, scene, view, lens):
        with open(self.files(scene)[1], encoding="utf-8") as f:
            record = next(record for record in json.load(f) if record["img_name"] == view)
        scale = WIDTH / record["width"]
        record = {**record, "width": WIDTH, "height": HEIGHT, "fx": record["fx"] * scale, "fy": record["fy"] * scale}
        return lens({key: value for key, value in record.items() if key not in ("cx", "cy")})

    def still(self, scene, view, lens):
        """PSNR by the Jacobian, by points everywhere and by points, and the share of Gaussians by the Jacobian then."""
        if (scene, view, lens) not in self.known:
            record = self.record(scene, view, lens)
            self.draw(scene, record, ["--along-rays"], "rays")
            jacobian, _ = self.psnr(record, scene, [], "rays")
            everywhere, _ = self.psnr(record, scene, [*POINTS, "--point-spread", "1e9"], "rays")
            points, said = self.psnr(record, scene, POINTS, "rays")
            share = 100 - 100 * said["by_points"] / said["visible"]
            self.known[scene, view, lens] = jacobian, everywhere, points, share
        return self.known[scene, view, lens]

    def rolling(self, scene, view, lens, shutter):
        """PSNR by the Jacobian and by points, then compared with rays in the order of the pose."""
        record = {**self.record(scene, view, lens), **shutter}
        found = []
        for order in ("depth", "pose"):
            self.draw(scene, record, ["--along-rays", "--order", order], "rays")
            found += [self.psnr(record, scene, options, "rays")[0] for options in ([], POINTS)]
        return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes")
    parser.add_argument("--only", default="")
    args = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        judge = Judge(args.scenes, folder)
        print("| view | Jacobian | points everywhere | `--projection unscented` | Gaussians that use the Jacobian |\n"
              "|---|--:|--:|--:|--:|")
        for scene, view, lens in VIEWS:
            name = f"{scene}, {view}{LENSES[lens]}"
            if args.only in name:
                jacobian, everywhere, points, share = judge.still(scene, view, lens)
                print(f"| {name} | {jacobian:.1f} | {everywhere:.1f} | {points:.1f} | {share:.1f} % |", flush=True)
        print("\n| view | Jacobian | unscented | order of the pose: Jacobian | unscented | without a shutter: Jacobian | "
              "unscented |\n|---|--:|--:|--:|--:|--:|--:|")
        for scene, view, lens, shutter in SHUTTERS:
            name = f"{scene}, {view}{LENSES[lens]}" + (", rotating by 0.25 radians" if shutter is TURNING else "")
            if args.only in name:
                found = judge.rolling(scene, view, lens, shutter)
                jacobian, _, points, _ = judge.still(scene, view, lens)
                print(f"| {name} | " + " | ".join(f"{db:.1f}" for db in (*found, jacobian, points)) + " |", flush=True)


if __name__ == "__main__":
    command_line.run(main)
