"""Loops whose lines miss the data cache: their assembly, for one core of 16 lanes or several that all run it.

Lines lie SPAN apart, so that all lie in one set of an L2 of 1 MiB and 8 ways, and in one of a data cache of 16 KiB and 4 ways.
Of up to 4 such lines both have all, of 5 to 8 only the L2 has, of more neither. Whoever reads them in turn always
misses in a cache that has not all, whether that replaces the oldest or the least recently used. So a few lines show what
whole caches do.
"""

SPAN = 128 << 10
STEPS = 32  # loads or stores of an iteration
ITERATIONS = (20, 60)
# Loads of one line in turn wait for each other; 16 lines of a wide access are neighbours.
FREE = ["a0", "a2", "a3", "a4", "a5", "a6", "a7", "t3"]


def program(setup, body, iterations):
    return "\n".join([
        "  .text", "  .globl main", "main:", *setup, f"  li s11, {iterations}", "  .balign 64", "1:", *body,
        "  addi s11, s11, -1", "  bnez s11, 1b", "  ret",
        "  .bss", "  .balign 4096", "  .globl begin_signature, end_signature", "begin_signature:",
        f"data: .space {17 * SPAN}", "  .set end_signature, begin_signature + 64", ""])


def chased(visits):
    """Each load gives the next one's address. Visits are lines; a line's second one of a round reads its second word."""
    words, seen = [], {}
    for line in visits:
        words.append((line, 4 * seen.setdefault(line, 0)))
        seen[line] += 1
    setup = []
    for (line, offset), (after, _) in zip(words, words[1:] + words[:1], strict=True):
        setup += [f"  la t0, data + {line * SPAN}", f"  la t1, data + {after * SPAN}", f"  sw t1, {offset}(t0)"]
    setup += ["  fence", f"  la a0, data + {visits[0] * SPAN}"]
    rounds = STEPS // len(visits)
    return setup, [f"  lw a0, {offset}(a0)" for _, offset in words] * rounds


def walked(instruction, bytes_of_lane, lines):
    """Loads or stores of each line, or each 16 lines, in turn, that wait for nothing."""
    setup = ["  csrr t0, vx_thread_id", f"  li t1, {bytes_of_lane}", "  mul t0, t0, t1", "  la s1, data", "  add s1, s1, t0",
             f"  li s2, {SPAN}", f"  li s3, {(lines - 1) * SPAN}"]
    body = []
    for n in range(STEPS):
        body += [f"  {instruction} {FREE[n % len(FREE)]}, 0(s1)",
                 "  sub s1, s1, s3" if n % lines == lines - 1 else "  add s1, s1, s2"]
    return setup, body


# A line that is read twice a round, with 8 others between: what replaces the least recently used keeps it, what replaces the
# oldest does not.
HOT = [0, 1, 2, 3, 4, 0, 5, 6, 7, 8]

LOOPS = {
    **{f"chase_{lines}": (f"chained loads of {lines} lines", chased(list(range(lines)))) for lines in (4, 8, 16)},
    "chase_hot": ("chained loads of 9 lines, one of them twice a round", chased(HOT)),
    **{f"load_{lines}": (f"loads of {lines} lines that wait for nothing", walked("lw", 4, lines)) for lines in (4, 8, 16)},
    **{f"wide_{lines}": (f"loads of 16 lines each, {lines} such in turn", walked("lw", 64, lines)) for lines in (4, 8, 16)},
    "store_8": ("stores of 8 whole lines in turn", walked("sw", 4, 8)),
    "wide_store_8": ("stores into 16 lines each, 8 such in turn", walked("sw", 64, 8)),
}


def text(name, iterations):
    return program(*LOOPS[name][1], iterations)


def accesses(name):
    """Loads or stores of an iteration."""
    return sum(line.split()[0] in ("lw", "sw") for line in LOOPS[name][1][1])
