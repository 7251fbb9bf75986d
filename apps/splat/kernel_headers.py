#!/usr/bin/env python3
"""Writes a C++ header for each kernel program: its choices, and the arguments of each of its kernels.

usage: kernel_headers.py OUTPUT_FOLDER FILE...
FILEs are all files of kernels/. Each .cl file with kernels is a program and gets the header FILE.h; its kernels and
choices are those of the file and of what it includes. Structures that are passed by value must be of layout.h, which
the host shares. A choice is a macro that the host defines or leaves, declared at the head of each file that uses it,
or of one that this includes, with a comment above that says what it means:

    #pragma vorion choice [optional] TYPE NAME

TYPE is flag (defined or not), uint, float, or effect (0, 1 or a test of a bit of the variable `effects`).
Exit codes: 0 done, 1 a kernel file is not as expected (the error names the line), 2 usage.
"""

import dataclasses
import os
import re
import sys

SHARED = "layout.h"
SCALARS = {"char", "uchar", "short", "ushort", "int", "uint", "long", "ulong", "float", "double"}
VECTOR = re.compile(r"(%s)(2|3|4|8|16)" % "|".join(sorted(SCALARS)))
ADDRESS_SPACES = ("global", "constant", "local", "private")
QUALIFIERS = {"const", "restrict", "volatile"}
# A parameter's name becomes a member's.
CPP_KEYWORDS = {"and", "catch", "class", "delete", "explicit", "export", "friend", "mutable", "namespace", "new", "not",
                "operator", "or", "private", "protected", "public", "template", "this", "throw", "try", "typename",
                "using", "virtual", "xor"}
# In C++, by their type.
CHOICES = {"flag": "bool", "uint": "std::optional<cl_uint>", "float": "std::optional<cl_float>",
           "effect": "std::optional<EffectSwitch>"}
MACRO = re.compile(r"\b[A-Z][A-Z0-9_]+\b")
# Macros of OpenCL C and of the device's headers.
KNOWN_MACROS = re.compile(r"(CLK|M|FLT|VR|VX)_\w+|INFINITY|NAN|OPENCL|FP_CONTRACT|OFF")


class KernelError(Exception):
    """What is wrong with a line of a kernel file."""

    def __init__(self, file, line, what):
        super().__init__(f"{file}:{line}: {what}")


@dataclasses.dataclass(frozen=True)
class Parameter:
    name: str
    kind: str  # in C++
    condition: str = ""  # the macro under which the kernel has it


@dataclasses.dataclass(frozen=True)
class Kernel:
    name: str
    doc: str
    parameters: tuple
    line: int


@dataclasses.dataclass(frozen=True)
class Choice:
    name: str
    type: str  # of CHOICES
    is_optional: bool
    doc: str = dataclasses.field(compare=False)
    line: int = dataclasses.field(compare=False)

    @property
    def is_effect(self):
        return self.type == "effect"

    @property
    def is_required(self):
        return self.type in ("uint", "float") and not self.is_optional


@dataclasses.dataclass(frozen=True)
class KernelFile:
    name: str
    includes: tuple
    kernels: tuple
    structures: frozenset  # that it defines
    choices: tuple
    macros: dict  # that it uses, and the line of the first use
    defines: frozenset  # macros and enumerators


def without_comments(text):
    """Comments become a space and their line ends."""
    return re.sub(r"\"(?:\\.|[^\"\\\n])*\"|//[^\n]*|/\*.*?\*/",
                  lambda match: match[0] if match[0][0] == '"' else " " + "\n" * match[0].count("\n"), text, flags=re.S)


