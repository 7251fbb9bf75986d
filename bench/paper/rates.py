"""Frames a second by machine: one after the other, and overlapped as in a pipeline."""

import machines
import runs as r
from runs import Run
from writing import chart, mega, paragraph, table, terms

TITLE = "Frames a second"
SLOW = 100  # MHz, the paper's slowest clock


def raster(scene, view, machine, clock=0):
    return Run(scene, view, machine, ("--path", "raster"), clock)


def in_turn(scene, machine):
    """All views of a scene by one command that prepares one while another is blended."""
    return Run(scene, "all", machine, ("--path", "raster", "--overlap"))


def in_sequence(scene, machine, clock=0):
    """All views of a scene by one command, one after the other, with the caches as the one before left them."""
    return Run(scene, "all", machine, ("--path", "raster"), clock)


def _row(store, scene, view, prototype):
    scaled = machines.SCALED[prototype]
    whole, slow, large = store.all([raster(scene, view, prototype), raster(scene, view, prototype, SLOW),
                                    raster(scene, view, scaled)])
    rates = {}
    for pipeline, milliseconds in (("serial", r.frame_ms), ("overlapped", r.overlapped_ms)):
        rates[pipeline] = {"fps": 1e3 / milliseconds(whole), "slow_fps": 1e3 / milliseconds(slow),
                           "scaled_fps": 1e3 / milliseconds(large), "gain": milliseconds(whole) / milliseconds(large)}
    return {"scene": scene.name, "view": view, "machine": prototype, "scaled": scaled, "gaussians": r.gaussians(whole),
            "clock_mhz": whole["time"]["sum"]["clock_mhz"], "frame_cycles": r.frame_cycles(whole),
            "blend_cycles": r.stage_cycles(whole, "blend"), **rates, "command": whole["command"],
            "slow_command": slow["command"], "scaled_command": large["command"]}


def _turn(store, scene, machine):
    together, *alone = store.all([in_turn(scene, machine), *(raster(scene, v, machine) for v in scene.views)])
    blend = sum(r.stage_cycles(result, "blend") for result in alone)
    whole = sum(map(r.frame_cycles, alone))
    serial = sum(map(r.frame_ms, alone))
    kernels = sum(result["time"]["kernel_ms"] for result in alone)
    return {"scene": scene.name, "view": "all", "machine": machine, "pictures": len(alone), "serial_ms": serial,
            "measured_ms": together["time"]["total_ms"],
            "bound_ms": serial - kernels + kernels * max(blend, whole - blend) / whole, "command": together["command"]}


def _sequence(store, scene, machine, clock):
    together, *alone = store.all([in_sequence(scene, machine, clock), *(raster(scene, v, machine, clock) for v in scene.views)])
    later = together["time"]["latency_ms"][1:]
    return {"scene": scene.name, "view": "all", "machine": machine, "clock_mhz": together["time"]["sum"]["clock_mhz"],
            "pictures": len(alone), "alone_fps": 1e3 * len(alone) / sum(map(r.frame_ms, alone)),
            "fps": 1e3 * len(alone) / together["time"]["total_ms"], "later_fps": 1e3 * len(later) / sum(later) if later else None,
            "command": together["command"]}


def measure(store, all_scenes, _every_view):
    places = [(store, scene, view, m) for m in machines.PROTOTYPES for scene in all_scenes for view in scene.views]
    store.prepare([run for _, s, v, m in places
                   for run in (raster(s, v, m), raster(s, v, m, SLOW), raster(s, v, machines.SCALED[m]))])
    first = machines.PROTOTYPES[0]
    sequences = [(store, scene, m, clock) for scene in all_scenes
                 for m, clock in ((first, 0), (first, SLOW), (machines.SCALED[first], 0))]
    return {"rows": store.rows(places, _row), "sequences": store.rows(sequences, _sequence),
            "turns": store.rows([(store, scene, m) for m in machines.PROTOTYPES for scene in all_scenes], _turn)}


def text(data):
    out = [paragraph(f"""Frames by the raster path. The last two columns are of the scaled machine with the same core: its rate, and
        how many times the prototype's that is. Its cores and clock are {8 * 500 / 530:.2f} times the prototype's. Its memory is on
        the chip and four times as wide, which gives the rest."""), "",
           *terms([("*serial*", "one frame after the other"),
                   ("*overlapped*", """a frame in the time of the longest stage of a pipeline, the cores' kernels or the rasterizers'
                    blending, plus launches and copies. Nothing is charged for memory that the stages share, so this is a bound of what
                    a pipeline could reach""")])]
    for machine in machines.PROTOTYPES:
        rows = [row for row in data["rows"] if row["machine"] == machine]
        if not rows:
            continue
        out += [f"## `{machine}` and `{machines.SCALED[machine]}`", ""]
        clock = rows[0]["clock_mhz"]
        out += table(("scene", "view", "pipeline", "Mcycles", "of it blending", f"frames/s at {clock} MHz", f"at {SLOW} MHz",
                      "scaled, frames/s", "times"),
                     [(row["scene"], row["view"], pipeline, mega(row["frame_cycles"]), mega(row["blend_cycles"]),
                       f"{row[pipeline]['fps']:.1f}", f"{row[pipeline]['slow_fps']:.1f}",
                       f"{row[pipeline]['scaled_fps']:.1f}", f"{row[pipeline]['gain']:.2f}x")
                      for row in rows for pipeline in ("serial", "overlapped")])
    if data.get("sequences"):
        out += ["## Frames in sequence", "", paragraph("""All views of a scene by one command, one after the other: a rate, as the
            paper's figure is. The caches are as the frame before left them. The first frame also activates the scene; *later* are the
            others."""), ""]
        out += table(("scene", "machine", "MHz", "pictures", "each alone, frames/s", "in sequence", "later ones"),
                     [(row["scene"], f"`{row['machine']}`", row["clock_mhz"], row["pictures"], f"{row['alone_fps']:.2f}", f"{row['fps']:.2f}",
                       f"{row['later_fps']:.2f}" if row["later_fps"] else "") for row in data["sequences"]])
    if data["turns"]:
        out += ["## Overlapped in fact", "", paragraph("""All views of a scene by one command. `--view all
            --overlap` prepares one view while another is blended, with the queue of four commands that `timing.raster` has."""), ""]
        out += table(("scene", "machine", "pictures", "serial, ms", "overlapped, ms", "bound, ms"),
                     [(turn["scene"], f"`{turn['machine']}`", turn["pictures"], f"{turn['serial_ms']:.1f}",
                       f"{turn['measured_ms']:.1f}", f"{turn['bound_ms']:.1f}") for turn in data["turns"]])
    return out


def charts(data):
    rows = [row for row in data["rows"] if row["machine"] == machines.PROTOTYPES[0]]
    return {"rates": chart("Frames a second, prototype", "scene and view", "frames/s",
                           [f"{row['scene']} {row['view']}" for row in rows],
                           {p: [row[p]["fps"] for row in rows] for p in ("serial", "overlapped")}, bars=True)} if rows else {}
