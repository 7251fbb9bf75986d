#!/usr/bin/env python3
"""No call leaves code of a vector level with dirty upper halves of the vector registers.

usage: vector_uppers.py OBJECT...

Code that is compiled for any host uses legacy SSE instructions, which are slow on Intel's cores as long as the upper halves of the
vector registers are dirty. So whatever an object of a vector level calls outside of itself must see them clean: on every path an
instruction vzeroupper comes after the last one that uses a ymm or zmm register. A function may be entered with dirty halves (the
instructions of the simulator jump into each other), and an indirect call or jump is one to a function of the same object.
Prints each call that does not see them clean, then how many calls there were.
exit codes: 0 all are clean, 1 some are not, 2 no object has calls to look at
"""

import re
import subprocess
import sys

FUNCTION = re.compile(r"^([0-9a-f]+) <(.+)>:$")
INSTRUCTION = re.compile(r"^\s*([0-9a-f]+):\s+(\S+)\s*(.*)$")
RELOCATION = re.compile(r"^\s*[0-9a-f]+: R_X86_64_\S+\s+(\S+?)(?:[-+]0x[0-9a-f]+)?$")
TARGET = re.compile(r"^(?:0x)?([0-9a-f]+)")
WIDE = re.compile(r"%[yz]mm")


class Function:
    def __init__(self, name):
        self.name, self.code = name, []  # (address, mnemonic, operands, symbol of its relocation or None)


def functions(path):
    text = subprocess.run(["objdump", "-dr", "--no-show-raw-insn", path], stdout=subprocess.PIPE, check=True, text=True).stdout
    found = []
    for line in text.splitlines():
        if begins := FUNCTION.match(line):
            found.append(Function(begins[2]))
        elif (names := RELOCATION.match(line)) and found and found[-1].code:
            found[-1].code[-1] = found[-1].code[-1][:3] + (names[1],)
        elif (is_code := INSTRUCTION.match(line)) and found:
            found[-1].code.append((int(is_code[1], 16), is_code[2], is_code[3], None))
    return found


def dirty_calls(function, own):
    """(calls to the outside, those that may see dirty halves); own: names that the object itself defines."""
    code = function.code
    index = {address: n for n, (address, *_) in enumerate(code)}
    dirty_at, work, calls, bad = {}, [(0, True)], set(), set()
    while work:
        n, dirty = work.pop()
        # Once dirty, clean tells nothing new.
        if n >= len(code) or dirty_at.get(n) or dirty_at.get(n) == dirty:
            continue
        dirty_at[n] = dirty
        address, mnemonic, operands, symbol = code[n]
        jumps = mnemonic.startswith("j")
        if jumps or mnemonic.startswith("call"):
            outside = symbol is not None and symbol not in own and not symbol.startswith(".") and "*" not in operands
            if outside:
                calls.add(address)
                if dirty:
                    bad.add((address, symbol))
            target = TARGET.match(operands)
            if jumps and not outside and target and int(target[1], 16) in index:
                work.append((index[int(target[1], 16)], dirty))
            if jumps and mnemonic.startswith("jmp"):
                continue
            if not jumps:
                dirty = not outside
        elif mnemonic == "vzeroupper" or mnemonic == "vzeroall":
            dirty = False
        elif mnemonic.startswith("ret"):
            continue
        elif WIDE.search(operands):
            dirty = True
        work.append((n + 1, dirty))
    return calls, bad


def main():
    total = wrong = 0
    for path in sys.argv[1:]:
        every = functions(path)
        own = {f.name for f in every}
        for function in every:
            calls, bad = dirty_calls(function, own)
            total += len(calls)
            wrong += len(bad)
            for address, symbol in sorted(bad):
                print(f"{path}: {function.name}: the call at {address:#x} of {symbol} may see dirty upper halves")
    print(f"{total} calls out of {len(sys.argv) - 1} objects, {wrong} of them with dirty upper halves")
    return 2 if total == 0 else wrong != 0


if __name__ == "__main__":
    sys.exit(main())