class Tokens:
    """The words, signs and conditional directives of a kernel file, with their lines. Other directives are left out."""

    _TOKEN = re.compile(r"^[ \t]*(?P<directive>\#(?:\\\n|[^\n])*)|(?P<space>\s+)|(?P<string>\"(?:\\.|[^\"\\\n])*\")"
                        r"|(?P<word>\w+)|(?P<sign>.)", re.M | re.S)
    _CONDITION = re.compile(r"#\s*(if|ifdef|ifndef|elif|else|endif)\b")

    def __init__(self, file, text):
        self.file = file
        self._all = []
        line = 1
        for match in self._TOKEN.finditer(without_comments(text)):
            if not match["space"] and (not match["directive"] or self._CONDITION.match(match["directive"])):
                self._all.append((match[0].strip(), line))
            line += match[0].count("\n")
        self._at = 0

    @property
    def line(self):
        return self._all[min(self._at, len(self._all) - 1)][1]

    def peek(self):
        return self._all[self._at][0] if self._at < len(self._all) else ""

    def next(self):
        token = self.peek()
        self._at += 1
        return token

    def expect(self, wanted, where):
        if self.peek() != wanted:
            raise self.error(f"'{self.peek()}' in {where}, expected '{wanted}'")
        self.next()

    def error(self, what):
        return KernelError(self.file, self.line, what)

    def skip_to(self, words):
        """Behind the next of the words; False if there is none."""
        while self._at < len(self._all):
            if self.next() in words:
                return True
        return False

    def skip_parentheses(self):
        depth = 0
        while True:
            token = self.next()
            if not token:
                raise self.error("the file ends in parentheses, expected ')'")
            depth += (token == "(") - (token == ")")
            if depth == 0:
                return


class Parameters:
    """Parses the parameters of one kernel, from behind their '('."""

    def __init__(self, tokens, kernel):
        self._tokens = tokens
        self._where = f"the parameters of kernel {kernel}"
        self._condition = ""

    def parse(self):
        found = []
        words, condition = [], ""
        while True:
            token = self._tokens.next()
            if not token:
                raise self._error("the file ends, expected ')'")
            if token.startswith("#"):
                self._directive(token)
            elif token in (",", ")"):
                if words:
                    found.append(self._parameter(words, condition))
                elif found and token == ")":
                    raise self._error("a ',' in front of the ')', expected a parameter")
                words, condition = [], ""
                if token == ")":
                    break
            else:
                condition = self._condition
                words.append(token)
        if self._condition:
            raise self._error("a condition that does not end in them, expected #endif")
        return tuple(found) if found != [None] else ()

    def _error(self, what):
        return self._tokens.error(f"{what} in {self._where}")

    def _directive(self, token):
        begin = re.fullmatch(r"#\s*(?:if|ifdef)\s+([A-Z_]\w*)", token)
        if begin and not self._condition:
            self._condition = begin[1]
        elif re.fullmatch(r"#\s*endif", token) and self._condition:
            self._condition = ""
        else:
            raise self._error(f"'{token}', expected '#if NAME' or '#ifdef NAME' and '#endif', not nested,")

    def _parameter(self, words, condition):
        if words == ["void"]:
            return None
        space = ""
        kept = []
        for word in words:
            plain = word.removeprefix("__")
            if plain in ADDRESS_SPACES:
                space = plain
            elif plain not in QUALIFIERS:
                kept.append(word)
        text = " ".join(words)
        pointer = kept[1:2] == ["*"]
        if len(kept) != 2 + pointer or not re.fullmatch(r"[A-Za-z_]\w*", kept[0]) \
                or not re.fullmatch(r"[A-Za-z_]\w*", kept[-1]):
            raise self._error(f"'{text}', expected a type, '*' if it is a pointer, and a name,")
        kind, name = kept[0], kept[-1]
        if name in CPP_KEYWORDS:
            raise self._error(f"the name '{name}', which is a keyword of C++, expected another,")
        if pointer:
            if space == "local":
                return Parameter(name, "cl::LocalSpaceArg", condition)
            if space in ("global", "constant"):
                return Parameter(name, "cl::Buffer", condition)
            raise self._error(f"the pointer '{text}', expected __global, __constant or __local,")
        if space:
            raise self._error(f"'{text}' in the address space {space}, expected a pointer,")
        return Parameter(name, self._value(kind, text), condition)

    def _value(self, kind, text):
        if kind in SCALARS or VECTOR.fullmatch(kind):
            return f"cl_{kind}"
        if kind in ("bool", "size_t", "half") or kind.endswith("_t"):
            raise self._error(f"'{text}', whose type no host can pass by value, expected one of a fixed size,")
        return kind  # a structure, of layout.h as written() checks


def comment_above(lines, index):
    """The // comment that ends above line `index`, of whole sentences."""
    first = index
    while first > 0 and re.match(r"\s*//", lines[first - 1]):
        first -= 1
    return " ".join(re.sub(r"^\s*///?\s?", "", line).strip() for line in lines[first:index])


