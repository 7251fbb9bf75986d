#!/usr/bin/env python3
"""What a guest's actions cost the host at their largest legal size: a table of Markdown.

usage: guest_limits.py [--machines NAME,...] [--watchdog SECONDS] [--only NAME,...] [--option OPTION]...
       guest_limits.py --rows FILE

Compiles a small program for each action, and runs it with and without the clock on each machine, each time with a
watchdog. A row has the host's seconds and its memory at most, and how the run ended. The memory must be that which the
guest touches of the machine's, and not more than docs/guest-limits.md states beside it.
--option adds an option of vorion-sim, as --option=--check=all. --rows only says whether a file has a row for each action.
Needs scripts/env.sh.

exit codes: 0 all within what is stated, 1 an action costs more or ended otherwise than by itself, a trap, a hang or the
watchdog, 2 usage
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time

import command_line
from generators import records

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))

MIB = 1 << 20
# Stated in docs/guest-limits.md: without the clock, and what is beside the budget's bytes with it.
PLAIN_MIB = 96
CODE_MIB = 3.9 * 32 + 64

RASTER = """
#include <vorion_raster.h>
#define LIST 0x20000000u
#define CORE (vx_core_id() * 0x40000u)
/* A valid bank: 2^24 entries of record 0, whose tile has size x size pixels. */
static void bank(__global float *record, uint mode, uint size) {
  vr_mode_set(mode); vr_options_set(0); vr_cutoff_set(0); vr_ztile_set(0); vr_backward_set(0);
  vr_gaussians_set((uint)record); vr_list_set(LIST); vr_count_set(VR_MAX_COUNT);
  vr_tile_origin_set(0); vr_tile_shape_set(size | (mode & 1 ? size / 2 : size) << 16);
  vr_output_set(0x10000000u + CORE); vr_output_pitch_set(1024);
  vr_last_set(0x14000000u + CORE); vr_upstream_set(0x18000000u + CORE); vr_tail_record_set(0x1c000000u + CORE);
  vr_tail_count_set(0); vr_tail_share_set(0);
}
/* A record that misses every tile, or reaches every pixel and closes none. */
static void put(__global float *g, int reaches) {
  for (uint n = 0; n < 12; ++n) g[n] = 0;
  g[0] = reaches ? 0 : -1e6f; g[5] = 1.0f / 250; g[9] = g[10] = reaches ? INFINITY : 1;
  if (reaches) g[5] = 1.0f / 128;
}
#define KERNEL __kernel __attribute__((reqd_work_group_size(16, 1, 1))) void run(__global float *g)
"""


def raster(mode, reaches, body, size=64):
    return RASTER + f"KERNEL {{ put(g, {reaches}); bank(g, {mode}, {size}); {body} }}\n"


STARTS = "for (uint n = 0; n < 16; ++n) vr_start_set(1); vr_wait();"
LASTS = """__global uint *last = (__global uint *)(0x14000000u + CORE);
  for (uint n = get_local_id(0); n < 2048; n += 16) last[n] = VR_MAX_COUNT;"""
TAKES = LASTS + "for (uint n = 0; n < 4; ++n) { vr_start_set(1); while (vr_grad_next() != 0); } vr_wait();"
C_PROGRAM = """
#include <vorion.h>
volatile unsigned long long tohost __attribute__((aligned(64))), fromhost __attribute__((aligned(64)));
static volatile unsigned long long call[4] __attribute__((aligned(64)));
int main(void) {
  if (vx_core_id() + vx_thread_id() != 0) return 0;
  for (;;) {
    %s
    while (tohost != 0);
    while (fromhost == 0 && %d);
    fromhost = 0;
  }
}
"""
WRITE = C_PROGRAM % ("""call[0] = 64; call[1] = 1; call[2] = 0x10000; call[3] = ~0ull; fromhost = 0;
    tohost = (unsigned)&call[0];""", 1)
PLAIN = "#define KERNEL __kernel __attribute__((reqd_work_group_size(16, 1, 1))) void run(__global float *g)\n"


def csrs():
    """A program that writes all ones to every CSR that a program may write, starts a command behind each, and reads every CSR."""
    body = []
    for csr in records.Records().of("Csr"):
        if not csr.HasIntrinsic or csr.Name in ("mscratch", "vr_wait", "vr_grad_next", "vx_local_offset"):
            continue
        if csr.Rule.Name != "none":
            body.append(f"bank(g, 0, 8); vr_count_set(1); {csr.Name}_set(~0u); vr_start_set(1); vr_wait();")
        body.append(f"sum += {csr.Name}();")
    return RASTER + "KERNEL { uint sum = 0; put(g, 1); " + "\n".join(body) + " g[16 + get_global_id(0)] = sum; }\n"


# Name: what a guest does, its language and its text.
ACTIONS = {
    "csrs": ("each CSR with all ones, a command behind each; each is read", "cl", csrs),
    "refused": ("commands of 2^32 - 1 entries", "cl", lambda: raster(0, 1, "vr_count_set(~0u); for (;;) { vr_start_set(1); vr_wait(); }")),
    "missed": ("commands of 2^24 entries that miss the tile", "cl", lambda: raster(0, 0, STARTS)),
    "reached": ("commands of 2^24 entries that reach 4096 pixels", "cl", lambda: raster(0, 1, STARTS)),
    "kept": ("the same with last contributors", "cl", lambda: raster("1 << VR_MODE_KEEP_LAST_SHIFT", 1, STARTS)),
    "drained": ("tiles that are drained, without end", "cl", lambda: raster(
        "1 << VR_MODE_DRAIN_SHIFT", 1, "vr_count_set(1); for (;;) { vr_start_set(1); vr_wait(); }")),
    "pushed": ("commands of as many pushed Gaussians as there can be", "cl", lambda: raster(
        "1 << VR_MODE_PUSHED_SHIFT", 1, "vr_g_extent_x_set(0x7f800000); vr_g_extent_y_set(0x7f800000);"
        "for (;;) { for (uint n = 0; n < VR_MAX_PUSHED / 16; ++n) vr_push_set(1); vr_start_set(1); }")),
    "tails": ("hand-overs of 2^24 entries, without a wait", "cl", lambda: raster(
        0, 1, "vr_tail_count_set(~0u); for (;;) vr_start_set(1);", 8)),
    "backward": ("backward commands of 2^24 entries that miss the tile", "cl", lambda: raster(1, 0, TAKES)),
    "backward-reached": ("backward commands of 2^24 entries that reach 2048 pixels", "cl", lambda: raster(1, 1, TAKES)),
    "not-taken": ("such a command whose batches nobody takes", "cl", lambda: raster(1, 1, LASTS + "vr_start_set(1); vr_wait();")),
    "printf": ("printf of a width and a precision of 2^31 - 1", "cl", lambda: PLAIN +
               'KERNEL { printf("%2147483647d\\n", 1); printf("%.2147483647f\\n", 1.0f); }\n'),
    "console": ("all lanes print, without a line's end", "c", lambda:
                "int main(void) { for (;;) *(volatile unsigned char *)0x40 = 'x'; }\n"),
    "write": ("a write call of 2^64 - 1 bytes", "c", lambda: WRITE),
    "calls": ("other calls of the host, without end", "c", lambda: C_PROGRAM % (
        "static unsigned n; call[0] = ++n == 64 || n == 93 ? 1 : n; fromhost = 0; tohost = (unsigned)&call[0];", 1)),
    "barrier": ("barriers of 2^31 - 1 warps", "cl", lambda: PLAIN.replace("#define", "#include <vorion.h>\n#define") +
                "KERNEL { vx_bar(0x80000000u, 0x7fffffffu); }\n"),
    "loads": ("loads of 16 lines each, without end", "cl", lambda: PLAIN +
              "KERNEL { volatile __global float *v = g; for (uint n = 0;; n += 7) v[(get_local_id(0) * 4096 + n * 64) % 0x400000]; }\n"),
    "one-core": ("one core runs, the others wait at a barrier of all", "cl", lambda: PLAIN.replace("#define", "#include <vorion.h>\n#define") +
                 "KERNEL { volatile __global float *v = g; if (get_group_id(0) == 0) for (uint n = 0;; ++n) v[get_local_id(0) * 4096];"
                 " vx_bar(0x80000000u, vx_num_cores()); }\n"),
    "code": ("a loop of 3.9 million instructions", "c", lambda:
             'int main(void) { __asm__ volatile("1: .rept 3900000\\n addi t0, t0, 1\\n .endr\\n la t1, 1b\\n jr t1" ::: "t0", "t1"); return 0; }\n'),
    "atomics": ("atomics of 16 lanes, without end", "cl", lambda: PLAIN +
                "KERNEL { for (;;) atomic_inc((volatile __global int *)g); }\n"),
}


def budget_mib():
    """What HostBudget.h gives the clock."""
    with open(os.path.join(ROOT, "isasim", "core", "HostBudget.h"), encoding="utf-8") as file:
        text = file.read()
    fetches = int(re.search(r"FetchBytes = (\d+) << 20", text)[1])
    traces = 1024 * int(re.search(r"TraceBytes = size_t\{(\d+)\} << 30", text)[1])
    return fetches + traces


def built(folder, name):
    """The program of an action."""
    _, language, text = ACTIONS[name]
    source = os.path.join(folder, f"{name}.{language}")
    with open(source, "w", encoding="utf-8") as file:
        file.write(text())
    program = os.path.join(folder, name + ".elf")
    subprocess.run(["vorion-clang", "-O1", source, "-o", program], check=True)
    return program


def touched_mib(name):
    """What the guest itself writes, or reads of a page that is not there yet, of the machine's memory."""
    return {"write": 2048, "code": 16 + CODE_MIB}.get(name, 64)


