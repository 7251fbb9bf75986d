"""The intrinsics that kernels see, as one list made from the records.

An intrinsic is a plain function declaration whose assembler name is "vorion."
followed by its C name; the backend knows it by that name.
"""

from types import SimpleNamespace

PREFIX = "vorion."


def _parse(prototype):
    """"uint f(uint a, uint b)" -> ("uint", "f", ["uint a", "uint b"])"""
    head, parameters = prototype.rstrip(")").split("(")
    result, name = head.split()
    return result, name, [] if parameters == "void" else parameters.split(", ")


def _make(prototype, divergence, doc, kind, record):
    result, name, parameters = _parse(prototype)
    return SimpleNamespace(prototype=prototype, name=name, symbol=PREFIX + name, has_result=result != "void",
                           inputs=len(parameters), divergence=divergence, doc=doc, kind=kind, record=record,
                           extension="xvorion" if getattr(record, "Extension", "") == "xvorion" else "xvortex")


def intrinsics(records):
    """Instructions, compiler intrinsics, then CSR reads and writes, in the order of the records."""
    for i in records.of("SimtInstruction"):
        yield _make(i.Prototype, i.Divergence, i.Doc, "instruction", i)
    for i in records.of("CompilerIntrinsic"):
        yield _make(i.Prototype, i.Divergence, i.Doc, "compiler", i)
    for c in records.of("Csr"):
        if not c.HasIntrinsic:
            continue
        name = c.Name if c.Name.startswith(("vx_", "vr_")) else "vx_" + c.Name
        yield _make(f"uint {name}(void)", "uniform" if c.Uniform else "source", c.Doc, "read", c)
        if c.Rule.Name != "none":
            yield _make(f"void {name}_set(uint value)", "none", c.Doc, "write", c)
