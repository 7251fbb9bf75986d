"""The six kinds of test for every record: each function yields (record's name, lines of a test's input).

mc-valid       the assembler's bytes, and the disassembly of the object
mc-invalid     wrong operands, each refused in its line and column; mc-extension: without the extension
codegen        a call of the intrinsic in IR becomes the instruction
builtin        a call of the function of vorion.h becomes the intrinsic and the instruction
builtin-error  wrong calls of it are errors in their line; builtin-extension: without the extension
attributes     the extension in an object's attributes is what lets the record be assembled and disassembled
"""

from intrinsics import intrinsics
from operands import NOT_A_CSR, NOT_AN_OPERAND, RANGE5, Line

# Our extensions, and what the assembler says of a missing one. (The others' are LLVM's own tests' matter.)
EXTENSIONS = {"xvortex": "'XVortex' (SIMT threads)", "xvorion": "'XVorion' (Gaussian rasterizer)"}
# What an extension cannot be named without.
NEEDS = {"zacas": ["zaamo"]}


def is_ours(record):
    return record.Extension in EXTENSIONS


def is_written(csr):
    return csr.Rule.Name != "none"


def error(column, message, text):
    return [f"# CHECK: :[[@LINE+1]]:{column}: error: {message}", text]


# --- assembler ---------------------------------------------------------------


def csr_lines(c):
    """(text as the assembler prints it, word): csrrs rd, csr, x0 and csrrw x0, csr, rs1 of Zicsr."""
    yield f"csrrs\ta0, {c.Name}, zero", c.Number << 20 | 2 << 12 | 10 << 7 | 0x73
    if is_written(c):
        yield f"csrrw\tzero, {c.Name}, t2", c.Number << 20 | 7 << 15 | 1 << 12 | 0x73


def mc_valid(records):
    def lines(text, printed, disassembled, word):
        encoding = ",".join(f"0x{byte:02x}" for byte in word.to_bytes(4, "little"))
        return [f"# CHECK: {printed}", f"# CHECK-SAME: encoding: [{encoding}]", f"# DIS: {word:08x} {disassembled}", text]

    for i in records.of("Instruction"):
        line = Line(i)
        yield i.id, lines(line.text(), line.printed(), line.disassembled(), line.word)
    for c in records.of("Csr"):
        yield c.id, [l for text, word in csr_lines(c) for l in lines(text.replace("\t", " "), text, text, word)]


def mc_invalid(records):
    for i in records.of("Instruction"):
        line, cases = Line(i), []
        for name, o in line.operands.items():
            for text, says in o.wrong:
                cases += error(line.column(name), says, line.text(**{name: text}))
        if line.ours:
            shorter = line.text().rpartition(", " if len(line.operands) > 1 else " ")[0]
            cases += error(1, "too few operands for instruction", shorter)
        if line.ours or not line.operands:
            longer = line.text() + (", " if line.operands else " ")
            cases += error(len(longer) + 1, NOT_AN_OPERAND, longer + "a5")
        yield i.id, cases
    for c in records.of("Csr"):
        yield c.id, [*error(11, NOT_A_CSR, f"csrrs a0, {c.Name}_, zero"),
                     *error(7, NOT_AN_OPERAND, f"csrrs fa0, {c.Name}, zero"),
                     *error(len(f"csrrw a0, {c.Name}, ") + 1, RANGE5, f"csrrw a0, {c.Name}, fa0"),
                     *error(len(f"csrrwi a0, {c.Name}, ") + 1, RANGE5, f"csrrwi a0, {c.Name}, 32"),
                     *error(1, "too few operands for instruction", f"csrrw a0, {c.Name}")]


def mc_extension(records):
    """What a core without the extensions says (CHECK), and what one with XVortex alone does (VORTEX)."""
    def lines(record, column, says, text):
        vortex = [f"# VORTEX: :[[@LINE+1]]:{column}: error: {says}"] if record.Extension == "xvorion" else []
        return [f"# CHECK: :[[@LINE+{1 + len(vortex)}]]:{column}: error: {says}", *vortex, text]

    for i in filter(is_ours, records.of("Instruction")):
        yield i.id, lines(i, 1, f"instruction requires the following: {EXTENSIONS[i.Extension]}", Line(i).text())
    for c in filter(is_ours, records.of("Csr")):
        yield c.id, lines(c, 11, "system register use requires an option to be enabled", f"csrrs a0, {c.Name}, zero")


