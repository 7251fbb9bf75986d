"""Operands of instructions: how each is written, where its bits go, and what is refused in its place.

The bits are those of the RISC-V unprivileged specification's formats, written down here once more so that the
records are held against something. No two operands of an instruction have the same value, so that a swap shows.
"""

import re
from dataclasses import dataclass


@dataclass
class Operand:
    text: str  # as the assembler prints it
    bits: int  # in place
    wrong: tuple  # ((other text, what the assembler says of it), ...)
    printed: str = ""  # as the disassembler prints it, a FileCheck pattern; text if empty


NOT_AN_OPERAND = "invalid operand for instruction"
NOT_A_CSR = "operand must be a valid system register name or an integer in the range [0, 4095]"
RANGE5 = "immediate must be an integer in the range [0, 31]"
X_REGISTERS = {"rd": ("a0", 10 << 7), "rs1": ("t2", 7 << 15), "rs2": ("s3", 19 << 20)}
PAIRS = {"rd": ("a0", 10 << 7), "rs2": ("s4", 20 << 20)}
F_REGISTERS = {"frd": ("fa0", 10 << 7), "frs1": ("ft7", 7 << 15), "frs2": ("fs3", 19 << 20), "frs3": ("ft10", 30 << 27)}


def _store(value):
    return (value >> 5) << 25 | (value & 31) << 7


def _branch(value):
    return (value >> 12 & 1) << 31 | (value >> 5 & 63) << 25 | (value >> 1 & 15) << 8 | (value >> 11 & 1) << 7


def _jump(value):
    return (value >> 20 & 1) << 31 | (value >> 1 & 1023) << 21 | (value >> 11 & 1) << 20 | (value >> 12 & 255) << 12


IMMEDIATE = 0x5A5
RANGE12 = r"{{.*}}in the range [-2048, 2047]"


def operand(name, form, ours, pairs):
    """ours: an instruction of ours, of which more is known to be wrong (LLVM has aliases with immediates).
    pairs: rd and rs2 are the even ones of two registers."""
    if pairs and name in PAIRS:
        return Operand(*PAIRS[name], (("fa1", NOT_AN_OPERAND), ("a1", "register must be even")))
    if name in X_REGISTERS:
        text, bits = X_REGISTERS[name]
        # An alias with an immediate there names the immediate's range.
        wrong = [("fa1", NOT_AN_OPERAND if ours else f"{{{{({NOT_AN_OPERAND}|.*in the range .*)}}}}")]
        if ours:
            wrong += [("5", NOT_AN_OPERAND), ("nowhere", NOT_AN_OPERAND)]
        return Operand(text, bits, tuple(wrong))
    if name in F_REGISTERS:
        return Operand(*F_REGISTERS[name], (("a1", NOT_AN_OPERAND),))
    if name == "imm":
        put = _store if form == "S" else lambda value: value << 20
        return Operand(str(IMMEDIATE), put(IMMEDIATE), ((("2048"), RANGE12), ("-2049", RANGE12)))
    if name == "shamt":
        return Operand("21", 21 << 20, (("32", RANGE5), ("-1", RANGE5)))
    if name == "uimm":
        return Operand("21", 21 << 15, (("32", RANGE5), ("-1", RANGE5)))
    if name == "uimm20":
        says = "{{.*}}in the range [0, 1048575]"
        return Operand("703710", 703710 << 12, (("1048576", says), ("-1", says)))
    if name == "csr":
        return Operand("fcsr", 3 << 20, (("4096", "immediate must be an integer in the range [0, 4095]"),
                                         ("nowhere", NOT_A_CSR)))
    if name == "rm":
        return Operand("rtz", 1 << 12, (("a1", "operand must be a valid floating point rounding mode mnemonic"),))
    if name == "target" and form == "J":
        says = "immediate must be a multiple of 2 bytes in the range [-1048576, 1048574]"
        return Operand("371108", _jump(371108), (("1048576", says), ("3", says)), "{{0x[0-9a-f]+}}")
    if name == "target":
        says = "immediate must be a multiple of 2 bytes in the range [-4096, 4094]"
        return Operand("1444", _branch(1444), (("4096", says), ("3", says)), "{{0x[0-9a-f]+}}")
    if name == "fence":
        # pred rw, succ w
        says = "operand must be formed of letters selected in-order from 'iorw' or be 0"
        return Operand("rw, w", 3 << 24 | 1 << 20, (("wr, w", says),))
    raise ValueError(f"operand '{name}' of format {form}: expected one that test/Inputs/records/operands.py knows")


class Line:
    """An instruction with its operands in place. Pieces are the operands' names and the text between them."""

    def __init__(self, record):
        syntax = getattr(record, "Syntax", None)
        self.ours = syntax is None
        if self.ours:
            syntax = ", ".join(x for x in (record.Outs, record.Ins) if x)
        self.mnemonic = record.Mnemonic
        self.pieces = re.findall(r"[a-z0-9]+|[^a-z0-9]+", syntax)
        self.operands = {p: operand(p, record.Fmt.id, self.ours, record.Pairs) for p in self.pieces if p[0].isalpha()}
        self.word = record.Match & 0xFFFFFFFF
        for o in self.operands.values():
            self.word |= o.bits

    def _joined(self, texts, separator):
        return (self.mnemonic + separator + "".join(texts.get(p, p) for p in self.pieces)).rstrip()

    def text(self, **other):
        """As written; other: texts in place of operands."""
        return self._joined({n: o.text for n, o in self.operands.items()} | other, " ")

    def printed(self):
        """As printed: a tab behind the mnemonic."""
        return self._joined({n: o.text for n, o in self.operands.items()}, "\t")

    def disassembled(self):
        return self._joined({n: o.printed or o.text for n, o in self.operands.items()}, "\t")

    def column(self, name):
        """Where operand name begins in text(), from 1."""
        before = self.pieces[:self.pieces.index(name)]
        return len(self.mnemonic) + 2 + len("".join(self.operands[p].text if p in self.operands else p for p in before))
