#!/usr/bin/env python3
"""Writes what the LLVM backend needs of the records.

usage: backend.py [--tblgen PATH] OUTPUT_FOLDER

RISCVInstrInfoXVortex.td  instructions and CSR names, for LLVM's TableGen
VorionIntrinsics.def      one line an intrinsic: name, opcode, CSR, operands, divergence
VorionCsrs.h              the numbers of our CSRs
"""

import argparse
import os

from intrinsics import intrinsics
from printing import note
from records import Records, write

PREDICATES = {"xvortex": "HasVendorXVortex", "xvorion": "HasVendorXVorion"}
FEATURES = {"xvortex": "FeatureVendorXVortex", "xvorion": "FeatureVendorXVorion"}
# Where the format R of the unprivileged specification puts its registers.
FIELDS = {"rd": 7, "rs1": 15, "rs2": 20}


def instruction(record):
    outs = [x for x in record.Outs.split(", ") if x]
    ins = [x for x in record.Ins.split(", ") if x]
    fixed = [f"{name} = {record.Match >> low & 31}" for name, low in FIELDS.items() if name not in outs + ins]
    operands = ", ".join("$" + x for x in outs + ins)
    body = (f"def {record.id} : VortexInstruction<{record.Funct7}, {record.Funct3}, "
            f"(outs {', '.join('GPR:$' + x for x in outs)}), (ins {', '.join('GPR:$' + x for x in ins)}), "
            f"\"{record.Mnemonic}\", \"{operands}\">;").replace("(outs )", "(outs)")
    return (f"let Predicates = [{PREDICATES[record.Extension]}]" + "".join(f", {f}" for f in fixed) + f" in\n{body}\n")


def target_records(records):
    yield note("backend.py") + "\n"
    # Lanes stay in step only while nothing moves across these.
    yield """class VortexInstruction<bits<7> funct7, bits<3> funct3, dag outs, dag ins, string mnemonic, string operands>
    : RVInstR<funct7, funct3, OPC_CUSTOM_0, outs, ins, mnemonic, operands> {
  let hasSideEffects = 1;
  let mayLoad = 1;
  let mayStore = 1;
  let isConvergent = 1;
  let isNotDuplicable = 1;
  let hasNoSchedulingInfo = 1;
}
"""
    for record in records.of("SimtInstruction"):
        yield instruction(record)
    for record in records.of("Csr"):
        if record.Extension in FEATURES:
            yield (f"let FeaturesRequired = [{{ {{RISCV::{FEATURES[record.Extension]}}} }}] in\n"
                   f"def : SysReg<\"{record.Name}\", {record.Number:#x}>;\n")


def table(records):
    yield note("backend.py")
    yield "// VORION_INTRINSIC(C name, opcode, CSR or -1, inputs, has a result, divergence of the result, extension)"
    opcodes = {"compiler": "COPY", "read": "CSRRS", "write": "CSRRW"}
    for i in intrinsics(records):
        opcode = opcodes.get(i.kind, i.record.id)
        csr = hex(i.record.Number) if i.kind in ("read", "write") else -1
        yield (f"VORION_INTRINSIC({i.name}, {opcode}, {csr}, {i.inputs}, {str(i.has_result).lower()}, "
               f"{i.divergence.capitalize()}, {i.extension})")
    yield "#undef VORION_INTRINSIC"


def csr_numbers(records):
    yield note("backend.py")
    yield "#pragma once\n\nnamespace llvm::vorion::csr {"
    for record in records.of("Csr"):
        if record.Extension in FEATURES:
            yield f"constexpr unsigned {record.Name} = {record.Number:#x};"
    yield "} // namespace llvm::vorion::csr"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tblgen", default="llvm-tblgen-19")
    parser.add_argument("folder")
    options = parser.parse_args()
    records = Records(options.tblgen)
    for name, lines in (("RISCVInstrInfoXVortex.td", target_records), ("VorionIntrinsics.def", table),
                        ("VorionCsrs.h", csr_numbers)):
        write(os.path.join(options.folder, name), "\n".join(lines(records)) + "\n")


if __name__ == "__main__":
    main()
