/// Local variables that every work-item sets before it reads them are still the
/// group's: what one work-item writes, all read behind the next barrier. The
/// optimiser knows one work-item's run only, and a variable written there
/// before it is read looks private.

#include "TestDevice.h"

#include <cstdint>
#include <string>

using vorion::test::TestDevice;

namespace {

using Values = std::vector<uint32_t>;

constexpr uint32_t Groups = 3;

/// A kernel's declarations and statements; `l` is the work-item, `n` the size
/// of the group, `B` a barrier. Every work-item leaves Expected in `r`.
struct Form {
  const char *Name, *Locals, *Body;
  uint32_t Expected;
};

// clang-format off: a form a line
const Form Forms[] = {
  {"scalar", "uint s;", "s = 0; B; if (l == 7) s = 5; B; r = s;", 5},
  {"scalar_of_the_last", "uint s;", "s = 1; B; if (l == n - 1) s = n; B; r = s - n + 5;", 5},
  {"read_in_between", "uint s;", "s = 2; B; r = s; B; if (l == 3) s = 5; B; r = r * 10 + s;", 25},
  {"added_to", "uint s;", "s = 4; B; if (l == 0) s += 1; B; r = s;", 5},
  {"signed", "int s;", "s = -1; B; if (l == 1) s = -5; B; r = -s;", 5},
  {"byte", "uchar s;", "s = 0; B; if (l == 2) s = 255; B; r = s;", 255},
  {"half_word", "ushort s;", "s = 0; B; if (l == 2) s = 65535; B; r = s;", 65535},
  {"long", "ulong s;", "s = 0; B; if (l == 2) s = 1ul << 40; B; r = s >> 38;", 4},
  {"float", "float s;", "s = 0.5f; B; if (l == 9) s = 2.5f; B; r = (uint)(s * 2.0f);", 5},
  {"vector", "uint4 s;", "s = (uint4)(1); B; if (l == 9) s.z = 5; B; r = s.x + s.z;", 6},
  {"volatile", "volatile uint s;", "s = 0; B; if (l == 7) s = 5; B; r = s;", 5},
  {"flag_of_several", "uint s;", "s = 0; B; if (l & 1) s = 1; B; r = s;", 1},
  {"two", "uint s, t;", "s = 1; t = 2; B; if (l == 3) { s = 5; t = 6; } B; r = s * 10 + t;", 56},
  {"one_element", "uint s[1];", "s[0] = 0; B; if (l == 7) s[0] = 5; B; r = s[0];", 5},
  {"small_array", "uint s[3];", "s[0] = s[1] = s[2] = 1; B; if (l < 3) s[l] = l + 4; B; r = s[0] * 100 + s[1] * 10 + s[2];", 456},
  {"array_by_loop", "uint s[4];", "for (uint i = 0; i < 4; i++) s[i] = i; B; if (l == 5) s[2] = 9; B; r = s[2] * 10 + s[3];", 93},
  {"array_of_arrays", "uint s[2][2];", "s[0][0] = s[1][1] = 1; B; if (l == 5) s[1][1] = 4; B; r = s[0][0] + s[1][1];", 5},
  {"structure", "pair s;", "s.a = 1; s.b = 2; B; if (l == 4) s.b = 4; B; r = s.a + s.b;", 5},
  {"whole_structure", "pair s;", "pair p = {1, 2}; s = p; B; if (l == 4) { p.b = 4; s = p; } B; r = s.a + s.b;", 5},
  {"loop", "uint s;", "for (uint i = 0; i < 3; i++) { s = 0; B; if (l == i) s = 5 + i; B; r = r * 10 + s; B; }", 567},
  {"nested_loops", "uint s;", "for (uint i = 0; i < 2; i++) for (uint j = 0; j < 2; j++) { s = 1; B; if (l == i + j) s = 2 + i + j; B; r = r * 10 + s; B; }", 2334},
  {"conditional", "uint s;", "if (n > 1) { s = 0; B; if (l == 7) s = 5; B; r = s; }", 5},
  {"function", "uint s;", "r = told(&s, 7, 5);", 5},
  {"passed_on", "uint s;", "set(&s, 0); B; if (l == 7) set(&s, 5); B; r = s;", 5},
  {"chosen", "uint s, t;", "local uint *p = n & 1 ? &s : &t; *p = 0; B; if (l == 7) *p = 5; B; r = *p;", 5},
  {"pointer_in_local", "uint s; local uint *local p;", "p = &s; s = 0; B; if (l == 7) *p = 5; B; r = s;", 5},
};
// clang-format on

std::string sourceOf(const Form &F) {
  return std::string(R"(
#define B barrier(CLK_LOCAL_MEM_FENCE)
typedef struct { uint a, b; } pair;
static void set(local uint *p, uint v) { *p = v; }
static uint told(local uint *p, uint who, uint v) {
  *p = 0;
  B;
  if (get_local_id(0) == who) *p = v;
  B;
  return *p;
}
)") + "kernel void form_" +
         F.Name +
         "(global uint *out) {\n  uint l = get_local_id(0), n = "
         "get_local_size(0), r = 0;\n  local " +
         F.Locals + "\n  " + F.Body + "\n  out[get_global_id(0)] = r;\n}\n";
}

class LocalVariables : public testing::TestWithParam<uint32_t> {};

TEST_P(LocalVariables, BelongToTheGroup) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const uint32_t Items = Groups * GetParam();
  for (const Form &F : Forms) {
    SCOPED_TRACE(F.Name);
    const cl::Program Program = Device.build(sourceOf(F));
    cl::Kernel Kernel(Program, (std::string("form_") + F.Name).c_str());
    const cl::Buffer Out = Device.upload(Values(Items, ~0U));
    Kernel.setArg(0, Out);
    Device.run(Kernel, Items, GetParam());
    EXPECT_EQ(Device.download<uint32_t>(Out, Items), Values(Items, F.Expected));
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, LocalVariables, testing::Values(16U, 32U, 64U));

} // namespace
