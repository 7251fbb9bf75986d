"""For claims that do not hold: the smallest change that was found to make each hold, or why none can."""

import os

import energy
import joint
import machines
import runs as r
import scaling
import scenes
from runs import Run
from verdicts import HOLDS
from writing import paragraph, table

TITLE = "What would make claims hold"
SCALED = scaling.SCALED
# Of 16 rasterizers over one: what is taken for near-linear.
NEAR_LINEAR = 0.8 * scaling.RASTERIZERS_A_MEMORY
WIDTHS = (0, 1920, 3840)  # 0: the scene's own
CLOCKS = (530, 400, 300, 230)
AHEAD = {"timing__raster__buffer_entries": 64}
SKIP = {"timing__raster__skip_blocks": 3}
# What a table calls it, and what is changed.
FOR_SCALING = (("the paper's machine", {}), ("64 places for Gaussians, 16 channels", {**AHEAD, "timing__dram__channels": 16}))
FOR_MEMORY = (("the paper's machine", {}), ("64 places for Gaussians", AHEAD), ("a last-level cache of 16 MiB", {"timing__llc__kib": 16384}))
FOR_GAIN = (("the paper's machine", {}), ("16 channels", {"timing__dram__channels": 16}),
            ("a last-level cache of 16 MiB", {"timing__llc__kib": 16384}))
FOR_POWER = (("the paper's machine", {}), ("blocks skipped", SKIP))
FOR_AREA = (("the paper's machine", {}), ("8 lanes a rasterizer", {"timing__raster__lanes": 8, "timing__raster__banks": 8}),
            ("2 cores a rasterizer", {"cores_per_socket": 2}),
            ("2 cores a rasterizer, of 8 lanes", {"cores_per_socket": 2, "timing__raster__lanes": 8, "timing__raster__banks": 8}),
            ("1 rasterizer with its 4 cores", {"sockets_per_cluster": 1}))


def of_scaling(store, all_scenes):
    """For each size and change: blending on 16 rasterizers over one."""
    folder = os.path.join(store.folder, "cameras")
    wanted = {}
    for width in WIDTHS:
        for scene in all_scenes:
            sized = scenes.at_width(scene, width, folder) if width else scene
            for label, change in FOR_SCALING:
                wanted[width, scene.name, label] = [Run(sized, sized.views[0], machines.changed(scaling.machine_of(n), **change),
                                                        r.parted(1)) for n in (1, scaling.RASTERIZERS_A_MEMORY)]
    store.prepare([run for pair in wanted.values() for run in pair])

    def row(width, scene, label):
        one, many = store.all(wanted[width, scene, label])
        return {"scene": scene, "size": "x".join(map(str, many["resolution"])), "change": label,
                "gain": r.kernel_cycles(one, "rasterize") / r.kernel_cycles(many, "rasterize"), "command": many["command"]}

    return store.rows(wanted, row)


def of_memory(store, all_scenes):
    """For each change: the frames that twice the channels give more."""
    wanted = {(scene.name, label): [Run(scene, scene.views[0], machines.changed(SCALED, **change, **more), r.parted(1))
                                    for more in ({}, {"timing__dram__channels": scaling.CHANNELS})]
              for scene in all_scenes for label, change in FOR_MEMORY}
    store.prepare([run for pair in wanted.values() for run in pair])

    def row(scene, label):
        one, two = store.all(wanted[scene, label])
        return {"scene": scene, "change": label, "gain": r.frame_ms(one) / r.frame_ms(two), "command": two["command"]}

    return store.rows(wanted, row)


