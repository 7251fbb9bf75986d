"""Random programs of one lane from the instruction records: what random_streams.py runs.

A program is a list of blocks. Within a block no register is written twice (but an address may be overwritten by what
is loaded from it), and each block ends in a call of `checkpoint` (streams/frame.s), which logs all registers: the
result of each instruction is seen, not only what is left at the end. Bits of a word outside the record's mask are
random; only the fields on which the program's safety depends (destinations, addresses, targets, rounding modes) are
then set.
"""

import random
import re
import struct

# What of the records QEMU 7.2 knows.
EXTENSIONS = ("i", "m", "zaamo", "f", "zicsr", "zifencei", "zba", "zbb", "zbs")

BLOCKS = 150
PASSES = 16  # runs of all blocks in one program, each with the operand table moved on
SCRATCH = 1024  # bytes of memory for stores and atomics; sp points to its middle
TABLE_STEP = 67  # words by which tp moves on in the operand table after a pass
TABLE_REACH = 1024  # words that a load reaches from tp, which points to their middle

RA, SP, TP = 1, 2, 4  # link register of checkpoint, scratch, operand table; gp (x3) is the log
RM_DYN = 7
VALID_RM = (0, 1, 2, 3, 4)

INTEGERS = (0, 1, 2, 3, 31, 32, 33, 0x7F, 0x80, 0xFF, 0x100, 0x7FFF, 0x8000, 0xFFFF, 0x10000, 0x7FFFFFFE, 0x7FFFFFFF,
            0x80000000, 0x80000001, 0xFFFF8000, 0xFFFFFF80, 0xFFFFFFFE, 0xFFFFFFFF, 0x55555555, 0xAAAAAAAA)
# Zeros, subnormals and their border, ones, borders of the conversions to integers, the largest, infinity, NaNs
# (canonical, quiet, signalling); each also with the other sign.
FLOATS = (0, 1, 2, 0x3FFFFF, 0x400000, 0x7FFFFF, 0x800000, 0x800001, 0xFFFFFF, 0x33800000, 0x34000000, 0x3EFFFFFF,
          0x3F000000, 0x3F000001, 0x3F7FFFFF, 0x3F800000, 0x3F800001, 0x3FC00000, 0x40000000, 0x40200000, 0x4B000000,
          0x4B7FFFFF, 0x4EFFFFFF, 0x4F000000, 0x4F000001, 0x4F7FFFFF, 0x4F800000, 0x7E800000, 0x7F000000, 0x7F7FFFFF,
          0x7F800000, 0x7FC00000, 0x7FC00001, 0x7FFFFFFF, 0x7F800001, 0x7FBFFFFF)


def kind(record):
    """How a record's fields are chosen; None for what leaves the program (ecall, ebreak)."""
    form = record.Fmt.id
    if form == "Plain":
        return "fence" if record.Mask != 0xFFFFFFFF else None
    if record.Mnemonic == "jalr":
        return "jalr"
    if form.startswith("ICsr"):
        return "csr"
    if "(rs1)" in record.Syntax:
        return {"I": "load", "S": "store", "R": "atomic"}[form]
    return {"B": "branch", "J": "jal"}.get(form, "compute")


def weight(record):
    if record.Mnemonic == "fence.i":
        return 0.2  # both sides throw decoded code away
    return 2 if record.Extension in ("f", "zicsr") else 1


def operand(rng):
    """A word that is interesting as an integer or as a float."""
    choice = rng.randrange(8)
    sign = rng.getrandbits(1) << 31
    if choice == 0:
        return rng.choice(INTEGERS)
    if choice <= 2:
        return sign | rng.choice(FLOATS)
    if choice == 3:
        return rng.getrandbits(32)
    if choice == 4:  # a whole number or a half: exact results and ties
        return struct.unpack("<I", struct.pack("<f", rng.randrange(-4096, 4096) / 2))[0]
    if choice == 5:  # near the ends of the exponent's range: overflow, underflow
        exponent = rng.choice((rng.randrange(30), rng.randrange(225, 255)))
    else:  # of one magnitude: rounding, cancellation
        exponent = rng.randrange(115, 140)
    # Few or many significant bits.
    return sign | exponent << 23 | rng.getrandbits(23) & -1 << rng.choice((0, 0, 11, 20))


