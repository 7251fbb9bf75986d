/// The device's formatter, compiled for the host, against the host's snprintf.
/// What depends on the device's calling convention (vectors, unpromoted floats)
/// is tested on the simulator.
extern "C" {
#include "format_internal.h"
}

#include <bit>
#include <climits>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <rapidcheck/gtest.h>
#include <string>

static std::string Console;
extern "C" void vx_put_console(char C) { Console += C; }

namespace {

int formatInto(vx_text *Text, const char *Format, ...) {
  va_list Arguments;
  va_start(Arguments, Format);
  const int Result = vx_format(Text, VX_DIALECT_C, Format, Arguments);
  va_end(Arguments);
  return Result;
}

template <typename... Ts> std::string ours(const char *Format, Ts... Values) {
  std::string Buffer(6000, '?');
  vx_text Text{Buffer.data(), Buffer.data() + Buffer.size(), 0, 0};
  EXPECT_EQ(formatInto(&Text, Format, Values...), 0);
  return Buffer.substr(0, Text.count);
}

template <typename... Ts> std::string hosts(const char *Format, Ts... Values) {
  std::string Buffer(6000, '?');
  const int Size =
      std::snprintf(Buffer.data(), Buffer.size(), Format, Values...);
  return Buffer.substr(0, static_cast<std::size_t>(Size));
}

TEST(Format, TextAndPercent) { EXPECT_EQ(ours("a%%b"), "a%b"); }

TEST(Format, Integers) {
  for (const char *Format :
       {"%d",    "%5d",     "%-5d|",  "%05d",   "%+d",   "% d", "%.3d",
        "%8.3d", "%-8.3d|", "%08.3d", "%x",     "%#x",   "%X",  "%#X",
        "%o",    "%#o",     "%u",     "%.0d",   "%#.0o", "%hd", "%hhd",
        "%hhu",  "%hx",     "%i",     "%#010x", "%+05d"})
    for (const int Value :
         {0, 1, -1, 7, 42, 255, 65535, -40000, 2147483647, -2147483647 - 1})
      EXPECT_EQ(ours(Format, Value), hosts(Format, Value)) << Format;
}

TEST(Format, LongLong) {
  for (const char *Format : {"%lld", "%llu", "%llx", "%llo", "%30lld"})
    for (const long long Value :
         {0LL, 1LL << 62, -1LL, LLONG_MIN, LLONG_MAX, 1000000007LL * 998})
      EXPECT_EQ(ours(Format, Value), hosts(Format, Value)) << Format;
}

TEST(Format, StarsWidthsAndStrings) {
  EXPECT_EQ(ours("%*d|%-*d|%.*d", 5, 42, 6, -3, 4, 7),
            hosts("%*d|%-*d|%.*d", 5, 42, 6, -3, 4, 7));
  EXPECT_EQ(ours("%*d|", -5, 42), "42   |");
  EXPECT_EQ(ours("%.*d", -1, 42), "42");
  EXPECT_EQ(ours("%s|%5s|%-5s|%.2s|%c|%3c", "abc", "ab", "ab", "abc", 'x', 'y'),
            "abc|   ab|ab   |ab|x|  y");
  const char *Null = nullptr;
  EXPECT_EQ(ours("%s", Null), "(null)");
  EXPECT_EQ(ours("%p", reinterpret_cast<void *>(0xabcd)), "0xabcd");
}

constexpr const char *FloatFormats[] = {
    "%f",    "%.0f",   "%.3f",  "%12.2f", "%-12.2f|", "%012.2f", "%+f",
    "% f",   "%#.0f",  "%e",    "%.0e",   "%.10e",    "%#.0e",   "%15.3e",
    "%g",    "%.0g",   "%.10g", "%#g",    "%G",       "%E",      "%.17g",
    "%.40f", "%.300e", "%020g", "%+.3g"};
constexpr const char *HexFormats[] = {
    "%a", "%A", "%.0a", "%.3a", "%30.2a", "%-30a|", "%030a", "%.20a", "%#.3a"};

/// The host prints subnormals as 0x0.8p-1022, which C allows, and so is ours.
bool isSubnormal(double Value) {
  return std::fpclassify(Value) == FP_SUBNORMAL;
}

TEST(Format, Doubles) {
  for (const double Value : {0.0,
                             -0.0,
                             1.0,
                             -1.0,
                             0.5,
                             1.5,
                             2.5,
                             0.125,
                             9.5,
                             9.9999999,
                             99.95,
                             0.1,
                             1e-5,
                             1e-4,
                             123456.0,
                             1234567.0,
                             1e15,
                             1e22,
                             1e23,
                             1e100,
                             1.7976931348623157e308,
                             2.2250738585072014e-308,
                             4.9406564584124654e-324,
                             3.0e-310,
                             3.14159265358979,
                             65504.0,
                             0.000123456,
                             5e-1,
                             0.05,
                             1e9,
                             999999999.0,
                             1e-9,
                             1.0 / 3}) {
    for (const char *Format : FloatFormats)
      EXPECT_EQ(ours(Format, Value), hosts(Format, Value))
          << Format << " " << Value;
    for (const char *Format : HexFormats)
      if (!isSubnormal(Value))
        EXPECT_EQ(ours(Format, Value), hosts(Format, Value))
            << Format << " " << Value;
  }
}

TEST(Format, SixDigitsThatRoundUpToTheNextPower) {
  // Not compared: the host's %#g drops the zeros here.
  EXPECT_EQ(ours("%#g|%g", 999999.5, 999999.5), "1.00000e+06|1e+06");
}

TEST(Format, SubnormalsInHexadecimalRoundTrip) {
  for (const double Value : {4.9406564584124654e-324, 3.0e-310})
    EXPECT_EQ(std::strtod(ours("%a", Value).c_str(), nullptr), Value);
}

RC_GTEST_PROP(Format, AnyDoubleLikeTheHost, (uint64_t Bits)) {
  // Spread the generator's small numbers over all exponents.
  const double Value = std::bit_cast<double>(Bits * 0x9e3779b97f4a7c15U);
  RC_PRE(Value == Value);
  for (const char *Format : FloatFormats)
    RC_ASSERT(ours(Format, Value) == hosts(Format, Value));
  for (const char *Format : HexFormats)
    if (!isSubnormal(Value))
      RC_ASSERT(ours(Format, Value) == hosts(Format, Value));
}

/// The host's own conversion.
uint64_t doubleOfQuad(uint64_t Low, uint64_t High) {
  const uint64_t Parts[] = {Low, High};
  __extension__ __float128 Quad;
  std::memcpy(&Quad, Parts, sizeof(Quad));
  return std::bit_cast<uint64_t>(static_cast<double>(Quad));
}

RC_GTEST_PROP(Format, LongDoublesAreRoundedLikeTheHost,
              (uint64_t Low, uint64_t High)) {
  Low *= 0x9e3779b97f4a7c15U;
  High *= 0x9e3779b97f4a7c15U;
  // All exponents, and those of doubles, whose subnormal ones end at -1074.
  const uint64_t Exponent = 16383 - 1080 + High % 2110;
  const uint64_t Near = (High & ~(uint64_t{0x7fff} << 48)) | Exponent << 48;
  for (const uint64_t H : {High, Near})
    // The last bits decide on ties.
    for (const uint64_t L : {Low, Low & ~uint64_t{0} << 60, uint64_t{0}})
      if ((H >> 48 & 0x7fff) != 0x7fff)
        RC_ASSERT(vx_double_of_quad(L, H) == doubleOfQuad(L, H));
}

TEST(Format, LongDoublesAtTheLimits) {
  for (const uint64_t Exponent :
       {0, 1, 15308, 15309, 15310, 15311, 15360, 15361, 15362, 17406, 17407})
    for (const uint64_t Fraction :
         {0ULL, 1ULL, 0x800000000000ULL, 0xffffffffffffULL, 0xfffffffff000ULL})
      for (const uint64_t Low :
           {0ULL, 1ULL, 1ULL << 59, 1ULL << 60, 3ULL << 59, 3ULL << 60, ~0ULL})
        EXPECT_EQ(vx_double_of_quad(Low, Exponent << 48 | Fraction),
                  doubleOfQuad(Low, Exponent << 48 | Fraction))
            << Exponent << " " << Fraction << " " << Low;
  EXPECT_EQ(vx_double_of_quad(0, 0xffffULL << 48), 0xfffULL << 52);
  EXPECT_GT(vx_double_of_quad(1, 0x7fffULL << 48), 0x7ffULL << 52);
}

TEST(Format, InfinityAndNan) {
  const double Infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ours("%f|%F|%6.1e|%-6f|%06f|%+g", Infinity, -Infinity, Infinity,
                 Infinity, Infinity, Infinity),
            "inf|-INF|   inf|inf   |   inf|+inf");
  const double Nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(ours("%f|%F|%g", Nan, -Nan, -Nan), "nan|NAN|nan");
}

TEST(Format, WhatDoesNotFitIsCounted) {
  char Buffer[4] = {'?', '?', '?', '?'};
  vx_text Text{Buffer, Buffer + 3, 0, 0};
  EXPECT_EQ(formatInto(&Text, "%d!", 12345), 0);
  EXPECT_EQ(Text.count, 6u);
  EXPECT_EQ(std::string(Buffer, 4), "123?");
}

TEST(Format, TheConsoleTakesAll) {
  Console.clear();
  vx_text Text{nullptr, nullptr, 0, 1};
  EXPECT_EQ(formatInto(&Text, "%d!", 12345), 0);
  EXPECT_EQ(Console, "12345!");
  EXPECT_EQ(Text.count, 6u);
}

TEST(Format, MalformedConversionsEndTheText) {
  for (const char *Format : {"a%k", "a%", "a%n", "a%v4f", "a%5."}) {
    char Buffer[8];
    vx_text Text{Buffer, Buffer + sizeof(Buffer), 0, 0};
    EXPECT_EQ(formatInto(&Text, Format, 1), -1) << Format;
    EXPECT_EQ(Text.count, 1u) << Format;
  }
}

} // namespace