def of_gain(store, all_scenes):
    """For each core and change: frames of the scaled machine over those of the prototype."""
    wanted = {(scene.name, core, label): [Run(scene, scene.views[0], core, r.parted(1)),
                                          Run(scene, scene.views[0], machines.changed(machines.SCALED[core], **change) if change else
                                              machines.SCALED[core], r.parted(1))]
              for scene in all_scenes for core in machines.PROTOTYPES for label, change in FOR_GAIN}
    store.prepare([run for pair in wanted.values() for run in pair])

    def row(scene, core, label):
        one, many = store.all(wanted[scene, core, label])
        return {"scene": scene, "machine": f"`{machines.SCALED[core]}`", "change": label, "gain": r.frame_ms(one) / r.frame_ms(many),
                "command": many["command"]}

    return store.rows(wanted, row)


def of_power(store, all_scenes):
    """For each prototype, change and clock: the power of the stage with the most."""
    wanted = {(machine, label, clock): [Run(scene, scene.views[0], machines.changed(machine, **change) if change else machine,
                                            ("--exp", "table", "--energy"), 0 if clock == CLOCKS[0] else clock)
                                        for scene in all_scenes]
              for machine in machines.PROTOTYPES for label, change in FOR_POWER for clock in CLOCKS}
    store.prepare([run for some in wanted.values() for run in some])

    def row(machine, label, clock):
        results = store.all(wanted[machine, label, clock])
        peaks = [max((stage["chip_watts"] for stage in result["energy"]["stages"]), key=lambda w: w["value"]) for result in results]
        worst = max(peaks, key=lambda w: w["value"])
        return {"machine": machine, "change": label, "clock": clock, "volts": results[0]["energy"]["volts"], "watts": worst,
                "fps": [result["time"]["fps"] for result in results]}

    return store.rows(wanted, row)


def of_area(store, all_scenes):
    scene = all_scenes[0]
    wanted = {label: Run(scene, scene.views[0], machines.changed(machines.PROTOTYPES[0], **change) if change else
                         machines.PROTOTYPES[0], ("--exp", "table", "--energy")) for label, change in FOR_AREA}
    store.prepare(wanted.values())

    def row(label):
        result, = store.all([wanted[label]])
        return {"change": label, "um2": result["energy"]["area"]["chip_um2"], "fps": result["time"]["fps"],
                "scene": scene.name, "view": scene.views[0]}

    return store.rows([(label,) for label in wanted], row)


def measure(store, all_scenes, _every_view):
    return {"rows": of_scaling(store, all_scenes), "gain": of_gain(store, all_scenes),
            "memory": of_memory(store, all_scenes), "power": of_power(store, all_scenes),
            "area": of_area(store, all_scenes)}


def _bold(verdict):
    return f"**{verdict}**" if verdict == HOLDS else verdict


def _marked(value, good, shown):
    return f"**{shown}**" if good(value) else shown


def _cross(rows, columns, shown):
    """A row for each scene and what else it is of, a column for each change."""
    heads = list(dict.fromkeys(row["change"] for row in rows))
    places = list(dict.fromkeys(tuple(row[key] for key in columns) for row in rows))
    found = {(tuple(row[key] for key in columns), row["change"]): shown(row) for row in rows}
    return table((*columns, *heads), [(*place, *(found.get((place, head), "") for head in heads)) for place in places])


