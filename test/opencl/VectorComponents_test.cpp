/// Work-items that write different components of one vector in memory do not
/// disturb each other: clang loads the vector, changes a component and stores
/// the whole.

#include "TestDevice.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <tuple>

using vorion::test::TestDevice;

namespace {

constexpr uint32_t Items = 256;

/// A kernel's statements; `i` is the work-item, `v` its vector in `s`, of
/// components of so many bytes. Each leaves `i` in its own component.
struct Form {
  const char *Name, *Type;
  uint32_t Lanes, Bytes;
  const char *Body;
};

constexpr const char *BySwitch =
    "switch (i & 3) { case 0: s[v].x = i; break; case 1: s[v].y = i; break;"
    " case 2: s[v].z = i; break; default: s[v].w = i; }";

// clang-format off: a form a line
const Form Forms[] = {
  {"switch", "int4", 4, 4, BySwitch},
  {"if", "int4", 4, 4, "if ((i & 3) == 0) s[v].x = i; else if ((i & 3) == 1) s[v].y = i; else if ((i & 3) == 2) s[v].z = i; else s[v].w = i;"},
  {"two", "uint2", 2, 4, "if (i & 1) s[v].y = i; else s[v].x = i;"},
  {"any", "uint8", 8, 4, "s[v][i & 7] = i;"},
  {"added", "int4", 4, 4, "if (i & 1) { if (i & 2) s[v].w += i + 1; else s[v].y += i + 1; } else { if (i & 2) s[v].z += i + 1; else s[v].x += i + 1; }"},
  {"swizzle", "int4", 4, 4, "if (i & 2) { if (i & 1) s[v].wz = (int2)(i, i - 1); } else { if (i & 1) s[v].xy = (int2)(i - 1, i); }"},
  {"halves", "int4", 4, 4, "if (i & 2) { if (i & 1) s[v].hi = (int2)(i - 1, i); } else { if (i & 1) s[v].lo = (int2)(i - 1, i); }"},
  {"bytes", "uchar4", 4, 1, BySwitch},
  {"shorts", "short16", 16, 2, "switch (i & 3) { case 0: s[v][i & 15] = i; break; case 1: s[v].s159d = (short4)(v * 16 + 1, v * 16 + 5, v * 16 + 9, v * 16 + 13); break; case 2: s[v][i & 15] = i; break; default: s[v][i & 15] = i; }"},
  {"structure", "struct with", 4, 4, "switch (i & 3) { case 0: s[v].of.x = i; break; case 1: s[v].of.y = i; break; case 2: s[v].of.z = i; break; default: s[v].of.w = i; }"},
  {"volatile", "volatile int4", 4, 4, BySwitch},
  {"pointer", "int4", 4, 4, "set(&s[v], i);"},
};
// clang-format on

std::string sourceOf(const Form &F, const std::string &Space) {
  const auto Define = [](const std::string &Name, const std::string &Value) {
    return "#define " + Name + " " + Value + "\n";
  };
  const bool IsLocal = Space == "local";
  return Define("SPACE", Space) + Define("T", F.Type) +
         Define("LANES", std::to_string(F.Lanes)) +
         Define("ITEMS", std::to_string(Items)) + R"(
struct with { int4 of; };
static void set(SPACE int4 *s, int i) {
  switch (i & 3) {
  case 0: s->x = i; break;
  case 1: s->y = i; break;
  case 2: s->z = i; break;
  default: s->w = i;
  }
}
static void write(SPACE T *s, int i) {
  int v = i / LANES;
)" + F.Body +
         "\n}\n" +
         (IsLocal ? R"(
kernel void form(global T *r) {
  local T s[ITEMS / LANES];
  int i = get_local_id(0), n = get_local_size(0) / LANES;
  r += get_group_id(0) * n;
  if (i < n) s[i] = r[i];
  barrier(CLK_LOCAL_MEM_FENCE);
  write(s, i);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (i < n) r[i] = s[i];
})"
                  : "kernel void form(global T *s) {"
                    " write(s, get_global_id(0)); }");
}

class VectorComponents
    : public testing::TestWithParam<std::tuple<const char *, const char *>> {};

TEST_P(VectorComponents, AreWrittenByWorkItemsOfTheirOwn) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const auto &[Options, Space] = GetParam();
  const bool IsLocal = std::string(Space) == "local";
  for (const Form &F : Forms) {
    const cl::Program Program = Device.build(sourceOf(F, Space), Options);
    for (const uint32_t Size : {16U, 64U, 256U}) {
      // `added` adds to -1.
      const auto Buffer =
          Device.upload(std::vector<uint8_t>(size_t{Items} * F.Bytes, 0xFF));
      cl::Kernel Kernel(Program, "form");
      Kernel.setArg(0, Buffer);
      Device.run(Kernel, cl::NDRange(Items), cl::NDRange(Size));
      const auto Found =
          Device.download<uint8_t>(Buffer, size_t{Items} * F.Bytes);
      for (uint32_t I = 0; I != Items; ++I) {
        uint32_t Value = 0;
        std::memcpy(&Value, &Found[size_t{I} * F.Bytes], F.Bytes);
        ASSERT_EQ(Value, IsLocal ? I % Size : I)
            << F.Name << ", groups of " << Size << ", component " << I;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , VectorComponents,
    testing::Combine(testing::Values("", "-cl-opt-disable"),
                     testing::Values("global", "local")),
    [](const auto &Info) {
      return std::string(*std::get<0>(Info.param) ? "Plain" : "Optimised") +
             std::get<1>(Info.param);
    });

} // namespace
