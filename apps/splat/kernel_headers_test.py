#!/usr/bin/env python3
"""Tests of kernel_headers.py: what it makes of signatures, and what it refuses."""

import unittest

from kernel_headers import KernelError, headers

LAYOUT = "typedef struct {\n  float a;\n} splat_rule;\n"


def header(text, **others):
    """The header of a program with that text."""
    files = {"layout.h": LAYOUT, "a.cl": text}
    files |= {name.replace("_cl", ".cl"): other for name, other in others.items()}
    return headers(files)["a.cl.h"]


def members(text, **others):
    """Of the launches, without the names that each has."""
    return [line.strip() for line in header(text, **others).split("\n") if "Argument" in line]


class Signatures(unittest.TestCase):
    def holds(self, parameters, *expected):
        self.assertEqual(members(f"__kernel void k({parameters}) {{}}"), list(expected))

    def test_pointers_are_buffers(self):
        self.holds("__global const float *in, global uint *out", "Argument<cl::Buffer> in;", "Argument<cl::Buffer> out;")
        self.holds("__constant const splat_rule *rules", "Argument<cl::Buffer> rules;")
        self.holds("const __global float4 *restrict in", "Argument<cl::Buffer> in;")
        self.holds("__global float* in", "Argument<cl::Buffer> in;")

    def test_local_pointers_are_sizes(self):
        self.holds("__local uint *words", "Argument<cl::LocalSpaceArg> words;")

    def test_numbers_and_vectors_keep_their_types(self):
        self.holds("uint n, const float f, float4 v, uchar2 c, long l", "Argument<cl_uint> n;", "Argument<cl_float> f;",
                   "Argument<cl_float4> v;", "Argument<cl_uchar2> c;", "Argument<cl_long> l;")

    def test_structures_are_those_of_the_host(self):
        self.holds("splat_rule rule", "Argument<splat_rule> rule;")
        self.assertIn('#include "picture/Layout.h"', header("__kernel void k(splat_rule rule) {}"))

    def test_a_conditional_parameter_is_optional(self):
        more = "// More.\n#pragma vorion choice flag MORE\n"
        for parameters in ("uint n\n#ifdef MORE\n, uint own /* plane */\n#endif\n",
                           "uint n,\n#if MORE\nuint own // plane\n#endif\n"):
            self.assertEqual(members(f"{more}__kernel void k({parameters}) {{}}"),
                             ["Argument<cl_uint> n;", "ArgumentByChoice<cl_uint> own = {}; ///< with MORE"])
        self.assertEqual(members(more + "__kernel void k(\n#if MORE\nuint own,\n#endif\nuint n) {}")[1],
                         "Argument<cl_uint> n;")

    def test_no_parameters(self):
        self.holds("void")
        self.holds("")

    def test_the_order_is_the_kernels(self):
        self.assertIn("std::tie(b, a)", header("__kernel void k(uint b, uint a) {}"))

    def test_attributes_and_comments_are_passed_over(self):
        text = ("// __kernel void not_this(uint n)\n#define TEXT \"// __kernel\"\n/* a\n__kernel */\n// All.\n__kernel "
                "__attribute__((reqd_work_group_size(16, 1, 1))) void\nk(uint n) {}")
        self.assertEqual(members(text), ["Argument<cl_uint> n;"])
        self.assertIn("/// All.\nstruct k {", header(text))

    def test_kernels_of_included_files_are_of_the_program(self):
        text = header('#include "b.cl"\n__kernel void k(uint n) {}', b_cl="__kernel void other(uint n) {}")
        self.assertIn('*ProgramFile = "a.cl", *KernelName = "other"', text)


CHOICE = "// What it does.\n#pragma vorion choice {}\n"
CODE = "__kernel void k(uint n) {{ n = {}; }}\n"


def declared(*types_and_names):
    return "".join(CHOICE.format(each) for each in types_and_names)


