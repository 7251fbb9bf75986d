/// Wrong results that LLVM and PoCL have corrected since the versions that we
/// build on, each as a kernel with a known result
/// (docs/tables/compiler-fixes.md). Values come from memory, so that nothing is
/// folded before the pass in question.

#include "TestDevice.h"

#include <ostream>
#include <string>
#include <vector>

namespace {

struct Fix {
  const char *Name, *Source;
  std::vector<int> Given, Expected;
  std::size_t Items = 1; ///< in one group
  const char *Options = "";
};

void PrintTo(const Fix &F, std::ostream *Out) { *Out << F.Name; }

const Fix Fixes[] = {
    {"Llvm140481ProductOfProducts",
     R"(
kernel void f(global int *io) {
  int a = io[0], b = -5001001 * a + 5001000;
  while (b >= 5001001)
    b = a + 5001000;
  int c = -5001000 * b - 5001001;
  io[1] = b;
  io[2] = c;
  io[0] = 5001000 * c >= b;
})",
     {1, 9, 9},
     {0, -1, -1}},
    {"Llvm126012ValueOfTheLastRound",
     R"(
kernel void f(global int *io) {
  int last = 1, count = 0;
  for (int i = 0; i != io[0]; ++i) {
    int next = 0;
    if (i != 0)
      next = last > 0 ? count + 1 : 0;
    count = next;
    last = i;
  }
  io[1] = count;
})",
     {12, 0},
     {12, 10}},
    {"Llvm123550RemainderOfTheFirstRound",
     R"(
kernel void f(global int *io) {
  int by = io[0], i = 1, rest;
  do {
    rest = 829259141 % by;
    by = -(int)((uchar)io[1] % (uchar)i);
    ++i;
  } while (by);
  io[2] = rest;
})",
     {-177, 171, 0},
     {-177, 171, 829259141 % 177}},
    {"Llvm142286SwitchInALoop",
     R"(
kernel void f(global int *io) {
  char state = -71;
again:
  switch (state) {
  case 0:
  case 1:
    goto again;
  case 2:
    state = 0;
    goto again;
  }
  io[0] = 7;
})",
     {0},
     {7}},
    {"Llvm115149WalkOverALocalArray",
     R"(
int endsAtOnce(private const char *text, int from) {
  private const char *at = text + from;
  for (; *at && *at <= ' '; ++at)
    ;
  return !*at;
}
kernel void f(global int *io) {
  const char letter = io[0], offset = io[1];
  const char text[3] = {letter, letter, letter};
  io[2] = endsAtOnce(text, (char)(offset + 1));
})",
     {0, -1, 5},
     {0, -1, 1}},
    {"Llvm126974MaximumAsABound",
     R"(
kernel void f(global int *io) {
  const uchar least = io[0];
  int sum = 0;
  for (int i = 0; i < (char)least + 3; i = 4)
    for (short j = max(181, (int)least) - 179; j < 9; j = io[1])
      sum += j + 1;
  io[2] = sum;
})",
     {0, 1000, 0},
     {0, 1000, 3}},
    {"Llvm132071StepFromMemory",
     R"(
kernel void f(global int *io) {
  short low[12], less[12];
  long from[12], sum = 0;
  for (int i = 0; i < 12; ++i)
    from[i] = i < 2 ? 6 : 0;
  for (short i = 0; i < 12; i += io[1] - 31553) {
    low[i] = from[i];
    less[i] = io[0] > from[i];
  }
  for (int i = 0; i < 12; ++i)
    sum += low[i];
  for (int i = 0; i < 2; ++i)
    sum += less[i];
  io[2] = (int)sum;
  io[3] = (int)(sum >> 32);
})",
     {0, 31554, 9, 9},
     {0, 31554, 12, 0}},
    {"Llvm159152NegativeAsUnsigned",
     R"(
kernel void f(global int *io) {
  char from[25];
  uint to[25];
  ulong sum = 0;
  for (int i = 0; i < 25; ++i)
    from[i] = io[0];
  for (short i = 0; i < 25; ++i)
    for (int j = 0; j < 25; ++j)
      to[j] = -(from[i] ? from[j] : 0);
  for (int i = 0; i < 25; ++i)
    sum ^= (ulong)to[i] + 9 + sum;
  io[1] = (int)sum;
  io[2] = (int)(sum >> 32);
})",
     {90, 0, 0},
     {90, 81, 16777215}},
    {"Llvm133943SelectBesideADivision",
     R"(
kernel void f(global int *io) {
  int number[18];
  char text[18];
  bool least = 0;
  for (int i = 0; i < 18; ++i)
    text[i] = number[i] = 7;
  for (int i = 0; i < io[0] + 18; i += 4) {
    const int is = (bool)(number[i] ? text[i] : io[1] / number[i]);
    least = least < is ? least : is;
  }
  io[2] = least;
})",
     {0, 0, 5},
     {0, 0, 0}},
    {"Llvm121583OrOfDisjointBits",
     R"(
kernel void f(global int *io) {
  const int x = io[0], y = io[1], c = io[2];
  io[3] = (x ^ y) == c ? x & y : (x | y) & ~c;
  const int high = x & 0xf0, low = y & 0x0f;
  io[4] = (high ^ low) == c ? high & low : (high | low) & ~c;
})",
     {15, 15, 0, 9, 9},
     {15, 15, 0, 15, 15}},
    {"Llvm90380ByteThatOverflows",
     R"(
kernel void f(global int *io) {
  uchar a = io[0];
  a |= (uchar)io[1];
  const uchar b = io[2] - 1;
  if (a == 0 ? b : b % a)
    ++a;
  io[3] = a;
})",
     {55, 223, 0, 0},
     {55, 223, 0, 255}},
    {"Pocl1747BarrierBehindACondition",
     R"(
kernel void f(global int *io) {
  const uint i = get_local_id(0);
  if (i < io[8]) {
    barrier(CLK_GLOBAL_MEM_FENCE);
    io[i] = io[7 - i] + 1;
    barrier(CLK_GLOBAL_MEM_FENCE);
  }
})",
     {5, 5, 5, 5, 7, 7, 7, 7, 4},
     {8, 8, 8, 8, 7, 7, 7, 7, 4},
     4},
    {"Pocl1711ExitThatIsNotReached",
     R"(
kernel void f(global int *io) {
  local int shared[32];
  const int i = get_local_id(0);
  shared[i] = io[i];
  barrier(CLK_LOCAL_MEM_FENCE);
  for (int round = 0; round < 4; ++round) {
    if (shared[(i + round) % 4] > 100)
      __builtin_unreachable();
    barrier(CLK_LOCAL_MEM_FENCE);
    shared[i] += 1;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  io[i] = shared[i];
})",
     {0, 1, 2, 3},
     {4, 5, 6, 7},
     4},
    {"Pocl1865DimensionsThatAreNotThere",
     R"(
kernel void f(global int *io) {
  const uint d = io[0];
  io[1] = get_global_size(d) * 1000 + get_local_size(d) * 100 +
          get_num_groups(d) * 10 + get_enqueued_local_size(d);
  io[2] = get_global_id(d) + get_local_id(d) + get_group_id(d) +
          get_global_offset(d);
})",
     {3, 9, 9},
     {3, 1111, 0},
     1,
     "-cl-std=CL3.0"},
    {"PoclWorkGroupAllOfOtherValuesThanOne",
     R"(
kernel void f(global int *io) {
  const int i = get_local_id(0), value = io[i];
  const int all = work_group_all(value) != 0;
  const int any = work_group_any(value) != 0;
  const int odd = work_group_any(value & 1) != 0;
  barrier(CLK_GLOBAL_MEM_FENCE);
  io[i] = all * 100 + any * 10 + odd;
})",
     {2, 4, 6, 8},
     {110, 110, 110, 110},
     4,
     "-cl-std=CL3.0"},
    {"PoclRelationsOfHalvesAreOne",
     R"(
#pragma OPENCL EXTENSION cl_khr_fp16 : enable
kernel void f(global int *io) {
  const half a = io[0], b = io[1], zero = io[2];
  io[3] = isequal(a, a) + isless(a, b) * 10 + isordered(a, b) * 100 +
          isfinite(a) * 1000 + signbit(-a) * 10000;
  io[4] = isnan(zero / zero) + isinf(b / zero) * 10 + isnormal(a) * 100 +
          islessgreater(a, b) * 1000 + isnotequal(a, b) * 10000;
  const short2 pair = isequal((half2)(a, b), (half2)(a, a));
  io[5] = pair.x * 10 + pair.y;
})",
     {1, 2, 0, 9, 9, 9},
     {1, 2, 0, 11111, 11111, -10}},
    {"PoclFractOfHalvesIsBelowOne",
     R"(
#pragma OPENCL EXTENSION cl_khr_fp16 : enable
kernel void f(global int *io) {
  half whole;
  io[1] = as_ushort(fract(as_half((ushort)io[0]), &whole));
  io[2] = as_ushort(whole);
})",
     {0x8001, 9, 9}, // the negative number next to 0
     {0x8001, 0x3bff, 0xbc00}},
};

class CompilerFixes : public testing::TestWithParam<Fix> {};

TEST_P(CompilerFixes, GiveTheResult) {
  const vorion::test::TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const Fix &F = GetParam();
  cl::Kernel Kernel(Device.build(F.Source, F.Options), "f");
  const cl::Buffer Values = Device.upload(F.Given);
  Kernel.setArg(0, Values);
  Device.run(Kernel, F.Items, F.Items);
  EXPECT_EQ(Device.download<int>(Values, F.Given.size()), F.Expected);
}

INSTANTIATE_TEST_SUITE_P(Known, CompilerFixes, testing::ValuesIn(Fixes),
                         [](const auto &Info) { return Info.param.Name; });

} // namespace
