"""The same bits with and without the clock, for any number of host threads, on every machine."""

import machines
from runs import Run
from writing import paragraph, table

TITLE = "The same picture"
MACHINES = (*machines.NAMED, "one-core", "twelve-cores")
WORK = (("plain", ()), ("z-tiles 4", ("--ztiles", "4")), ("pixel unit last:1/4", ("--pixel-unit", "last:1/4")),
        ("both", ("--ztiles", "4", "--pixel-unit", "last:1/4")), ("kernels alone", ("--path", "simt")))
# Clock (None: off) and host threads.
WAYS = ((None, 1), (None, 3), (0, 1), (0, 2))


def measure(store, all_scenes, _every_view):
    # The smallest of the scenes is enough: every way is a run of its own.
    scene = min(all_scenes, key=lambda s: s.name != "guitar")
    view = scene.views[0]

    def run(machine, options, way):
        return Run(scene, view, machine, options, way[0], way[1])

    store.all([run(m, o, w) for m in MACHINES for _, o in WORK for w in WAYS])
    rows = []
    for work, options in WORK:
        pictures, times = set(), {}
        for machine in MACHINES:
            results = store.all([run(machine, options, w) for w in WAYS])
            pictures.update(result["output_fnv1a64"] for result in results)
            times[machine] = sorted({result["time"]["sum"]["cycles"] for result in results if "time" in result})
        rows.append({"work": work, "options": options, "runs": len(MACHINES) * len(WAYS), "pictures": len(pictures),
                     "cycles": times})
    return {"scene": scene.name, "view": view, "rows": rows}


def same(data):
    return all(row["pictures"] == 1 and all(len(c) == 1 for c in row["cycles"].values()) for row in data["rows"])


def text(data):
    out = [paragraph(f"""{data['scene']}, {data['view']}, on {', '.join(MACHINES)}; each without the clock on 1 and 3 host threads,
        and with it on 1 and 2. Kernels alone round otherwise than the rasterizer, and z-tiles merge, so each row may have a picture
        of its own, but only one."""), ""]
    out += table(("work", "runs", "different pictures", *(f"cycles on {m}" for m in MACHINES)),
                 [(row["work"], row["runs"], row["pictures"], *(" or ".join(map(str, row["cycles"][m])) for m in MACHINES))
                  for row in data["rows"]])
    return out


def charts(_data):
    return {}