def choices_of(name, lines):
    """Those that are declared at the file's head: no code may stand above them."""
    code = without_comments("\n".join(lines)).split("\n")
    found = []
    for index, line in enumerate(code):
        if not re.match(r"\s*#\s*pragma\s+vorion\b", line):
            continue
        match = re.fullmatch(r"#pragma vorion choice (optional )?(\w+) ([A-Z][A-Z0-9_]+)\s*", line)
        if not match or match[2] not in CHOICES:
            raise KernelError(name, index + 1, f"'{line}', expected '#pragma vorion choice [optional] TYPE NAME' with a "
                                               f"TYPE of {', '.join(CHOICES)}")
        if any(above.strip() and not above.startswith("#pragma") for above in code[:index]):
            raise KernelError(name, index + 1, f"choice {match[3]} is declared below code, expected it at the file's head")
        doc = comment_above(lines, index)
        if not doc:
            raise KernelError(name, index + 1, f"choice {match[3]} has no comment, expected its meaning in the line above")
        if match[3] in [choice.name for choice in found]:
            raise KernelError(name, index + 1, f"choice {match[3]} is declared twice, expected once")
        found.append(Choice(match[3], match[2], bool(match[1]), doc, index + 1))
    return tuple(found)


def macros_of(text):
    """The macros that are used, each with its first line."""
    found = {}
    for number, line in enumerate(text.split("\n"), 1):
        if not line.startswith(("#pragma", "#include", "#error")):
            for name in MACRO.findall(re.sub(r'"[^"]*"', "", line)):
                found.setdefault(name, number)
    return found


def parsed(name, text):
    """The KernelFile `name` with that text."""
    lines = text.split("\n")
    tokens = Tokens(name, text)
    kernels = []
    while tokens.skip_to(("__kernel", "kernel")):
        start = tokens.line
        while tokens.peek() == "__attribute__":
            tokens.next()
            tokens.skip_parentheses()
        tokens.expect("void", "a kernel")
        kernel = tokens.next()
        tokens.expect("(", f"kernel {kernel}")
        above = next(i for i in range(start - 1, -1, -1) if re.search(r"\b(__)?kernel\b", lines[i]))
        kernels.append(Kernel(kernel, comment_above(lines, above), Parameters(tokens, kernel).parse(), start))
    code = without_comments(text)
    enumerators = " ".join(re.findall(r"\benum\b[^{]*\{([^}]*)\}", code))
    return KernelFile(name, tuple(re.findall(r'^#include "([^"]+)"', text, re.M)), tuple(kernels),
                      frozenset(re.findall(r"\}\s*(\w+);", code) + re.findall(r"\bstruct\s+(\w+)\s*\{", code)),
                      choices_of(name, lines), macros_of(code),
                      frozenset(re.findall(r"^#\s*define\s+(\w+)", code, re.M) + MACRO.findall(enumerators)))


def with_included(name, files, known=None):
    """The file and what it includes, itself last."""
    known = set() if known is None else known
    known.add(name)
    found = []
    for other in files[name].includes:
        if other not in files:
            raise KernelError(name, 1, f"includes {other}, expected the name of a kernel file")
        if other not in known:
            found += with_included(other, files, known)
    return found + [files[name]]


def check_choices(files):
    """That each file declares the choices that it uses, or includes a file that does, and no others."""
    declared = {}
    for file in files.values():
        for choice in file.choices:
            other, known = declared.setdefault(choice.name, (file.name, choice))
            if known != choice:
                raise KernelError(file.name, choice.line, f"choice {choice.name} is declared unlike that of {other}, "
                                                          "expected the same type")
    defined = {name for file in files.values() for name in file.defines} - set(declared)
    used = set()
    for file in files.values():
        visible = {choice.name: other.name for other in with_included(file.name, files) for choice in other.choices}
        for name, line in file.macros.items():
            if name in visible:
                used |= {(other.name, name) for other in with_included(file.name, files)}
            elif name in declared:
                raise KernelError(file.name, line, f"{name} is not declared here, expected '#pragma vorion choice' at the "
                                                   f"file's head, or an #include of {declared[name][0]}")
            elif name not in defined and not KNOWN_MACROS.fullmatch(name):
                raise KernelError(file.name, line, f"{name} is no known macro, expected a #define of it, or '#pragma "
                                                   "vorion choice' at the file's head")
    for file in files.values():
        for choice in file.choices:
            if (file.name, choice.name) not in used:
                raise KernelError(file.name, choice.line, f"choice {choice.name} is not used, expected no declaration")


