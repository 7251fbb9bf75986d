"""From 1 to 128 rasterizers by simulation, to 1,024 by a model that the simulation checks."""

import machines
import runs as r
import tails
from runs import Run
from writing import chart, mega, paragraph, table, terms

TITLE = "Scaling"
SCALED = machines.SCALED[machines.PROTOTYPES[0]]
SIMULATED = (1, 2, 4, 8, 16, 32, 64, 128)
MODELLED = (*SIMULATED, 256, 512, 1024)
# How many rasterizers are simulated, by number of z-tiles: with 16 the ends and the middle.
PARTS = {1: SIMULATED, 16: (1, 16, 128)}
CHANNELS = 16  # twice those of the scaled machine
# The paper's scaled machine has 51.2 GB/s for this many rasterizers.
RASTERIZERS_A_MEMORY = 16


def deal(costs, rasterizers):
    """The load of the busiest rasterizer when jobs, longest list first, are dealt forth and back, as kernels/rasterize.cl
    deals them: within a few percent of longest-processing-time-first where there are many jobs."""
    loads = [0.0] * rasterizers
    for job, cost in enumerate(costs):
        row, place = divmod(job, rasterizers)
        loads[place if row % 2 == 0 else rasterizers - 1 - place] += cost
    return max(loads)


def jobs_of(lengths, parts):
    """List lengths of the depth parts of tiles, in the machine's order."""
    return [n * (k + 1) // parts - n * k // parts for n in sorted(lengths, reverse=True) for k in range(parts)]


def model(lengths, parts, units, memory_cycles, on_tiles=tails.ON_TILES):
    """Cycles of blending by number of rasterizers: (as many, memory as it is), and (memory that grows with them).

    A job costs what clearing and writing a tile costs, and its list's length times what an entry costs on average; both
    come from one run on a single rasterizer, whose reports units are, so that only how jobs spread is modelled.
    memory_cycles: what the scaled machine's DRAM needs for blending's bytes. on_tiles: the reasons that are a tile's."""
    commands = sum(u["commands"] for u in units)
    fixed = tails.spent(units, on_tiles) / commands
    entry = (tails.spent(units, tails.BUSY) - fixed * commands) / max(1, sum(lengths))
    costs = [fixed + entry * n for n in jobs_of(lengths, parts)]
    rows = []
    for count in MODELLED:
        compute = deal(costs, count)
        grown = memory_cycles * RASTERIZERS_A_MEMORY / max(count, RASTERIZERS_A_MEMORY)
        rows.append({"rasterizers": count, "compute": compute, "memory": memory_cycles,
                     "cycles": max(compute, memory_cycles), "cycles_with_memory": max(compute, grown)})
    return rows


def bus_cycles(result):
    """Cycles of the blend stage in which the DRAM's buses carry data, as if all channels did at once; and all its cycles."""
    stage = next(s for s in result["time"]["stages"] if s["name"] == "blend")["time"]
    return stage["dram"]["bus_ps"] / result["channels"] * result["time"]["sum"]["clock_mhz"] / 1e6, stage["cycles"]


def reached(result):
    """The share of the DRAM's bandwidth that the blend stage of a run got."""
    busy, cycles = bus_cycles(result)
    return busy / cycles


def memory_cycles(whole, parts):
    """Cycles for which the DRAM's buses carry the bytes of blending: those of the run without parts, and a picture of
    16 bytes a pixel for each further part."""
    dram = next(s for s in whole["time"]["stages"] if s["name"] == "blend")["time"]["dram"]
    width, height = whole["resolution"]
    more = (parts - 1) * width * height * 16 / whole["time"]["sum"]["host"]["dram_burst_bytes"]
    return bus_cycles(whole)[0] * (1 + more / (dram["read_bursts"] + dram["write_bursts"]))


def machine_of(count):
    return SCALED if count == RASTERIZERS_A_MEMORY else f"{count}-rasterizers"


def run(scene, parts, machine):
    return Run(scene, scene.views[0], machine, r.parted(parts))


def more_memory(scene):
    return [run(scene, 1, machine) for machine in (SCALED, f"{SCALED}-{CHANNELS}-channels")]


def rows_of(store, scene):
    """A row for each number of parts."""
    view = scene.views[0]
    lengths = store.lengths(scene, view)
    whole, widest = store.all([run(scene, 1, machine_of(n)) for n in (RASTERIZERS_A_MEMORY, SIMULATED[-1])])
    rows = []
    for parts, counts in PARTS.items():
        try:
            results = dict(zip(counts, store.all([run(scene, parts, machine_of(n)) for n in counts])))
        except r.Missing as missing:
            store.left_out.append(str(missing))
            continue
        simulated = {n: {"blend_cycles": r.kernel_cycles(result, "rasterize"),
                         "merge_cycles": r.kernel_cycles(result, "merge"), "fps": result["time"]["fps"],
                         "cores": result["device"]["compute_units"], "command": result["command"]}
                     for n, result in results.items()}
        modelled = model(lengths, parts, results[1]["time"]["sum"]["rasterizers"], memory_cycles(whole, parts))
        rows.append({"scene": scene.name, "view": view, "machine": SCALED, "parts": parts, "tiles": len(lengths),
                     "bandwidth_reached": reached(widest), "simulated": simulated, "modelled": modelled})
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
    store.prepare([one for scene in all_scenes for one in
                   (*(run(scene, k, machine_of(n)) for k, counts in PARTS.items() for n in counts), *more_memory(scene))])
    places = [(store, scene) for scene in all_scenes]
    return {"rows": [row for rows in store.rows(places, rows_of) for row in rows],
            "memory": store.rows(places, memory_row)}


def at(row, count):
    """The simulated point, or None. JSON has words for keys."""
    return row["simulated"].get(count) or row["simulated"].get(str(count))


def gains(row, counts):
    """Speed-ups over one rasterizer, with a gap where nothing was simulated."""
    first = at(row, 1)["blend_cycles"]
    return [f"{first / at(row, n)['blend_cycles']:.1f}x" if at(row, n) else "" for n in counts]


def text(data):
    out = [paragraph(f"""Blending's speed-up over one rasterizer at 500 MHz. All machines are as `{SCALED}` with its memory (51.2 GB/s) and
        clusters of four sockets. A rasterizer has four cores, or fewer where there would be more than {machines.MOST_CORES}.
        Merging z-tiles is a kernel of its own and not in these rows."""), "",
           *terms([("*model*", """a tile costs its clearing and writing, plus the length of its list times the mean cost of an entry;
                    both are of the single rasterizer's run. Jobs are dealt as the machine's kernel does it, the longest list first"""),
                   ("its memory", "blending is not shorter than its bytes over the whole bandwidth, which no run reaches"),
                   ("*model, memory grows*", f"bandwidth grows with the rasterizers beyond {RASTERIZERS_A_MEMORY}")])]
    for parts in sorted({row["parts"] for row in data["rows"]}):
        rows = [row for row in data["rows"] if row["parts"] == parts]
        out += [f"## K = {parts}: {rows[0]['tiles']} tiles, {rows[0]['tiles'] * parts} jobs", ""]
        lines = []
        for row in rows:
            first, model_first = at(row, 1)["blend_cycles"], row["modelled"][0]["cycles"]
            lines.append((row["scene"], row["view"], "simulated", mega(first), *gains(row, MODELLED[1:])))
            for name, key in (("model", "cycles"), ("model, memory grows", "cycles_with_memory")):
                lines.append(("", "", name, mega(model_first),
                              *(f"{model_first / m[key]:.1f}x" for m in row["modelled"][1:])))
        out += table(("scene", "view", "", "1: Mcycles", *map(str, MODELLED[1:])), lines)
        off = [(m["cycles"] / at(row, m["rasterizers"])["blend_cycles"] - 1, row["scene"], m["rasterizers"])
               for row in rows for m in row["modelled"] if at(row, m["rasterizers"])]
        (low, *where_low), (high, *where_high) = min(off), max(off)
        low_share, high_share = (100 * f(row["bandwidth_reached"] for row in rows) for f in (min, max))
        out += [f"With {SIMULATED[-1]} rasterizers {low_share:.0f} to {high_share:.0f} % of the 51.2 GB/s are used. Model over simulation: {100 * low:+.1f} % ({where_low[0]}, {where_low[1]} rasterizers) to "
                f"{100 * high:+.1f} % ({where_high[0]}, {where_high[1]}).", ""]
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