class Generator:
    """One program. lines: its assembly; counts: by mnemonic, the instructions that run in every pass for certain
    (those that a branch may skip are left out)."""

    def __init__(self, records, seed):
        self.rng = random.Random(seed)
        known = [r for r in records.of("Rv32") if r.Extension in EXTENSIONS and kind(r)]
        self.by_name = {r.Mnemonic: r for r in known}
        self.known = known
        self.weights = [weight(r) for r in known]
        self.word_loads = [r for r in known if kind(r) == "load" and self.access_size(r) == 4]
        self.csrs = {c.Name: c.Number for c in records.of("Csr") if c.Name in ("fflags", "frm", "fcsr")}
        self.counts = dict.fromkeys(self.by_name, 0)
        self.lines = []
        for block in range(BLOCKS):
            self.lines.append(f"# block {block}")
            self.block()
            self.lines.append("  jal x1, checkpoint")
        self.table = [operand(self.rng) for _ in range(TABLE_REACH + PASSES * TABLE_STEP)]

    @staticmethod
    def access_size(record):
        return 1 << (record.Match >> 12 & 3)

    def block(self):
        rng = self.rng
        self.words = []  # (word, mnemonic)
        self.open = []  # jumps without a target yet: [index, base index, items to skip]
        self.free = {"x": list(range(5, 32)), "f": list(range(32))}
        rng.shuffle(self.free["x"])
        rng.shuffle(self.free["f"])
        for record in self.word_loads:
            for _ in range(5):
                self.load(record, from_table=True)
        self.fresh = [word >> 7 & 31 for word, name in self.words if name == "lw"]
        # An item takes three integer registers at most.
        while len(self.words) < 60 and len(self.free["x"]) > 3 and len(self.free["f"]) > 1:
            record, = rng.choices(self.known, self.weights)
            waiting = list(self.open)
            getattr(self, kind(record))(record)
            for jump in waiting:
                jump[2] -= 1
                if jump[2] == 0:
                    self.land(jump)
        while self.open:
            self.land(self.open[0])
        self.lines += [f"  .word {word:#010x}  # {name}" for word, name in self.words]

    def emit(self, record, **fields):
        """Appends the record's word: random outside its mask, then the fields given, as (value, low bit, width)."""
        word = record.Match | self.rng.getrandbits(32) & ~record.Mask
        for value, low, width in fields.values():
            field = (1 << width) - 1
            word = word & ~(field << low) | (value & field) << low
        self.words.append((word, record.Mnemonic))
        if not self.open:
            self.counts[record.Mnemonic] += 1

    def destination(self, record):
        """The field rd: a register not written in this block, now and then x0."""
        file = "f" if re.search(r"\bfrd\b", record.Syntax) else "x"
        if file == "x" and self.rng.randrange(32) == 0:
            return 0, 7, 5
        return self.free[file].pop(), 7, 5

    def sources(self, record):
        """Half of the integer operands come from the block's fresh ones: most results are small or never change."""
        return {name: (self.rng.choice(self.fresh), low, 5) for name, low in (("rs1", 15), ("rs2", 20))
                if re.search(rf"\b{name}\b", record.Syntax) and self.rng.getrandbits(1)}

    def compute(self, record):
        fields = {"rd": self.destination(record), **self.sources(record)}
        if re.search(r"\brm\b", record.Syntax):
            fields["rm"] = self.rng.choice((*VALID_RM, RM_DYN, RM_DYN)), 12, 3
        self.emit(record, **fields)
        # Flags are sticky: read and clear them often, or most would hide behind earlier ones.
        if "rm" in fields and len(self.free["x"]) > 3 and self.rng.randrange(3) == 0:
            self.set_csr("fflags", 0)

    def set_csr(self, name, value):
        record = self.by_name["csrrwi"]
        self.emit(record, rd=self.destination(record), rs1=(value, 15, 5), csr=(self.csrs[name], 20, 12))

    def csr(self, record):
        name = self.rng.choice(list(self.csrs))
        self.emit(record, rd=self.destination(record), csr=(self.csrs[name], 20, 12))
        if name != "fflags":  # a reserved rounding mode must not last
            self.set_csr("frm", self.rng.choice(VALID_RM))

    def fence(self, record):
        self.emit(record)

    def pointer(self, offset, register):
        """addi register, sp, offset"""
        self.emit(self.by_name["addi"], rd=(register, 7, 5), rs1=(SP, 15, 5), imm=(offset, 20, 12))

    def address(self, size, destination=None):
        """(base register, offset) of a place in scratch: from sp or through another register, which may be the
        destination itself."""
        rng = self.rng
        place = rng.randrange(-SCRATCH // 2, SCRATCH // 2, size)
        if rng.getrandbits(1):
            return SP, place
        offset = rng.randrange(-1500, 1500)
        base = destination if destination and rng.getrandbits(1) else self.free["x"].pop()
        self.pointer(place - offset, base)
        return base, offset

    def load(self, record, from_table=None):
        rng = self.rng
        rd = self.destination(record)
        size = self.access_size(record)
        if from_table or rng.getrandbits(1):
            base, offset = TP, rng.randrange(-2 * TABLE_REACH, 2 * TABLE_REACH, size)
        else:
            base, offset = self.address(size, None if "frd" in record.Syntax else rd[0])
        self.emit(record, rd=rd, rs1=(base, 15, 5), imm=(offset, 20, 12))

    def store(self, record):
        base, offset = self.address(self.access_size(record))
        self.emit(record, rs1=(base, 15, 5), low=(offset, 7, 5), high=(offset >> 5, 25, 7))

    def atomic(self, record):
        rd = self.destination(record)
        base = rd[0] if rd[0] and self.rng.getrandbits(1) else self.free["x"].pop()
        self.pointer(self.rng.randrange(-SCRATCH // 2, SCRATCH // 2, 4), base)
        self.emit(record, rd=rd, rs1=(base, 15, 5))

    def branch(self, record):
        fields = self.sources(record)
        if self.rng.randrange(4) == 0:  # equal operands are rare otherwise
            register = self.rng.randrange(32)
            fields = {"rs1": (register, 15, 5), "rs2": (register, 20, 5)}
        self.emit(record, **fields)
        self.leap(0, 3)

    def jal(self, record):
        self.emit(record, rd=self.destination(record))
        self.leap(0, 1)

    def jalr(self, record):
        rd = self.destination(record)
        base = rd[0] if rd[0] and self.rng.getrandbits(1) else self.free["x"].pop()
        self.emit(self.by_name["auipc"], rd=(base, 7, 5), imm=(0, 12, 20))
        self.emit(record, rd=rd, rs1=(base, 15, 5))
        self.leap(1, 1)

    def leap(self, back, most):
        """The last word jumps over 1 to `most` items; its offset counts from the word `back` before it."""
        index = len(self.words) - 1
        self.open.append([index, index - back, self.rng.randint(1, most)])

    def land(self, jump):
        """Sets a jump's offset so that it goes to the next word."""
        self.open.remove(jump)
        index, base, _ = jump
        word, name = self.words[index]
        offset = 4 * (len(self.words) - base)
        form = self.by_name[name].Fmt.id
        if form == "B":  # offsets are below 2 KiB and positive
            word = word & 0x01FFF07F | (offset >> 5) << 25 | (offset >> 1 & 15) << 8 | (offset >> 11) << 7
        elif form == "J":
            word = word & 0xFFF | (offset >> 1) << 21
        else:  # jalr clears bit 0 of its target
            word = word & 0xFFFFF | (offset | self.rng.getrandbits(1)) << 20
        self.words[index] = word, name
