/// Doubles in kernels beside math and arithmetic: conversions in all modes of
/// rounding, halves, constants, arguments, vectors and printf.

#include "TestDevice.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cfenv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

using vorion::test::TestDevice;

namespace {

constexpr double Infinity = std::numeric_limits<double>::infinity();

struct Mode {
  const char *Suffix;
  int Rounding;
};
constexpr Mode Modes[] = {{"_rte", FE_TONEAREST},
                          {"_rtz", FE_TOWARDZERO},
                          {"_rtp", FE_UPWARD},
                          {"_rtn", FE_DOWNWARD}};

/// \p X as a whole number of \p Units, rounded as the host is told.
double rounded(double X, int Rounding, double Unit = 1) {
  std::fesetround(Rounding);
  volatile const double Whole = std::nearbyint(X / Unit);
  std::fesetround(FE_TONEAREST);
  return Whole * Unit;
}

float toFloat(double X, int Rounding) {
  std::fesetround(Rounding);
  volatile const double In = X;
  volatile const auto Out = static_cast<float>(In);
  std::fesetround(FE_TONEAREST);
  return Out;
}

template <typename Whole> double toDouble(Whole X, int Rounding) {
  std::fesetround(Rounding);
  volatile const Whole In = X;
  volatile const auto Out = static_cast<double>(In);
  std::fesetround(FE_TONEAREST);
  return Out;
}

/// The value of the half that \p X becomes.
double toHalf(double X, int Rounding) {
  constexpr double Largest = 65504;
  if (std::isnan(X) || std::isinf(X) || X == 0)
    return X;
  const int Exponent = std::max(std::ilogb(X), -14);
  const double R = std::fabs(X) > 1e6
                       ? std::copysign(1e6, X)
                       : rounded(X, Rounding, std::ldexp(1.0, Exponent - 10));
  if (std::fabs(R) <= Largest)
    return R;
  const bool Away = Rounding == FE_TONEAREST ||
                    (Rounding == FE_UPWARD && X > 0) ||
                    (Rounding == FE_DOWNWARD && X < 0);
  return std::copysign(Away ? Infinity : Largest, X);
}

double fromHalf(uint16_t Bits) {
  const int Exponent = Bits >> 10 & 31, Fraction = Bits & 1023;
  const double Magnitude = Exponent == 31 ? (Fraction ? std::nan("") : Infinity)
                           : Exponent
                               ? std::ldexp(1024 + Fraction, Exponent - 25)
                               : std::ldexp(Fraction, -24);
  return Bits >> 15 ? -Magnitude : Magnitude;
}

/// Equal in all bits, or both NaN.
bool same(double A, double B) {
  return std::bit_cast<uint64_t>(A) == std::bit_cast<uint64_t>(B) ||
         (std::isnan(A) && std::isnan(B));
}

/// Ties, neighbours of ties, and any numbers, of all magnitudes that a target
/// has.
std::vector<double> doubles() {
  std::vector<double> Values = {
      0.0,      -0.0,     Infinity,   -Infinity,     std::nan(""),
      5e-324,   -5e-324,  1.7e308,    65519.999,     65520,
      65504,    -65535.5, 0x1p-24,    0x1.8p-25,     -0x1p-25,
      0x1p-149, 0x1p-150, 0x1.8p-149, 0x1.ffffffp127};
  for (const double Whole : {0.0, 1.0, 2.0, 254.0, 65534.0, 1e6})
    for (const double Part : {0.25, 0.5, 0.75})
      for (const double Sign : {1.0, -1.0}) {
        Values.push_back(Sign * (Whole + Part));
        Values.push_back(std::nextafter(Sign * (Whole + Part), 0));
        Values.push_back(std::nextafter(Sign * (Whole + Part), Sign * 1e9));
      }
  std::mt19937_64 Random(1);
  while (Values.size() < 512) {
    const double Fraction = 1 + static_cast<double>(Random() >> 11) * 0x1p-53;
    const int Exponent = static_cast<int>(Random() % 200) - 150;
    Values.push_back((Random() % 2 ? 1 : -1) * std::ldexp(Fraction, Exponent));
  }
  return Values;
}

class Doubles : public testing::Test {
protected:
  void SetUp() override { VORION_REQUIRE_DEVICE(Device); }

  /// Runs kernel f of \p Source on an item for each value of \p In.
  template <typename Out, typename In>
  std::vector<Out> run(const std::string &Source, const std::vector<In> &Values,
                       std::size_t OutsPerItem) const {
    const cl::Program Program = Device.build(Source);
    cl::Kernel Kernel(Program, "f");
    const cl::Buffer From = Device.upload(Values);
    const std::size_t Count = Values.size() * OutsPerItem;
    const cl::Buffer To(Device.context(), CL_MEM_READ_WRITE,
                        Count * sizeof(Out));
    Kernel.setArg(0, From);
    Kernel.setArg(1, To);
    Device.run(Kernel, Values.size(), 64);
    return Device.download<Out>(To, Count);
  }