def text(data):
    out = [paragraph("""The other pages have claims that do not hold on our machines and views. This page has the changes that were tried
        for each, the smallest first. Where a figure is bold, the claim holds."""), "",
           "## Blending scales near-linearly to 16 rasterizers", "",
           paragraph(f"""Taken as {NEAR_LINEAR:g} times one rasterizer. `{SCALED}`, the cycles of the kernel that blends."""), ""]
    out += _cross(data["rows"], ("scene", "size"), lambda row: _marked(row["gain"], lambda g: g >= NEAR_LINEAR, f"{row['gain']:.1f}x"))
    out += [paragraph("""**A larger picture** is the smallest change. A tile is the smallest job, and the longest list decides when all are
        done. Where one tile holds much of the scene, as in guitar front, even 16 times as many pixels do not suffice. Splitting such
        tiles [gained nothing](../ideas-methods.md#splitting-heavy-tiles)."""), ""]
    out += [f"## The scaled machine is {joint.SCALED_GAIN:g} times as fast as the prototype", "",
            paragraph("""Frames a second, one after the other, of the first view of each scene. Its parts are eight times as many, and its clock
                is 500 MHz for 530: that gives 7.55. More comes from memory alone."""), ""]
    out += _cross(data["gain"], ("machine", "scene"), lambda row: _marked(row["gain"], lambda g: g >= joint.SCALED_GAIN, f"{row['gain']:.2f}x"))
    out += ["## The scaled machine is not limited by memory bandwidth", "",
            paragraph(f"""Taken as: {scaling.CHANNELS} channels instead of 8 give under 5 % more frames."""), ""]
    out += _cross(data["memory"], ("scene",), lambda row: _marked(row["gain"], lambda g: g < 1.05, f"{100 * (row['gain'] - 1):.1f} %"))
    out += ["## Under 600 mW in the stage with the most power", "",
            paragraph("""The most of the first views of all scenes, W, with 5 and 95 % of the estimate. The voltage falls with the clock
                ([law](../energy.md#voltage-and-clock)). *Frames/s*: of the slowest and the fastest view."""), ""]
    out += table(("machine", "change", "MHz", "V", "W", "verdict", "frames/s"),
                 [(f"`{row['machine']}`", row["change"], row["clock"], f"{row['volts']:.3f}", energy.estimate(row["watts"]),
                   _bold(energy.against(row["watts"], energy.PAPER_WATTS)), f"{min(row['fps']):.1f} to {max(row['fps']):.1f}")
                  for row in data["power"]])
    out += [paragraph("""**A slower clock** at the voltage that it needs is the smallest change: the dynamic power falls with its third power
        or so. On `prototype` the frames fall by less than the clock, because the link and the DRAM keep theirs."""), ""]
    out += ["## Cores and rasterizers take 1.6 mm2", "",
            paragraph(f"""The machine `{machines.PROTOTYPES[0]}` with less of what it has, mm2 with 5 and 95 % of the estimate, and the frames a second of
                {data["area"][0]["scene"] + " " + data["area"][0]["view"] if data["area"] else "a view"}."""), ""]
    out += table(("change", "mm2", "verdict", "frames/s"),
                 [(row["change"], energy.estimate(row["um2"], 1e-6), _bold(energy.area_verdict(row["um2"])), f"{row['fps']:.1f}")
                  for row in data["area"]])
    out += [paragraph("""No change of one kind suffices. Half of the machine would fit by its middle estimate, nearly."""), ""]
    return out + NONE_CAN


NONE_CAN = ["## Claims that nothing here would make hold", "", *table(("claim", "why"), [
    ("the pixel unit gives 82.4 % more from the last quarter, indoors", paragraph("""that would need 45.2 % of the rasterizers' cycles in the
        last quarter of the lists. They hold [a small part of that](tails.md), which bounds even a pixel unit that costs nothing. A
        rasterizer stops a tile when all its pixels are closed, so most tiles never come to their last quarter""")),
    ("the last quarter held 45.2 % of the time", paragraph("""as above. Were lists blended to their end, a quarter of the Gaussians would take
        about a quarter of the time""")),
    ("z-tiling gives 16 rasterizers more throughput", paragraph("""a part does not know that pixels are closed in front of it, so
        [it blends more](depth.md), and merging reads a picture of 16 bytes a pixel for each part. A part that waits for those in front of
        it would blend no more than needed, but then the parts of a tile follow each other, and nothing is parallel""")),
    ("three adders and three multipliers a pair of lanes add 7 %", paragraph("""by the areas of published units they are
        [12 % of a lane](../energy.md#area), and 8 % if the lane is counted with its bank of the pixel buffer
        ([gates](../rtl.md#gates)). The paper's whole area leaves a lane less than its multipliers need""")),
])]


def charts(_data):
    return {}
