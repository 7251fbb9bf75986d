#!/usr/bin/env python3
"""Our DRAM controller beside Ramulator 2.1 with the same tables of times, queues and requests, as Markdown tables.

usage: dram_ramulator.py CHECKOUT [--patterns PROGRAM] [--standard NAME]... [--requests N] [--tables FOLDER]

CHECKOUT is a built checkout of Ramulator 2.1: src/, python/ and libramulator.so. FOLDER has tables of times, by default ours;
Ramulator gets their values. --patterns is bench/timing's dram_patterns. Ramulator drains its writes as our marks say, and our rows
keep their precedence, since its scheduler has no cap.

exit codes: 0 all within their limits, 1 not so, 2 usage, 3 CHECKOUT is none
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

sys.path.append(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
import command_line

HERE = os.path.dirname(os.path.abspath(__file__))
STANDARDS = os.path.join(HERE, "../../isasim/timing/dram/standards")
BANDWIDTH_LIMIT = 0.01
LATENCY_LIMIT = 0.02
QUEUE = 64
ABOVE, BELOW = 51, 12  # bursts: 80 and 20 % of the queue, rounded down
NO_CAP = 1 << 30


def ddr3(v):
    return {"nBL": v["nBL"], "nCL": v["nCL"], "nRCD": v["nRCD"], "nRP": v["nRP"], "nRAS": v["nRAS"], "nRC": v["nRC"],
            "nWR": v["nWR"], "nRTP": v["nRTP"], "nCWL": v["nCWL"], "nCCD": v["nBL"], "nRRD": v["nRRD"], "nWTR": v["nWTR"],
            "nFAW": v["nFAW"], "nRFC": v["nRFC"], "nREFI": v["nREFI"]}


def ddr4(v):
    return {"nBL": v["nBL"], "nCL": v["nCL"], "nRCD": v["nRCD"], "nRP": v["nRP"], "nRAS": v["nRAS"], "nRC": v["nRAS"] + v["nRP"],
            "nWR": v["nWR"], "nRTP": v["nRTP"], "nCWL": v["nCWL"], "nCCDS": v["nBL"], "nCCDL": v["nCCDL"],
            "nRRDS": v["nRRDS"], "nRRDL": v["nRRDL"], "nWTRS": v["nWTRS"], "nWTRL": v["nWTRL"], "nFAW": v["nFAW"],
            "nRFC": v["nRFC"], "nREFI": v["nREFI"]}


def lpddr5(v):
    return {"nBL_min": v["nBL"], "nBL_max": v["nBLmax"], "nCL": v["nRL"], "nRCD": v["nRCD"], "nRP": v["nRPpb"],
            "nRPab": v["nRPab"], "nRAS": v["nRAS"], "nRC": v["nRAS"] + v["nRPpb"], "nWR": v["nWR"],
            "nRTP": v["nBL"] + v["nRBTP"], "nCWL": v["nWL"], "nPPD": v["nPPD"], "nCCDS": v["nBL"], "nCCDL": v["nBLmax"],
            "nCCDS_WR": v["nBL"], "nCCDL_WR": v["nBLmax"], "nRRDS": v["nRRD"], "nRRDL": v["nRRD"], "nWTRS": v["nWTRS"],
            "nWTRL": v["nWTRL"], "nFAW": v["nFAW"], "nRFC": v["nRFCab"], "nREFI": v["nREFI"], "nAAD": v.get("nAAD", 8)}


def hbm2(v):
    return {"nBL": v["nBL"], "nCL": v["nCL"], "nRCDRD": v["nRCDRD"], "nRCDWR": v["nRCDWR"], "nRP": v["nRP"], "nRAS": v["nRAS"],
            "nRC": v["nRAS"] + v["nRP"], "nWR": v["nWR"], "nRTPL": v["nRTP"], "nCWL": v["nCWL"], "nCCDS": v["nBL"],
            "nCCDL": v["nCCDL"], "nRRDS": v["nRRDS"], "nRRDL": v["nRRDL"], "nWTRS": v["nWTRS"], "nWTRL": v["nWTRL"],
            "nFAW": v["nFAW"], "nRFC": v["nRFC"], "nREFI": v["nREFI"]}


# Limits of bandwidth and latency of a standard with two command buses, on which the order of commands within a tick differs.
WIDER = {"hbm2e": (0.03, 0.03)}
# Our table: Ramulator's standard, presets whose times are replaced, controller, and our times by its names.
COMPARED = {
    "ddr3-1600": ("DDR3", "DDR3_1Gb_x8", "DDR3_1600K", "GenericDDR", {}, ddr3),
    "ddr4-3200": ("DDR4", "DDR4_8Gb_x8", "DDR4_3200AA", "GenericDDR", {}, ddr4),
    "lpddr5-6400": ("LPDDR5", "LPDDR5_8Gb_x16", "LPDDR5_6400", "LPDDR5", {"wck_sync_mode": "always_on"}, lpddr5),
    "hbm2e": ("HBM2", "HBM2_8Gb", "HBM2_2000Mbps", "HBM12", {}, hbm2),
}


def configuration(ramulator, standard, table):
    name, organization, times, controller, options, our_times = COMPARED[standard]
    values = {key: value[0] for key, value in table["values"].items()}
    overrides = our_times(values) | {"tCK_ps": table["tick_ps"]}
    dram_class = getattr(ramulator.dram, name)
    # A command takes the bus as long as ours.
    dram_class.command_cycles = {}
    if name == "HBM2":
        overrides["pseudochannel"] = 1
    dram = dram_class(org_preset=organization, timing_preset=times, **overrides)
    control = getattr(ramulator.controller, controller)(
        dram=dram, scheduler=ramulator.scheduler.FRFCFS(), refresh_manager=ramulator.refresh_manager.AllBank(),
        row_policy=ramulator.row_policy.Open(), addr_mapper=ramulator.addr_mapper.PassThroughAddrMapper(),
        read_buffer_size=QUEUE, write_buffer_size=QUEUE, wr_high_watermark=ABOVE / QUEUE, wr_low_watermark=BELOW / QUEUE, **options)
    memory = ramulator.memory_system.GenericDRAM(
        clock_ratio=1, controllers=[control], channel_mapper=ramulator.channel_mapper.PassThroughChannelMapper())
    return {"frontend": ramulator.frontend.External(clock_ratio=1).to_config(), "memory_system": memory.to_config()}


def run(program, *options, **more):
    done = subprocess.run([program, *options], check=True, stdout=subprocess.PIPE, text=True, **more)
    return done.stdout


def compare(standard, theirs, ours):
    """Prints the table of a standard; returns what is too far off."""
    print(f"\n`{standard}`:\n\n| pattern | GB/s, ours | Ramulator 2.1 | difference | latency, ns | Ramulator 2.1 | difference |")
    print("|---|--:|--:|--:|--:|--:|--:|")
    wrong = []
    for name, their in theirs.items():
        mine = ours["closed"].get(name) or ours["open_per_cent"][name]
        tick_ns = mine["ns"] / mine["ticks"]
        name = f"random reads at {name} %" if name.isdigit() else f"`{name}`"
        bandwidth, latency = WIDER.get(standard, (BANDWIDTH_LIMIT, LATENCY_LIMIT))
        figures = [(mine["gb_s"], mine["gb_s"] * mine["ticks"] / their["ticks"], 3, bandwidth)]
        if mine["mean_read_ns"]:
            figures.append((mine["mean_read_ns"], their["mean_read_ticks"] * tick_ns, 2, latency))
        cells = []
        for our, reference, digits, limit in figures:
            error = our / reference - 1
            cells += [f"{our:.{digits}f}", f"{reference:.{digits}f}", f"{100 * error:+.2f} %"]
            if abs(error) > limit:
                wrong.append(f"{standard}: {name}: {our:.{digits}f}, expected {reference:.{digits}f} within {100 * limit:g} %")
        print(f"| {name} | " + " | ".join(cells + [""] * (6 - len(cells))) + " |")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("checkout", metavar="CHECKOUT")
    parser.add_argument("--patterns", default="dram_patterns")
    parser.add_argument("--standard", action="append", choices=COMPARED)
    parser.add_argument("--requests", type=int, default=20000)
    parser.add_argument("--tables", default=STANDARDS, help="folder of the tables that both get")
    args = parser.parse_args()
    for part in ("src/ramulator/base/factory.h", "python/ramulator/__init__.py", "libramulator.so"):
        if not os.path.exists(os.path.join(args.checkout, part)):
            print(f"dram_ramulator.py: error: {args.checkout}: no {part}, expected a built checkout of Ramulator 2.1", file=sys.stderr)
            return 3
    sys.dont_write_bytecode = True
    sys.path.insert(0, os.path.join(args.checkout, "python"))
    import ramulator
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        driver = os.path.join(folder, "driver")
        run("clang++-19", "-std=c++20", "-O2", f"-I{args.checkout}/src", os.path.join(HERE, "dram_ramulator.cpp"), "-o", driver,
            f"-L{args.checkout}", "-lramulator", f"-Wl,-rpath,{os.path.abspath(args.checkout)}")
        for standard in args.standard or COMPARED:
            path = os.path.join(args.tables, standard + ".json")
            with open(path, encoding="utf-8") as file:
                table = json.load(file)
            lists = os.path.join(folder, standard)
            os.mkdir(lists)
            config = os.path.join(folder, "configuration.json")
            with open(config, "w", encoding="utf-8") as file:
                json.dump(configuration(ramulator, standard, table), file)
            options = ("--standard", path, "--requests", str(args.requests), "--cap", str(NO_CAP))
            run(args.patterns, *options, "--list", lists)
            ours = json.loads(run(args.patterns, *options))
            values = {key: value[0] for key, value in table["values"].items()}
            written = sum(values[key] for key in table["write_latency"].split(" + ")) + values[table["burst"]]
            names = [*ours["closed"], *ours["open_per_cent"]]
            theirs = json.loads(run(driver, config, str(written), *(os.path.join(lists, name) for name in names)))
            wrong += compare(standard, theirs, ours)
    for line in wrong:
        print(f"dram_ramulator.py: error: {line}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    command_line.run(main)
