"""From 1 to 1,024 rasterizers, with the scaled machine's memory and with more."""

import machines
import runs as r
from runs import Run
from writing import chart, mega, paragraph, table

TITLE = "Scaling"
SCALED = machines.SCALED[machines.PROTOTYPES[0]]
SIMULATED = (1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024)
# How many rasterizers are simulated, by number of z-tiles: with 16 a few. GROWN of them also with memory that grows.
PARTS = {1: SIMULATED, 16: (1, 16, 128, 1024)}
GROWN = (128, 1024)
CHANNELS = 16  # twice those of the scaled machine
MOST_CHANNELS = 64  # of a machine
# The paper's scaled machine has 51.2 GB/s, 8 channels, for this many rasterizers.
RASTERIZERS_A_MEMORY = 16


def bus_cycles(result):
    """Cycles of the blend stage in which the DRAM's buses carry data, as if all channels did at once; and all its cycles."""
    stage = next(s for s in result["time"]["stages"] if s["name"] == "blend")["time"]
    return stage["dram"]["bus_ps"] / result["channels"] * result["time"]["sum"]["clock_mhz"] / 1e6, stage["cycles"]


def reached(result):
    """The share of the DRAM's bandwidth that the blend stage of a run got."""
    busy, cycles = bus_cycles(result)
    return busy / cycles


def machine_of(count):
    return SCALED if count == RASTERIZERS_A_MEMORY else f"{count}-rasterizers"


def grown(count):
    """That machine with as much memory for a rasterizer as the scaled machine has, or all that the simulator has."""
    channels = machines.channels(SCALED) * count // RASTERIZERS_A_MEMORY
    return machines.changed(f"{count}-rasterizers", timing__dram__channels=min(channels, MOST_CHANNELS))


def run(scene, parts, machine):
    return Run(scene, scene.views[0], machine, r.parted(parts))


def more_memory(scene):
    return [run(scene, 1, machine) for machine in (SCALED, f"{SCALED}-{CHANNELS}-channels")]


def points_of(store, scene, parts, machine_by_count):
    """What each machine's frame took, by its number of rasterizers."""
    results = store.all([run(scene, parts, machine) for machine in machine_by_count.values()])
    return {n: {"blend_cycles": r.kernel_cycles(result, "rasterize"), "merge_cycles": r.kernel_cycles(result, "merge"),
                "fps": result["time"]["fps"], "cores": result["device"]["compute_units"],
                "bandwidth_reached": reached(result), "command": result["command"]}
            for n, result in zip(machine_by_count, results)}


def by_count(counts):
    """The machines with the scaled machine's memory, and those whose memory grows."""
    return {n: machine_of(n) for n in counts}, {n: grown(n) for n in counts if n in GROWN}


def rows_of(store, scene):
    """A row for each number of parts."""
    view = scene.views[0]
    rows = []
    for parts, counts in PARTS.items():
        try:
            simulated, more = (points_of(store, scene, parts, machine_by_count) for machine_by_count in by_count(counts))
        except r.Missing as missing:
            store.left_out.append(str(missing))
            continue
        rows.append({"scene": scene.name, "view": view, "machine": SCALED, "parts": parts, "tiles": r.tiles(scene, view),
                     "simulated": simulated, "grown": more})
    return rows


def memory_row(store, scene):
    one, two = store.all(more_memory(scene))
    microseconds = r.frame_cycles(one) / one["time"]["sum"]["clock_mhz"]
    return {"scene": scene.name, "view": scene.views[0], "machine": SCALED,
            "blend_gain": r.stage_cycles(one, "blend") / r.stage_cycles(two, "blend"),
            "frame_gain": r.frame_ms(one) / r.frame_ms(two),
            "bus_share": one["time"]["sum"]["dram"]["bus_ps"] / one["channels"] / (microseconds * 1e6),
            "command": two["command"]}


def measure(store, all_scenes, _every_view):
    # What decides a claim comes first, for runs that are broken off.
    store.prepare([*(one for scene in all_scenes for one in more_memory(scene)),
                   *(run(scene, k, machine) for scene in all_scenes for k, counts in PARTS.items() for of in by_count(counts) for machine in of.values())])
    places = [(store, scene) for scene in all_scenes]
    return {"rows": [row for rows in store.rows(places, rows_of) for row in rows],
            "memory": store.rows(places, memory_row)}


def at(row, count, memory="simulated"):
    """The simulated point, or None. JSON has words for keys."""
    return row[memory].get(count) or row[memory].get(str(count))


def gains(row, counts, memory="simulated"):
    """Speed-ups over one rasterizer, with a gap where nothing was simulated."""
    first = at(row, 1)["blend_cycles"]
    return [f"{first / at(row, n, memory)['blend_cycles']:.1f}x" if at(row, n, memory) else "" for n in counts]


def text(data):
    out = [paragraph(f"""Blending's speed-up over one rasterizer at 500 MHz. All machines are as `{SCALED}`, with clusters of four
        sockets and four cores for each rasterizer. They have its memory (51.2 GB/s) or, where that grows, as much for each
        rasterizer as the scaled machine has, but at most {MOST_CHANNELS} channels (409.6 GB/s). Merging z-tiles is a kernel of its own and not in these rows."""), ""]
    for parts in sorted({row["parts"] for row in data["rows"]}):
        rows = [row for row in data["rows"] if row["parts"] == parts]
        out += [f"## K = {parts}: {rows[0]['tiles']} tiles, {rows[0]['tiles'] * parts} jobs", ""]
        lines = []
        for row in rows:
            lines.append((row["scene"], row["view"], "51.2 GB/s", mega(at(row, 1)["blend_cycles"]), *gains(row, SIMULATED[1:])))
            lines.append(("", "", "memory grows", "", *gains(row, SIMULATED[1:], "grown")))
        out += table(("scene", "view", "memory", "1: Mcycles", *map(str, SIMULATED[1:])), lines)
        shares = [100 * at(row, SIMULATED[-1])["bandwidth_reached"] for row in rows if at(row, SIMULATED[-1])]
        out += [f"With {SIMULATED[-1]} rasterizers {min(shares):.0f} to {max(shares):.0f} % of the 51.2 GB/s are used.", ""]
    out += ["## Whole frames, K = 1", "", "Frames a second.", ""]
    out += table(("scene", "view", *map(str, SIMULATED)),
                 [(row["scene"], row["view"], *(f"{at(row, n)['fps']:.1f}" for n in SIMULATED))
                  for row in data["rows"] if row["parts"] == 1])
    out += ["## Twice the memory channels", "",
            f"The scaled machine with {CHANNELS} channels (102.4 GB/s) against its own 8, and how long the 8 channels' buses "
            "are in use in a frame.", ""]
    out += table(("scene", "view", "blending", "whole frame", "buses in use"),
                 [(m["scene"], m["view"], f"{m['blend_gain']:.3f}x", f"{m['frame_gain']:.3f}x", f"{100 * m['bus_share']:.0f} %")
                  for m in data["memory"]])
    return out


def charts(data):
    rows = [row for row in data["rows"] if row["parts"] == 1]
    return {"scaling": chart("Blending by rasterizers", "rasterizers", "speed-up over one", list(map(str, SIMULATED)),
                             {row["scene"]: [at(row, 1)["blend_cycles"] / at(row, n)["blend_cycles"] for n in SIMULATED]
                              for row in rows})}
