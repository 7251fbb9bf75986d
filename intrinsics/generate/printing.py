"""How records are written in C and C++: names, numbers, constants, structures. Every generator prints with these."""


def note(script, opening="//", closing=""):
    """The first line of everything that is generated."""
    return (f"{opening} Generated from the records of intrinsics/ by intrinsics/generate/{script}; do not edit."
            f"{closing and ' ' + closing}")


def camel(name):
    return "".join(part.capitalize() for part in name.split("_"))


def flag(value):
    return "true" if value else "false"


def word(value):
    """A number as its 32 bits."""
    return f"{value & 0xFFFFFFFF:#x}"


def csr_macro(csr):
    """The name of a CSR's number in C and assembly."""
    return f"VX_CSR_{csr.Name.upper()}"


class C:
    """types: how this reader spells "u32", "i32", "f32" and "u64"."""

    def __init__(self, **types):
        self._types = types

    def constant(self, record):
        return f"#define {record.Name} {word(record.Value)}u /* {record.Doc} */"

    def structure(self, name, doc, fields):
        """fields: Type, Name, Count and Doc each, as a DescField's."""
        yield f"\n/* {doc} */\ntypedef struct {name} {{"
        for f in fields:
            yield f"  {self._types[f.Type]} {f.Name}{_extent(f)}; /* {f.Doc} */"
        yield f"}} {name};"


class Cpp:
    """Members are named as LLVM does. A type that records do not know is a structure's name."""

    _TYPES = {"u32": "uint32_t", "f32": "float", "u64": "uint64_t", "i32": "int32_t"}

    def constants(self, records):
        yield "// The names of the ABI, as in every other language."
        yield "// NOLINTBEGIN(readability-identifier-naming)"
        for r in records:
            yield f"inline constexpr uint32_t {r.Name} = {word(r.Value)}; ///< {r.Doc}"
        yield "// NOLINTEND(readability-identifier-naming)\n"

    def structure(self, name, doc, fields, *, base="", initial="", functions=()):
        """initial: what every member starts as; functions: lines that follow the members."""
        yield f"/// {doc}"
        yield f"struct {name}{base and ' : ' + base} {{"
        for f in fields:
            kind = self._TYPES.get(f.Type, f.Type)
            yield f"  {kind} {camel(f.Name)}{_extent(f)}{initial and ' = ' + initial}; ///< {f.Doc}"
        yield from functions
        yield "};\n"


def _extent(field):
    return f"[{field.Count}]" if field.Count > 1 else ""