  const TestDevice Device;
};

TEST_F(Doubles, BecomeWholeNumbersInEveryMode) {
  const std::vector<double> In = doubles();
  for (const Mode &M : Modes) {
    const std::string Suffix = M.Suffix;
    const auto Out = run<int64_t>(
        "kernel void f(global const double *in, global long *out) {\n"
        "  size_t i = get_global_id(0);\n  double x = in[i];\n"
        "  global long *o = out + 5 * i;\n"
        "  o[0] = convert_int_sat" +
            Suffix +
            "(x);\n"
            "  o[1] = convert_uchar_sat" +
            Suffix +
            "(x);\n"
            "  o[2] = convert_short_sat" +
            Suffix +
            "(x);\n"
            "  o[3] = convert_long_sat" +
            Suffix +
            "(x);\n"
            "  o[4] = convert_ulong_sat" +
            Suffix + "(x);\n}\n",
        In, 5);
    for (std::size_t I = 0; I < In.size(); ++I) {
      // A number without a value for NaN gives 0.
      const double Whole = std::isnan(In[I]) ? 0 : rounded(In[I], M.Rounding);
      const auto Saturated = [&](double Least, double Most) {
        return static_cast<int64_t>(std::clamp(Whole, Least, Most));
      };
      const int64_t *O = &Out[5 * I];
      EXPECT_EQ(O[0], Saturated(-0x1p31, 0x1p31 - 1)) << Suffix << In[I];
      EXPECT_EQ(O[1], Saturated(0, 255)) << Suffix << In[I];
      EXPECT_EQ(O[2], Saturated(-32768, 32767)) << Suffix << In[I];
      EXPECT_EQ(O[3], Whole >= 0x1p63    ? std::numeric_limits<int64_t>::max()
                      : Whole <= -0x1p63 ? std::numeric_limits<int64_t>::min()
                                         : static_cast<int64_t>(Whole))
          << Suffix << In[I];
      EXPECT_EQ(static_cast<uint64_t>(O[4]),
                Whole >= 0x1p64 ? std::numeric_limits<uint64_t>::max()
                : Whole <= 0    ? 0
                                : static_cast<uint64_t>(Whole))
          << Suffix << In[I];
    }
  }
}

TEST_F(Doubles, BecomeFloatsAndHalvesInEveryMode) {
  const std::vector<double> In = doubles();
  for (const Mode &M : Modes) {
    const std::string Suffix = M.Suffix;
    const auto Out = run<float>(
        "kernel void f(global const double *in, global float *out) {\n"
        "  size_t i = get_global_id(0);\n"
        "  out[2 * i] = convert_float" +
            Suffix +
            "(in[i]);\n"
            "  out[2 * i + 1] = 0;\n"
            "  vstore_half" +
            Suffix +
            "(in[i], 4 * i + 2, (global half *)out);\n"
            "}\n",
        In, 2);
    for (std::size_t I = 0; I < In.size(); ++I) {
      EXPECT_TRUE(same(Out[2 * I], toFloat(In[I], M.Rounding)))
          << Suffix << In[I] << " gave " << Out[2 * I];
      const auto Half =
          static_cast<uint16_t>(std::bit_cast<uint32_t>(Out[2 * I + 1]));
      EXPECT_TRUE(same(fromHalf(Half), toHalf(In[I], M.Rounding)))
          << Suffix << In[I] << " gave " << fromHalf(Half);
    }
  }
}

TEST_F(Doubles, ComeFromWholeNumbersInEveryMode) {
  std::vector<int64_t> In = {0, 1, -1, INT64_MAX, INT64_MIN};
  std::mt19937_64 Random(1);
  while (In.size() < 256)
    In.push_back(static_cast<int64_t>(Random()) >> Random() % 12);
  for (const Mode &M : Modes) {
    const std::string Suffix = M.Suffix;
    const auto Out = run<double>(
        "kernel void f(global const long *in, global double *out) {\n"
        "  size_t i = get_global_id(0);\n"
        "  out[3 * i] = convert_double" +
            Suffix +
            "(in[i]);\n"
            "  out[3 * i + 1] = convert_double" +
            Suffix +
            "((ulong)in[i]);\n"
            "  out[3 * i + 2] = convert_double" +
            Suffix + "((int)in[i]);\n}\n",
        In, 3);
    for (std::size_t I = 0; I < In.size(); ++I) {
      EXPECT_EQ(Out[3 * I], toDouble(In[I], M.Rounding)) << Suffix << In[I];
      EXPECT_EQ(Out[3 * I + 1],
                toDouble(static_cast<uint64_t>(In[I]), M.Rounding))
          << Suffix << In[I];
      EXPECT_EQ(Out[3 * I + 2], static_cast<int32_t>(In[I]));
    }
  }
}

/// Either zero would be allowed, but not another one for constants.
TEST_F(Doubles, ZerosHaveAnOrderForMinimaAndMaxima) {
  const cl::Program Program = Device.build(R"(
kernel void f(global const double *x, global double *out) {
  out[0] = fmin(x[0], x[1]);
  out[1] = fmin(x[1], x[0]);
  out[2] = fmax(x[0], x[1]);
  out[3] = fmax(x[1], x[0]);
  out[4] = fmin(0.0, -0.0);
  out[5] = fmax(-0.0, 0.0);
})");
  cl::Kernel Kernel(Program, "f");
  const cl::Buffer In = Device.upload(std::vector<double>{0.0, -0.0});
  const cl::Buffer Out = Device.upload(std::vector<double>(6));
  Kernel.setArg(0, In);
  Kernel.setArg(1, Out);
  Device.run(Kernel, 1, 1);
  const auto O = Device.download<double>(Out, 6);
  for (const std::size_t Least : {0, 1, 4})
    EXPECT_TRUE(std::signbit(O[Least])) << Least;
  for (const std::size_t Greatest : {2, 3, 5})
    EXPECT_FALSE(std::signbit(O[Greatest])) << Greatest;
}

TEST_F(Doubles, HaveConstantsArgumentsVectorsAndPrintf) {
  const cl::Program Program = Device.build(R"(
typedef struct { char c; double x; } part;
constant double table[2] = {M_PI, DBL_MAX};
kernel void f(global double *out, double a, double4 b, part p, local double *t,
              global const double *in) {
  out[0] = a + table[0] / M_SQRT2 + DBL_EPSILON;
  out[1] = as_double(as_ulong(a) ^ (1ul << 63));
  vstore3(shuffle(b, (ulong4)(3, 2, 1, 0)).xyz, 1, out + 1);
  out[7] = select(b, b.wzyx, (long4)(0, -1, 0, -1)).y;
  out[8] = p.x + p.c;
  out[9] = nan(5ul);
  event_t event = async_work_group_copy(t, in, 4, 0);
  wait_group_events(1, &event);
  out[10] = t[3];
  out[11] = isless(a, b.x) + 10 * all(isgreater(b, (double4)(-9)))
            + 100 * signbit(-a);
  int e;
  out[12] = frexp(a, &e);
  out[13] = e;
  out[14] = ilogb(DBL_MIN / 4) + nextafter(1.0, 2.0);
  out[15] = 0.1f;
  printf("%g %.17g %v4lf %v2lg\n", (float)a, a, b, b.xy);
})");
  struct Part {
    char C;
    double X;
  };
  const double A = -2.7182818284590452;
  const std::array<cl_double, 4> B = {1.5, -2, 1e30, 4};
  cl::Kernel Kernel(Program, "f");
  const cl::Buffer Out = Device.upload(std::vector<double>(16));
  const cl::Buffer In = Device.upload(std::vector<double>{1, 2, 3, 4.25});
  Kernel.setArg(0, Out);
  Kernel.setArg(1, A);
  Kernel.setArg(2, sizeof(B), B.data());
  Kernel.setArg(3, Part{2, 0.5});
  Kernel.setArg(4, cl::Local(32));
  Kernel.setArg(5, In);
  testing::internal::CaptureStdout();
  Device.run(Kernel, 1, 1);
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "-2.71828 -2.7182818284590451 1.500000,-2.000000,"
            "1000000000000000019884624838656.000000,"
            "4.000000 1.5,-2\n");
  const auto O = Device.download<double>(Out, 16);
  EXPECT_EQ(O[0], A + M_PI / M_SQRT2 + 0x1p-52);
  EXPECT_EQ(O[1], -A);
  EXPECT_EQ((std::vector<double>{O[4], O[5], O[6]}),
            (std::vector<double>{4, 1e30, -2}));
  EXPECT_EQ(O[7], 1e30);
  EXPECT_EQ(O[8], 2.5);
  EXPECT_EQ(std::bit_cast<uint64_t>(O[9]), 0x7ff8000000000005);
  EXPECT_EQ(O[10], 4.25);
  EXPECT_EQ(O[11], 11);
  EXPECT_EQ(O[12], std::ldexp(A, -2));
  EXPECT_EQ(O[13], 2);
  EXPECT_EQ(O[14], -1024 + std::nextafter(1.0, 2.0));
  EXPECT_EQ(O[15], double{0.1F});
}

} // namespace
