#!/usr/bin/env python3
"""Compares cameras, times, energies and scores with those that splat has left in this folder."""

import json

import numpy as np
import vorion

scene = vorion.Scene.read("s.ply")
orbit = vorion.cameras(scene, "c.json", orbit=3, size="40x30", up="y")
vorion.write_cameras("mine.json", orbit)
assert open("mine.json").read() == open("written.json").read()
assert [c.model for c in orbit] == ["PINHOLE"] * 3 and (orbit[0].width, orbit[0].height) == (40, 30)
assert all(np.array_equal(a.world_to_camera, b.world_to_camera) for a, b in zip(orbit, vorion.read_cameras("mine.json")))
print("cameras of the orbit as splat's, written and read again")

machine = vorion.Machine()
report = json.load(open("v.json"))
picture = machine.render(scene, orbit[0], energy=True)
single = vorion.command("render", "s.ply", cameras="mine.json", view=orbit[0].name, output="one.pfm", energy=True)
assert picture.cycles == single["time"]["sum"]["cycles"], (picture.cycles, single["time"]["sum"]["cycles"])
assert picture.joules == single["energy"]["joules"]["value"] > 0
print("pictures, cycles and joules as splat's")
print("effects:", *(effect["name"] for effect in picture.effects if effect["on"]))

coarse = machine.render(scene, orbit[0], exp="table")
scores = vorion.compare(picture.image, coarse.image)
vorion.command("render", "s.ply", cameras="mine.json", view=orbit[0].name, output="coarse.pfm", exp="table")
said = vorion.command("compare", "one.pfm", "coarse.pfm")
assert abs(scores["psnr_db"] - said["psnr_db"]) < 0.01 and np.isclose(scores["max_abs"], said["max_abs"]), (scores, said)
assert 0.5 < scores["ssim"] < 1 and np.isclose(scores["ssim"], said["ssim_outside_doubtful"], atol=1e-6), (scores, said)
half = np.arange(30)[:, None] + np.zeros(40) < 15
assert vorion.compare(picture.image, picture.image * ~half[..., None], mask=half) == {"psnr_db": np.inf, "max_abs": 0, "ssim": 1}
print(f"psnr_db {scores['psnr_db']:.2f} and ssim as splat compare")


def attempt(call, *arguments, **options):
    try:
        call(*arguments, **options)
    except vorion.Error as e:
        print(f"{type(e).__name__} {e.exit_code}: {e}")
    else:
        raise AssertionError(f"{call} {options}")


attempt(vorion.cameras, scene, "c.json", orbit=0)
attempt(vorion.cameras, scene, "c.json", view="back")
attempt(vorion.command, "info", "nowhere.ply")
