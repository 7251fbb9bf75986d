#!/usr/bin/env python3
"""Writes the header of kernels or the header of host programs.

usage: header.py [--tblgen PATH] --for device|host OUTPUT
device: vorion.h, for OpenCL C and C kernels: intrinsics, constants, descriptors
host: vorion_abi.h, for C and C++: constants, CSR numbers, descriptors
"""

from intrinsics import intrinsics
from printing import C, csr_macro, note
from records import write_for_one_of

DEVICE_HEAD = """#ifndef VORION_H
#define VORION_H

#if !defined(__OPENCL_C_VERSION__) && !defined(__OPENCL_CPP_VERSION__)
#if !defined(__riscv_xvortex)
#error "vorion.h: the target is not a Vorion core, expected -march with xvortex"
#endif
typedef unsigned int uint;
#endif

/* Lanes must reach these together or apart exactly as written: convergent keeps
   the optimiser from moving a call under a condition, nomerge from making one
   call of two. */
#define VORION_INTRINSIC(name) __asm("vorion." #name) __attribute__((convergent, nomerge, nothrow))
/* What only reads lanes changes no memory: an unused call goes, and of two equal
   ones in a basic block, where the mask is the same, one stays. What needs order
   says so with a fence. */
#define VORION_PURE_INTRINSIC(name) VORION_INTRINSIC(name) __attribute__((pure))
/* What the target lacks is an error at the call. (A front end for a plain RISC-V
   target, as PoCL's, knows neither extension and leaves it to the backend.) */
#if defined(__riscv_xvortex) && !defined(__riscv_xvorion)
#define VORION_XVORION_INTRINSIC(name) VORION_INTRINSIC(name) __attribute__((unavailable("needs -march with xvorion")))
#else
#define VORION_XVORION_INTRINSIC(name) VORION_INTRINSIC(name)
#endif

#ifdef __cplusplus
extern "C" {
#endif
"""

HOST_HEAD = """#ifndef VORION_ABI_H
#define VORION_ABI_H

#include <stdint.h>
"""


def constants(records, language):
    yield from (language.constant(c) for c in records.of("Constant"))
    fields = [(c.Name, f) for c in records.of("Csr") for f in c.Fields]
    fields += [(f"vr_{w.Word}", f) for w in records.of("IndexedWord") for f in w.Fields]
    for owner, f in fields:
        name = f"{owner}_{f.Name}".upper()
        yield f"#define {name}_SHIFT {f.Low} /* {f.Doc} */"
        yield f"#define {name}_MASK {((1 << f.Width) - 1) << f.Low:#x}u"


def descriptors(records, language):
    for d in records.of("Descriptor"):
        yield from language.structure(d.Name, d.Doc, d.Fields)


def is_pure(intrinsic):
    """Whether its instruction does nothing but compute its result, perhaps from other lanes' operands."""
    return intrinsic.kind == "instruction" and {e.id for e in intrinsic.record.Effects.Effects} <= {"ReadsLanes"}


def macro_of(intrinsic):
    if intrinsic.extension == "xvorion":
        return "VORION_XVORION_INTRINSIC"
    return "VORION_PURE_INTRINSIC" if is_pure(intrinsic) else "VORION_INTRINSIC"


def device(records):
    yield DEVICE_HEAD
    for i in intrinsics(records):
        macro = macro_of(i)
        yield f"/* {i.doc} */\n{i.prototype} {macro}({i.name});"
    yield "\n#ifdef __cplusplus\n}\n#endif\n"
    language = C(u32="uint", i32="int", f32="float")
    yield from constants(records, language)
    yield from descriptors(records, language)
    yield "\n#endif"


def host(records):
    yield HOST_HEAD
    language = C(u32="uint32_t", i32="int32_t", f32="float")
    yield from constants(records, language)
    for c in records.of("Csr"):
        yield f"#define {csr_macro(c)} {c.Number:#x}u /* {c.Doc} */"
    yield from descriptors(records, language)
    yield "\n#endif"


def noted(lines):
    """The same behind a note of who made the file."""
    return lambda records: [note("header.py", "/*", "*/"), *lines(records)]


READERS = {f.__name__: noted(f) for f in (device, host)}


if __name__ == "__main__":
    write_for_one_of(READERS, __doc__)