def arch(*extensions):
    letters = [e for e in extensions if len(e) == 1 and e != "i"]
    words = [word for e in extensions if len(e) > 1 for word in NEEDS.get(e, []) + [e]]
    return "_".join(["rv32i" + "".join(letters), *dict.fromkeys(words)])


def attributes(records):
    """CHECK: what is printed, with nothing but the directive to allow it; DIS: of the object, by its attributes alone."""
    def lines(extension, printed, disassembled, word, text):
        named = "rv32i2p1" if extension == "i" else f"rv32i{{{{.*}}}}{extension}{{{{[0-9]+p[0-9]+}}}}"
        return [f".attribute arch, \"{arch(extension)}\"", f"# CHECK: .attribute{{{{[[:space:]]}}}}5, \"{named}",
                f"# CHECK: {printed}", f"# DIS: {word:08x} {disassembled}", text]

    for i in records.of("Instruction"):
        line = Line(i)
        yield i.id, lines(i.Extension, line.printed(), line.disassembled(), line.word, line.text())
    for c in records.of("Csr"):
        text, word = next(csr_lines(c))
        yield c.id, lines(c.Extension, text, text, word, text.replace("\t", " "))
    # The last directive is the object's.
    every = dict.fromkeys(r.Extension for cls in ("Instruction", "Csr") for r in records.of(cls))
    yield None, [f".attribute arch, \"{arch(*every)}\""]


# --- compiler ----------------------------------------------------------------

# What must stand beside an intrinsic for the compiler to take it: a split ends in a join, a predicate's mask is
# the loop's own.
CONTEXT = {
    "vx_split": lambda call: [("r", *call), (None, "vx_join", ["r"])],
    "vx_split_n": lambda call: [("r", *call), (None, "vx_join", ["r"])],
    "vx_join": lambda call: [("r", "vx_split", ["a"]), (None, "vx_join", ["r"])],
    "vx_pred": lambda call: [("r", "vx_active_threads", []), (None, "vx_pred", ["a", "r"])],
    "vx_pred_n": lambda call: [("r", "vx_active_threads", []), (None, "vx_pred_n", ["a", "r"])],
}


def record_of(i):
    return i.record.id


def calls_for(i):
    call = (i.name, ["a", "b"][:i.inputs])
    if i.name in CONTEXT:
        return CONTEXT[i.name](call), None
    result = "r" if i.has_result else None
    return [(result, *call)], result


def selected(i, call):
    """The instruction of a call whose parameters are a and b, in a0 and a1."""
    any_register = "{{[ast][0-9]+}}"
    result, _, arguments = call
    texts = [{"a": "a0", "b": "a1"}.get(x, any_register) for x in arguments]
    if i.kind == "read":
        return f"csrr a0, {i.record.Name}"
    if i.kind == "write":
        return f"csrw {i.record.Name}, a0"
    registers = ([any_register if i.name in CONTEXT else "a0"] if result else []) + texts
    return f"{i.record.Mnemonic} {', '.join(registers)}"


def checks(i, comment, calls):
    lines = [f"{comment} CHECK-LABEL: test_{i.name}:"]
    if i.kind == "compiler":  # no instruction of its own
        return lines + [f"{comment} CHECK: # %bb.0", f"{comment} CHECK-NEXT: ret"]
    call = next(c for c in calls if c[1] == i.name)
    return lines + [f"{comment} CHECK: {selected(i, call)}", f"{comment} CHECK: ret"]


def codegen(records):
    names = {i.name: i for i in intrinsics(records)}
    declared = set()
    for i in names.values():
        calls, returned = calls_for(i)
        lines = checks(i, ";", calls)
        for _, name, arguments in calls:
            if name not in declared:
                declared.add(name)
                kind = "i32" if names[name].has_result else "void"
                lines.append(f"declare {kind} @vorion.{name}({', '.join(['i32'] * len(arguments))}) #0")
        parameters = ", ".join(f"i32 %{x}" for x in ["a", "b"][:i.inputs])
        lines.append(f"define {'i32' if returned else 'void'} @test_{i.name}({parameters}) #1 {{")
        for result, name, arguments in calls:
            kind = "i32" if names[name].has_result else "void"
            values = ", ".join(f"i32 %{x}" for x in arguments)
            lines.append(f"  {'%' + result + ' = ' if result else ''}call {kind} @vorion.{name}({values}) #0")
        lines += [f"  ret {'i32 %' + returned if returned else 'void'}", "}"]
        yield record_of(i), lines
    yield None, ["attributes #0 = { convergent nomerge nounwind }", "attributes #1 = { nounwind }"]