class Choices(unittest.TestCase):
    def test_each_type_is_a_member(self):
        text = header(declared("flag FAST", "uint SIDE", "optional float LIMIT", "effect USE_IT")
                      + CODE.format("FAST + SIDE + LIMIT + USE_IT"))
        for line in ("bool FAST = {}; ///< What it does.", "std::optional<cl_uint> SIDE = {};",
                     "std::optional<cl_float> LIMIT = {};", "std::optional<EffectSwitch> USE_IT = {};",
                     'D.require("SIDE", SIDE);', 'D.add("LIMIT", LIMIT);', 'Set("USE_IT", USE_IT);'):
            self.assertIn(line, text)

    def test_a_program_takes_those_of_what_it_includes(self):
        shared = declared("uint SIDE") + "#define AREA (SIDE * SIDE)\n"
        text = header('#include "b.cl"\n' + CODE.format("AREA"), b_cl=shared)
        self.assertIn("std::optional<cl_uint> SIDE", text)
        self.assertEqual(text.count("///< What it does."), 1)

    def test_two_files_may_declare_the_same(self):
        text = header(declared("uint SIDE") + '#include "b.cl"\n' + CODE.format("SIDE"),
                      b_cl=declared("uint SIDE") + "#define AREA (SIDE * SIDE)\n")
        self.assertEqual(text.count("std::optional<cl_uint> SIDE"), 1)

    def test_a_file_that_declares_is_used_by_what_includes_it(self):
        header('#include "b.cl"\n' + CODE.format("SIDE"), b_cl=declared("uint SIDE"))

    def test_a_default_is_of_the_file(self):
        header(declared("optional uint SIDE") + "#ifndef SIDE\n#define SIDE 4\n#endif\n" + CODE.format("SIDE"))


class Errors(unittest.TestCase):
    def refuses(self, text, *words, **others):
        with self.assertRaises(KernelError) as caught:
            header(text, **others)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_types_that_no_host_passes(self):
        for kind in ("bool", "size_t", "half", "image2d_t", "event_t"):
            self.refuses(f"\n__kernel void k({kind} n) {{}}", "a.cl:2: ", kind)
        self.refuses("\n__kernel void k(unknown n) {}", "a.cl:2: kernel k takes a unknown", "layout.h")

    def test_pointers_without_an_address_space(self):
        self.refuses("__kernel void k(float *p) {}", "__global")
        self.refuses("__kernel void k(SPACE float *p) {}", "SPACE")
        self.refuses("__kernel void k(__global float **p) {}", "* * p")

    def test_what_is_no_parameter(self):
        self.refuses("__kernel void k(uint) {}", "a name")
        self.refuses("__kernel void k(unsigned int n) {}", "unsigned int n")
        self.refuses("__kernel void k(uint n[4]) {}", "n [ 4 ]")
        self.refuses("__kernel void k(uint n, ) {}", "','")
        self.refuses("__kernel void k(uint n", "the file ends")
        self.refuses("__kernel int k(uint n) {}", "expected 'void'")
        self.refuses("__kernel void k(uint new) {}", "keyword")

    def test_conditions_that_it_does_not_know(self):
        self.refuses("__kernel void k(\n#if A > 1\nuint n\n#endif\n) {}", "#if A > 1")
        self.refuses("__kernel void k(\n#ifdef A\nuint n\n#else\nint n\n#endif\n) {}", "#else")
        self.refuses("__kernel void k(\n#ifdef A\nuint n) {}\n#endif\n", "expected #endif")

    def test_two_kernels_of_one_name(self):
        self.refuses('#include "b.cl"\n__kernel void k() {}', "two kernels k", b_cl="__kernel void k() {}")

    def test_a_file_that_is_missing(self):
        self.refuses('#include "c.cl"\n__kernel void k() {}', "c.cl")

    def test_choices_that_are_not_declared(self):
        self.refuses("\n" + CODE.format("SIDE"), "a.cl:2: SIDE is no known macro")
        self.refuses("#ifdef FAST\n#endif\n" + CODE.format(0), "a.cl:1: FAST")
        self.refuses(CODE.format("SIDE"), "SIDE is not declared here", "#include of b.cl",
                     b_cl=declared("uint SIDE") + "#define AREA (SIDE * SIDE)\n")

    def test_choices_that_are_not_used(self):
        self.refuses(declared("flag FAST") + CODE.format("0 /* FAST */"), "a.cl:2: choice FAST is not used")
        # Of a file that nobody here includes.
        self.refuses(CODE.format(0), "b.cl:2: choice FAST is not used", b_cl=declared("flag FAST"))

    def test_declarations_that_disagree(self):
        self.refuses(declared("uint SIDE") + '#include "b.cl"\n' + CODE.format("SIDE"), "declared unlike that of",
                     b_cl=declared("float SIDE") + "#define AREA (SIDE * SIDE)\n")

    def test_what_is_no_declaration(self):
        for declaration in ("int SIDE", "uint side", "uint", "uint SIDE, OTHER"):
            self.refuses(declared(declaration) + CODE.format(0), "a.cl:2: ", "TYPE NAME")
        self.refuses("#pragma vorion chioce flag FAST\n" + CODE.format("FAST"), "a.cl:1: ", "TYPE NAME")
        self.refuses("#pragma vorion choice flag FAST\n" + CODE.format("FAST"), "no comment")
        self.refuses("int a;\n" + declared("flag FAST") + CODE.format("FAST"), "below code")
        self.refuses(declared("flag FAST", "flag FAST") + CODE.format("FAST"), "declared twice")


if __name__ == "__main__":
    unittest.main()