def measure(program, is_kernel, machine, watchdog, more):
    """Seconds, MiB at most, bytes of output, and how it ended."""
    command = ["vorion-sim", program, "--config", machine, "--watchdog", str(watchdog)]
    if is_kernel:
        command += ["--kernel", "run", "--global", "4096", "--local", "16", "--arg", "buf:65536"]
    command += more
    began = time.monotonic()
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as run:
        written, tail = 0, b""
        while piece := run.stdout.read1(MIB):
            written += len(piece)
            tail = (tail + piece)[-4096:]
        _, status, usage = os.wait4(run.pid, 0)
        run.returncode = os.waitstatus_to_exitcode(status)
    said = tail.decode(errors="replace")
    ends = {"watchdog:": "watchdog", "hang": "hang", "trap": "trap", "fault": "trap"}
    end = "itself" if run.returncode == 0 else next((e for w, e in ends.items() if w in said), f"exit code {run.returncode}")
    return time.monotonic() - began, usage.ru_maxrss / 1024, written, end


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--machines", default="prototype,scaled")
    parser.add_argument("--watchdog", type=float, default=5)
    parser.add_argument("--only", default=",".join(ACTIONS))
    parser.add_argument("--option", action="append", default=[])
    parser.add_argument("--rows", metavar="FILE")
    options = parser.parse_args()
    if options.rows:
        with open(options.rows, encoding="utf-8") as file:
            rows = file.read()
        missing = [name for name, (what, _, _) in ACTIONS.items() if f"| {what} |" not in rows]
        print("".join(f"{options.rows}: no row for {name}\n" for name in missing), end="", file=sys.stderr)
        return 1 if missing else 0
    names = options.only.split(",")
    for name in names:
        if name not in ACTIONS:
            parser.error(f"{name}: no such action, expected some of {', '.join(ACTIONS)}")
    machines = options.machines.split(",")
    heads = [f"{machine}{clock}: {figure}" for machine in machines for clock in ("", ", `--time`") for figure in ("s", "MiB", "ended by")]
    print(f"| action | {' | '.join(heads)} |\n|---|{'--:|--:|---|' * (2 * len(machines))}")
    wrong = []
    with tempfile.TemporaryDirectory(prefix="vorion-guest-") as folder:
        for name in names:
            what, language, _ = ACTIONS[name]
            program = built(folder, name)
            row = []
            for machine in machines:
                for clock in (False, True):
                    seconds, mib, _, end = measure(program, language == "cl", machine, options.watchdog,
                                                     [*options.option, *["--time"] * clock])
                    row += [f"{seconds:.1f}", f"{mib:.0f}", end]
                    most = PLAIN_MIB + touched_mib(name) + (budget_mib() if clock else 0)
                    if mib > most:
                        wrong.append(f"{name} on {machine}{' with --time' if clock else ''}: {mib:.0f} MiB, expected at most {most}")
                    if end.startswith("exit code"):
                        wrong.append(f"{name} on {machine}: ended by {end}")
            print(f"| {what} | {' | '.join(row)} |", flush=True)
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    command_line.run(main)