def builtin(records):
    yield None, ["#include \"vorion.h\""]
    for i in intrinsics(records):
        calls, returned = calls_for(i)
        parameters = ", ".join(f"uint {x}" for x in ["a", "b"][:i.inputs]) or "void"
        lines = checks(i, "//", calls)
        lines += [f"// IR-LABEL: @test_{i.name}(", f"// IR: call {{{{.*}}}}@vorion.{i.name}({{{{.*}}}}) #[[CALL:[0-9]+]]",
                  f"{'uint' if returned else 'void'} test_{i.name}({parameters}) {{"]
        for result, name, arguments in calls:
            lines.append(f"  {'uint ' + result + ' = ' if result else ''}{name}({', '.join(arguments)});")
        yield record_of(i), lines + [*([f"  return {returned};"] if returned else []), "}"]
    yield None, ["// IR: attributes #[[CALL]] = { convergent nomerge nounwind }"]


def builtin_error(records):
    yield None, ["#include \"vorion.h\"", "struct pair { uint a, b; };", "void *pointer;", "struct pair pair;"]
    for i in intrinsics(records):
        lines = [f"void test_{i.name}(void) {{"]

        def wrong(message, call):
            lines.extend([f"  // CHECK: :[[@LINE+1]]:{{{{[0-9]+}}}}: error: {message}", f"  {call};"])

        good = ["1"] * i.inputs
        if i.inputs:
            wrong("too few arguments to function call", f"{i.name}({', '.join(good[1:])})")
        wrong("too many arguments to function call", f"{i.name}({', '.join(good + ['1'])})")
        for n in range(i.inputs):
            for other, message in (("pointer", "incompatible pointer to integer conversion passing 'void *'"),
                                   ("pair", "passing 'struct pair' to parameter of incompatible type 'uint'")):
                wrong(message, f"{i.name}({', '.join(good[:n] + [other] + good[n + 1:])})")
        value = f"{i.name}({', '.join(good)})"
        if i.has_result:
            wrong("incompatible integer to pointer conversion assigning to 'void *'", f"pointer = {value}")
            wrong("assigning to 'struct pair' from incompatible type 'uint'", f"pair = {value}")
        else:
            wrong("assigning to 'struct pair' from incompatible type 'void'", f"pair = {value}")
        if i.kind == "read" and not is_written(i.record):
            wrong(f"call to undeclared function '{i.name}_set'", f"{i.name}_set(1)")
        yield record_of(i), lines + ["}"]


def builtin_extension(records):
    """With XVortex alone; without it the header itself is an error (test/clang/errors.c)."""
    yield None, ["#include \"vorion.h\""]
    for i in intrinsics(records):
        lines = [f"void test_{i.name}(void) {{"]
        if i.extension == "xvorion":
            lines.append(f"  // CHECK: :[[@LINE+1]]:{{{{[0-9]+}}}}: error: '{i.name}' is unavailable: needs -march with xvorion")
        unused = "(void)" if i.has_result else ""
        lines += [f"  {unused}{i.name}({', '.join(['1'] * i.inputs)});", "}"]
        yield record_of(i), lines


KINDS = {"mc-valid": mc_valid, "mc-invalid": mc_invalid, "mc-extension": mc_extension, "codegen": codegen,
         "builtin": builtin, "builtin-error": builtin_error, "builtin-extension": builtin_extension,
         "attributes": attributes}


def kinds_for(classes, record):
    """The kinds that apply to a record of these TableGen classes; stated apart from the generators above."""
    compiled = {"codegen", "builtin", "builtin-error", "builtin-extension"}
    assembled = {"mc-valid", "mc-invalid", "attributes"}
    own = {"mc-extension"} if getattr(record, "Extension", None) in ("xvortex", "xvorion") else set()
    if "Instruction" in classes:
        return assembled | own | (compiled if "SimtInstruction" in classes else set())
    if "Csr" in classes:
        return assembled | own | (compiled if record.HasIntrinsic else set())
    return compiled if "CompilerIntrinsic" in classes else set()