class Program:
    """A file with kernels, and the files that it includes."""

    def __init__(self, name, files):
        self.name = name
        all_files = with_included(name, files)
        self.kernels = [kernel for file in all_files for kernel in file.kernels]
        # Effects last; a dict keeps the first of several declarations.
        choices = {choice.name: choice for file in reversed(all_files) for choice in reversed(file.choices)}
        self.choices = sorted(reversed(choices.values()), key=lambda choice: choice.is_effect)
        names = [kernel.name for kernel in self.kernels]
        for kernel in names:
            if names.count(kernel) > 1:
                raise KernelError(name, 1, f"two kernels {kernel}, expected one")


def check_structures(files):
    """That the host has those that kernels take."""
    shared = files[SHARED].structures if SHARED in files else frozenset()
    for file in files.values():
        for kernel in file.kernels:
            for p in kernel.parameters:
                if not p.kind.startswith("cl") and p.kind not in shared:
                    raise KernelError(file.name, kernel.line, f"kernel {kernel.name} takes a {p.kind}, expected a number, "
                                                              f"a vector or a structure of {SHARED}")


def argument(parameter):
    return f"{'ArgumentByChoice' if parameter.condition else 'Argument'}<{parameter.kind}>"


def choices(program):
    """The structure of the program's choices."""
    yield f"/// The choices of {program.name}."
    yield "struct Program {"
    for choice in program.choices:
        yield f"  {CHOICES[choice.type]} {choice.name} = {{}}; ///< {choice.doc}"
    effects = [choice.name for choice in program.choices if choice.is_effect]
    if effects:
        yield "\n  /// Calls Set(macro, choice) for each effect."
        yield "  template <typename Function> void forEachEffect(Function Set) {"
        yield from (f'    Set("{name}", {name});' for name in effects)
        yield "  }"
    yield "\n  operator ProgramSpec() const {"
    yield "    ChoiceDefines D;"
    for choice in program.choices:
        yield f'    D.{"require" if choice.is_required else "add"}("{choice.name}", {choice.name});'
    yield f'    return {{"{program.name}", D.take()}};\n  }}\n}};\n'


def launch(program, kernel):
    """The structure of the kernel's arguments."""
    if kernel.doc:
        yield f"/// {kernel.doc}"
    yield f"struct {kernel.name} {{"
    yield f'  static constexpr const char *ProgramFile = "{program.name}", *KernelName = "{kernel.name}";'
    for p in kernel.parameters:
        yield f"  {argument(p)} {p.name}" + (f" = {{}}; ///< with {p.condition}" if p.condition else ";")
    yield f"  auto arguments() const {{ return std::tie({', '.join(p.name for p in kernel.parameters)}); }}"
    yield "};\n"


def written(program):
    """The lines of the program's header."""
    yield f"// Generated from apps/splat/kernels/{program.name} by kernel_headers.py; do not edit."
    yield "#pragma once\n"
    yield '#include "device/Launch.h"\n#include "device/Program.h"'
    if any(not p.kind.startswith("cl") for kernel in program.kernels for p in kernel.parameters):
        yield '#include "picture/Layout.h"'
    yield "\n#include <optional>\n#include <tuple>\n"
    yield "// NOLINTBEGIN(readability-identifier-naming): the kernels' own names"
    yield f"namespace vorion::splat::kernels::{os.path.splitext(program.name)[0]} {{\n"
    yield from choices(program)
    for kernel in program.kernels:
        yield from launch(program, kernel)
    yield f"}} // namespace vorion::splat::kernels::{os.path.splitext(program.name)[0]}"
    yield "// NOLINTEND(readability-identifier-naming)"


def programs(files):
    return [Program(name, files) for name, file in sorted(files.items()) if name.endswith(".cl") and file.kernels]


def headers(texts):
    """The text of each header by its name, from the texts of the kernel files by theirs."""
    files = {name: parsed(name, text) for name, text in texts.items()}
    check_choices(files)
    check_structures(files)
    return {program.name + ".h": "\n".join(written(program)) + "\n" for program in programs(files)}


def write_if_new(path, text):
    """Leaves a file alone that has the text already, so that nothing is compiled again for it."""
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            if file.read() == text:
                return
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def main():
    if len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    folder, *paths = sys.argv[1:]
    texts = {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            texts[os.path.basename(path)] = file.read()
    try:
        made = headers(texts)
    except KernelError as error:
        print(f"kernel_headers.py: error: {error}", file=sys.stderr)
        return 1
    os.makedirs(folder, exist_ok=True)
    for name, text in made.items():
        write_if_new(os.path.join(folder, name), text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
