"""What nobody but us chose, and how far it may be otherwise: the one table of factors that uncertainty.py and the paper's
draws share. A factor is a choice of ours, or a value that no source states."""

import json
import subprocess
from dataclasses import dataclass

import hypercube


@dataclass(frozen=True)
class Factor:
    """A choice or a value by its place: a group of `timing` and a name there, or one of GROUPS. domain: of choices in a list each is
    as likely as another; between two ends the logarithm is even."""
    group: str
    name: str
    domain: object
    unit: str
    grounds: str

    @property
    def key(self):
        return self.group, self.name


# Groups that are no group of `timing`.
GROUPS = {"machine": "the machine", "method": "how it is measured", "part": "the clock's own error, % of ours"}

FACTORS = (
    Factor("machine", "core", ["vortex-5stage", "forwarding"], "", "the text allows both"),
    Factor("machine", "raster.queue_depth", [4, 8, 16, 32], "commands", "the text has no depth of an agent's queue"),
    Factor("link", "l2_mhz", (100, 200), "MHz", "a DDR3-1600 controller hands over 64 bytes at 200 MHz, a large design may reach half"),
    Factor("link", "to_l2_ns", (10, 100), "ns", "pads, connector and clock crossing, or serial transceivers"),
    Factor("link", "from_l2_ns", (10, 100), "ns", "as to_l2_ns"),
    Factor("link", "to_l2_mbps", (1600, 12800), "MB/s", "the text's 12.8 GB/s; 64 signals each way at 200 MHz give 1.6"),
    Factor("link", "from_l2_mbps", (1600, 12800), "MB/s", "as to_l2_mbps"),
    Factor("link", "header_bytes", (4, 16), "bytes", "an address alone, or with what a bus protocol adds"),
    Factor("l2", "kib", [128, 256, 512, 1024, 2048], "KiB", "128 in Vortex of May 2023, 1024 in 2025; the text gives none"),
    Factor("llc", "kib", [512, 1024, 2048], "KiB", "1024 in Vortex of May 2023, 2048 in 2025; the board's memory blocks hold 4.6 MB"),
    # Named machines have neither, and the RTL that is the reference has both.
    Factor("l2", "crossbar", [0, 1], "", "the RTL of Vortex has it, the text names none"),
    Factor("l2", "write_through", [0, 1], "", "as of Vortex in May 2023, or the option of 2025"),
    Factor("host", "launch_ns", [0, 2000, 20000], "ns", "a queue in the machine, a doorbell with reads, or a call of a driver"),
    Factor("host", "copy_ns", [0, 2000, 20000], "ns", "as launch_ns"),
    Factor("host", "copy_mbps", (1000, 4000), "MB/s", "PCI Express 2 x8, of which small copies reach a part"),
    Factor("dram", "address_map", ["digit_sum", "row_bank_column", "xor"], "", "the text has none"),
    Factor("dram", "refresh", ["rank", "none"], "", "the text has none"),
    Factor("dram", "channel_bytes", [64, 128, 256, 512, 1024], "bytes", "the text has none"),
    Factor("core", "interleaved_stacks", [0, 1], "", "GPUs interleave private memory; Vortex's runtime does not, and the text says nothing"),
    Factor("method", "support", ["exact", "box3", "square3"], "", "the text has no rule for the tiles that a Gaussian reaches"),
    Factor("method", "exp", ["exact", "table"], "", "the text has an exponential unit, and not its precision"),
    Factor("method", "baseline", ["fastest", "official"], "", "the text does not describe the kernels that it compares with"),
    Factor("method", "pipeline", ["serial", "overlapped"], "", "the text has a pipeline of three stages, and a rate"),
    Factor("part", "instructions", (93, 107), "%", "`project`, `sort` and `tiles` on 1, 2 and 4 cores with 1 and 2 warps are -6.1 to +7.3 % off the RTL; "
           "neither 8 cores nor the preset `forwarding` has a reference"),
    Factor("part", "memory", (64, 162), "%", "a core without a data cache, sockets on one L2, atomics and the last-level cache have no reference; loops of "
           "16-line accesses on 2 and 4 cores, with all of the RTL's parameters, are -38.1 to +56.2 % off. DRAM's mixes, "
           "within 1 % of Ramulator 2.1, are included"),
    Factor("part", "stores on the link", (17, 100), "%", "a store of a word is sent as a line, 72 bytes with its header; a link that sends only the word "
           "would send 12"),
    Factor("part", "rasterizer", (99, 101), "%", "tiles are -1.14 to +0.78 % off the circuit; several rasterizers and pixel units have no reference but the "
           "arithmetic of one"),
)
BY_KEY = {factor.key: factor for factor in FACTORS}
# Rank correlations; whatever is not here is independent.
CORRELATED = (
    (("link", "to_l2_ns"), ("link", "from_l2_ns"), 0.9, "the same pads and clocks both ways"),
    (("link", "to_l2_mbps"), ("link", "from_l2_mbps"), 0.9, "as many signals each way"),
    *((("link", "l2_mhz"), ("link", rate), 0.5, "parallel signals run at the clock of the L2") for rate in ("to_l2_mbps", "from_l2_mbps")),
    *((("link", latency), ("link", rate), 0.3, "serial transceivers are faster, and take longer")
      for latency in ("to_l2_ns", "from_l2_ns") for rate in ("to_l2_mbps", "from_l2_mbps")),
    (("l2", "kib"), ("llc", "kib"), 0.5, "one technology and one area for both"),
    (("host", "launch_ns"), ("host", "copy_ns"), 0.9, "the same driver and bus"),
)
# Rank correlations that the sampler takes.
CORRELATIONS = tuple((a, b, value) for a, b, value, _ in CORRELATED)
# The rule for every other parameter of the clock whose source says "ours".
RULE = "each other value of [the clock](../tables/timing.md) whose source says *ours*: half to twice"
# Launches and copies are constants, or units with values of their own.
HOST_CONSTANTS = {"launch_ns", "copy_ns", "copy_mbps"}


