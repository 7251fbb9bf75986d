#!/usr/bin/env python3
"""Prints what `splat accuracy` measured as Markdown: a row a setting, over all views.

usage: accuracy_table.py FOLDER/accuracy.json [--products N] [--min-db DB]

PSNR and SSIM are the worst view's, the largest error and the share of pixels off likewise; times are sums over the views, against the
default's. After the default and the single choices come the N combinations that are fastest at equal area and keep DB on every view.
"""

import argparse
import json

import clocked
import command_line


def share(value, base):
    return "" if value is None or base is None else f"{100 * (value / base - 1):+.1f} %"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--products", type=int, default=0, help="how many combinations (default: %(default)s)")
    parser.add_argument("--min-db", type=float, default=50, help="the least PSNR of a combination, dB (default: %(default)s)")
    args = parser.parse_args()
    with open(args.file, encoding="utf-8") as f:
        points = json.load(f)["points"]
    settings = {}
    for point in points:
        settings.setdefault(point["setting"], []).append(point)

    def worst(name, pick, none=None):
        values = [none if p["errors"][name] is None else p["errors"][name] for p in settings[setting]]
        return pick(values)

    def total(setting, axis):
        values = [p["times"][axis] for p in settings[setting]]
        return None if None in values else sum(values)

    has_energy = all(p["times"].get("chip_joules") for p in points)
    energy = ("energy of the chip | ", "--:|") if has_energy else ("", "")
    print(f"| setting | PSNR, dB | SSIM | largest error | pixels off, % | cycles | at equal area | kernels only | {energy[0]}lane area |")
    print(f"|---|--:|--:|--:|--:|--:|--:|--:|{energy[1]}--:|")
    kept = [s for s in settings if "," in s and all(p["errors"]["psnr_db"] is None or p["errors"]["psnr_db"] >= args.min_db for p in settings[s])]
    fastest = sorted(kept, key=lambda s: total(s, "equal_area_cycles"))[:args.products]
    for setting in [s for s in settings if "," not in s] + fastest:
        times = {axis: (f"{total(setting, axis):,.0f}" if total(setting, axis) and setting == "default"
                        else share(total(setting, axis), total("default", axis)))
                 for axis in ("cycles", "equal_area_cycles", "cores_cycles")}
        if has_energy:
            joules = total(setting, "chip_joules")
            energy = f"{1e3 * joules:.3g} mJ | " if setting == "default" else f"{share(joules, total('default', 'chip_joules'))} | "
        else:
            energy = ""
        decibels = worst("psnr_db", min, none=float("inf"))
        first = settings[setting][0]
        # Points of older versions have a cost without saying so.
        area = f"{100 * first['lane_area_relative']:.1f} %" if first.get("has_cost", True) else "not modelled"
        print(f"| {setting} | {decibels:.1f} | {worst('ssim', min):.6f} | {worst('largest', max):.2g} "
              f"| {100 * worst('off_share', max):.3f} | {times['cycles']} | {times['equal_area_cycles']} | {times['cores_cycles']} "
              f"| {energy}{area} |")
    clocked.say(point["clocked_machine"] for point in points)


if __name__ == "__main__":
    command_line.run(main)