def in_group(group):
    return [factor for factor in FACTORS if factor.group == group]


def ours():
    """(group, name) of every parameter whose source says "ours"."""
    group = None
    text = subprocess.run(["vorion-sim", "--print-timing-parameters"], check=True, capture_output=True, text=True).stdout
    for line in text.splitlines():
        if line.startswith("`timing."):
            group = line.split("`")[1].removeprefix("timing.")
        elif line.startswith("| `"):
            cells = [cell.strip() for cell in line.split("|")]
            if cells[-3] != "bool" and "ours" in cells[-2]:
                yield group, cells[1].strip("`")


def limits():
    """By group, the schema's description of each value."""
    text = subprocess.run(["vorion-sim", "--print-config-schema"], check=True, capture_output=True, text=True).stdout
    groups = json.loads(text)["properties"]["timing"]["properties"]
    return {group: description.get("properties", {}) for group, description in groups.items()}


def of_clock(timing):
    """By (group, name), the domains of the values of a machine's clock that are drawn."""
    named = {factor.key: factor.domain for factor in FACTORS if factor.group not in GROUPS}
    units = bool(timing["host"]["dma_engines"])
    found, schema = {}, limits()
    for group, name in ours():
        value = timing[group][name]
        # A clock, latency or rate of 0 is none, and so is a bound of 0.
        if (group, name) not in named and value and group != "link" and (group != "host" or (name in HOST_CONSTANTS) != units):
            allowed = schema[group][name]
            found[group, name] = (max(1, allowed["minimum"], value / 2), min(allowed["maximum"], value * 2))
    for (group, name), domain in named.items():
        if (group != "link" or timing["link"]["l2_mhz"]) and (group != "host" or not units):
            found[group, name] = domain
    return found


def domains(timing):
    """What uncertainty.py draws for a machine: its clock's values, and the factors of the parts of a frame's time."""
    return of_clock(timing) | {factor.key: factor.domain for factor in in_group("part")}


def samples(of, count, seed):
    """A Latin hypercube: by (group, name), a value of its domain for each sample."""
    drawn = hypercube.parts(list(of), count, seed, CORRELATIONS)
    return [{key: hypercube.value_at(of[key], part) for key, part in sample.items()} for sample in drawn]
