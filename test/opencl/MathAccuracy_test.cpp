/// The device's math functions against the host's doubles, in units of the last
/// place, within the limits of the OpenCL C specification ("Relative error as
/// ULPs", full profile, single precision).
///
/// glibc's double functions err by at most a few of a double's own units, 2^-29
/// of a float's, so they stand for the exact value.

#include "TestDevice.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <vector>

namespace {

/// How arguments are drawn.
enum class Range {
  Any,       ///< any bit pattern
  Moderate,  ///< magnitudes from 2^-30 to 2^7
  Unit,      ///< [-1, 1]
  Positive,  ///< any positive number
  AboveOne,  ///< 1 to 2^60
  SmallInts, ///< whole numbers, magnitude up to 60
};

struct Function {
  const char *Name;       ///< of the test
  const char *Expression; ///< OpenCL C, of float x, y, z
  double (*Exact)(double, double, double);
  double Limit; ///< ulp; 0: correctly rounded
  Range X = Range::Any, Y = Range::Any;
};

/// What GoogleTest shows for a parameter.
[[maybe_unused]] void PrintTo(const Function &F, std::ostream *Stream) {
  *Stream << F.Expression;
}

double powExact(double X, double Y, double) { return std::pow(X, Y); }
double rootn(double X, double N, double) {
  // Odd roots of negative numbers exist.
  const bool Odd = std::fmod(N, 2) != 0;
  return X < 0 && Odd ? -std::pow(-X, 1 / N) : std::pow(X, 1 / N);
}
/// sin(pi x): reduced to [0, 1/2] exactly before it is multiplied by pi.
double sinpi(double X, double, double) {
  double R = std::fmod(std::fabs(X), 2);
  double Sign = std::signbit(X) ? -1 : 1;
  if (R >= 1) {
    R -= 1;
    Sign = -Sign;
  }
  return Sign * std::sin(M_PI * (R > 0.5 ? 1 - R : R));
}
double cospi(double X, double, double) {
  const double R = std::fmod(std::fabs(X), 2);
  return std::sin(M_PI * (0.5 - (R > 1 ? 2 - R : R)));
}

#define EXACT(EXPRESSION)                                                      \
  [](double X, [[maybe_unused]] double Y, [[maybe_unused]] double Z) {         \
    return static_cast<double>(EXPRESSION);                                    \
  }

const Function Functions[] = {
    {"sin", "sin(x)", EXACT(std::sin(X)), 4},
    {"cos", "cos(x)", EXACT(std::cos(X)), 4},
    {"tan", "tan(x)", EXACT(std::tan(X)), 5},
    {"sinModerate", "sin(x)", EXACT(std::sin(X)), 4, Range::Moderate},
    {"cosModerate", "cos(x)", EXACT(std::cos(X)), 4, Range::Moderate},
    {"asin", "asin(x)", EXACT(std::asin(X)), 4, Range::Unit},
    {"acos", "acos(x)", EXACT(std::acos(X)), 4, Range::Unit},
    {"atan", "atan(x)", EXACT(std::atan(X)), 5},
    {"atan2", "atan2(x, y)", EXACT(std::atan2(X, Y)), 6},
    {"atan2Moderate", "atan2(x, y)", EXACT(std::atan2(X, Y)), 6,
     Range::Moderate, Range::Moderate},
    {"sinpi", "sinpi(x)", sinpi, 4, Range::Moderate},
    {"cospi", "cospi(x)", cospi, 4, Range::Moderate},
    {"sinh", "sinh(x)", EXACT(std::sinh(X)), 4, Range::Moderate},
    {"cosh", "cosh(x)", EXACT(std::cosh(X)), 4, Range::Moderate},
    {"tanh", "tanh(x)", EXACT(std::tanh(X)), 5},
    {"asinh", "asinh(x)", EXACT(std::asinh(X)), 4},
    {"acosh", "acosh(x)", EXACT(std::acosh(X)), 4, Range::AboveOne},
    {"atanh", "atanh(x)", EXACT(std::atanh(X)), 5, Range::Unit},
    {"exp", "exp(x)", EXACT(std::exp(X)), 3, Range::Moderate},
    {"expAny", "exp(x)", EXACT(std::exp(X)), 3},
    {"exp2", "exp2(x)", EXACT(std::exp2(X)), 3, Range::Moderate},
    {"exp10", "exp10(x)", EXACT(std::pow(10.0, X)), 3, Range::Moderate},
    {"expm1", "expm1(x)", EXACT(std::expm1(X)), 3, Range::Moderate},
    {"log", "log(x)", EXACT(std::log(X)), 3},
    {"log2", "log2(x)", EXACT(std::log2(X)), 3},
    {"log10", "log10(x)", EXACT(std::log10(X)), 3},
    {"log1p", "log1p(x)", EXACT(std::log1p(X)), 2},
    {"logNearOne", "log(1.0f + x * 0x1p-8f)",
     EXACT(
         std::log(static_cast<double>(1.0F + static_cast<float>(X) * 0x1p-8F))),
     3, Range::Unit},
    {"pow", "pow(x, y)", powExact, 16, Range::Any, Range::Moderate},
    {"powModerate", "pow(x, y)", powExact, 16, Range::Moderate,
     Range::Moderate},
    {"powr", "powr(x, y)", powExact, 16, Range::Positive, Range::Moderate},
    {"pown", "pown(x, (int)y)", powExact, 16, Range::Moderate,
     Range::SmallInts},
    {"rootn", "rootn(x, (int)y)", rootn, 16, Range::Moderate, Range::SmallInts},
    {"sqrt", "sqrt(x)", EXACT(std::sqrt(X)), 3},
    {"rsqrt", "rsqrt(x)", EXACT(1 / std::sqrt(X)), 2, Range::Positive},
    {"cbrt", "cbrt(x)", EXACT(std::cbrt(X)), 2},
    {"hypot", "hypot(x, y)", EXACT(std::hypot(X, Y)), 4},
    {"divide", "x / y", EXACT(X / Y), 2.5},
    {"fma", "fma(x, y, z)", nullptr, 0, Range::Moderate, Range::Moderate},
    {"fmod", "fmod(x, y)", EXACT(std::fmod(X, Y)), 0},
    {"remainder", "remainder(x, y)", EXACT(std::remainder(X, Y)), 0},
    {"floor", "floor(x)", EXACT(std::floor(X)), 0},
    {"ceil", "ceil(x)", EXACT(std::ceil(X)), 0},
    {"trunc", "trunc(x)", EXACT(std::trunc(X)), 0},
    {"round", "round(x)", EXACT(std::round(X)), 0},
    {"rint", "rint(x)", EXACT(std::rint(X)), 0},
    {"roundModerate", "round(x)", EXACT(std::round(X)), 0, Range::Moderate},
    {"rintModerate", "rint(x)", EXACT(std::rint(X)), 0, Range::Moderate},
    {"floorModerate", "floor(x)", EXACT(std::floor(X)), 0, Range::Moderate},
    {"fdim", "fdim(x, y)", EXACT(std::fdim(X, Y)), 0, Range::Moderate,
     Range::Moderate},
    {"ldexp", "ldexp(x, (int)y)", EXACT(std::ldexp(X, static_cast<int>(Y))), 0,
     Range::Any, Range::SmallInts},
    {"logb", "logb(x)", EXACT(std::logb(X)), 0, Range::Moderate},
    {"erf", "erf(x)", EXACT(std::erf(X)), 16},
    {"erfc", "erfc(x)", EXACT(std::erfc(X)), 16, Range::Moderate},
    {"tgamma", "tgamma(x)", EXACT(std::tgamma(X)), 16, Range::Moderate},
    // Where results are subnormal.
    {"tgammaBelow", "tgamma(-30.0f - fmod(fabs(x), 16.0f))",
     EXACT(std::tgamma(-30.0F -
                       std::fmod(std::fabs(static_cast<float>(X)), 16.0F))),
     16, Range::Moderate},
    {"nativeSqrt", "native_sqrt(fabs(x))", EXACT(std::sqrt(std::fabs(X))), 8192,
     Range::Moderate},
};

/// Distance of \p Got from \p Exact in units of the last place of a float at
/// Exact; subnormal results keep the smallest normal's unit.
double ulpError(float Got, double Exact) {
  if (std::isnan(Exact))
    return std::isnan(Got) ? 0 : std::numeric_limits<double>::infinity();
  if (std::isnan(Got))
    return std::numeric_limits<double>::infinity();
  // What rounds to infinity may also be the largest float or, where the limit
  // allows an error, infinity a little early.
  const double Largest = std::numeric_limits<float>::max();
  const double Value = std::isinf(Got) ? std::copysign(0x1p128, Got) : Got;
  const double Clamped = std::isinf(Exact) || std::fabs(Exact) > 0x1p128
                             ? std::copysign(0x1p128, Exact)
                             : Exact;
  const double Magnitude = std::min(std::fabs(Clamped), Largest);
  const int Exponent = Magnitude < 0x1p-126 ? -126 : std::ilogb(Magnitude);
  return std::fabs(Value - Clamped) / std::ldexp(1.0, Exponent - 23);
}

std::vector<float> draw(Range Wanted, std::size_t Count, unsigned Seed) {
  std::mt19937 Random(Seed);
  const auto Uniform = [&] { return static_cast<double>(Random()) / 0x1p32; };
  std::vector<float> Values;
  const float Infinity = std::numeric_limits<float>::infinity();
  if (Wanted == Range::Any)
    Values = {0.0F,
              -0.0F,
              1.0F,
              -1.0F,
              0.5F,
              2.0F,
              Infinity,
              -Infinity,
              NAN,
              0x1p-149F,
              -0x1p-149F,
              0x1p-126F,
              0x1.fffffep127F,
              0x1p23F,
              8388609.0F,
              1.5F,
              -2.5F,
              16777216.0F,
              88.7F,
              -103.9F,
              3.14159274F,
              1.57079637F};
  while (Values.size() < Count) {
    const double Sign = Random() % 2 ? 1 : -1;
    switch (Wanted) {
    case Range::Any:
      Values.push_back(std::bit_cast<float>(static_cast<uint32_t>(Random())));
      break;
    case Range::Moderate:
      Values.push_back(
          static_cast<float>(Sign * std::exp2(37 * Uniform() - 30)));
      break;
    case Range::Unit:
      Values.push_back(static_cast<float>(Sign * Uniform()));
      break;
    case Range::Positive:
      Values.push_back(static_cast<float>(std::exp2(250 * Uniform() - 125)));
      break;
    case Range::AboveOne:
      Values.push_back(static_cast<float>(std::exp2(60 * Uniform())));
      break;
    case Range::SmallInts:
      Values.push_back(static_cast<float>(Sign * std::ceil(60 * Uniform())));
      break;
    }
  }
  return Values;
}

/// One program with a kernel a function, built once.
class MathProgram {
public:
  static MathProgram &get() {
    static MathProgram TheProgram;
    return TheProgram;
  }
  std::vector<float> run(const Function &F,
                         const std::vector<std::vector<float>> &Arguments) {
    const std::size_t Count = Arguments[0].size();
    cl::Kernel Kernel(Program, (std::string("k_") + F.Name).c_str());
    std::vector<cl::Buffer>
        Buffers; // a kernel's argument is not kept alive by it
    cl_uint Next = 0;
    for (const auto &Values : Arguments) {
      Buffers.push_back(Device.upload(Values));
      Kernel.setArg(Next++, Buffers.back());
    }
    const cl::Buffer Out(Device.context(), CL_MEM_WRITE_ONLY, 4 * Count);
    Kernel.setArg(Next, Out);
    Device.run(Kernel, Count, 64);
    return Device.download<float>(Out, Count);
  }
  vorion::test::TestDevice Device;
  std::string Log;

private:
  MathProgram() {
    if (!Device.usable())
      return;
    std::string Source;
    for (const Function &F : Functions)
      Source += std::string("kernel void k_") + F.Name +
                "(global const float *a, global const float *b,"
                " global const float *c, global float *out) {\n"
                "  size_t i = get_global_id(0);\n"
                "  float x = a[i], y = b[i], z = c[i];\n"
                "  out[i] = " +
                F.Expression + ";\n}\n";
    Program = Device.build(Source, Log);
  }
  cl::Program Program;
};

class MathAccuracy : public testing::TestWithParam<Function> {};

TEST_P(MathAccuracy, StaysWithinTheLimit) {
  const Function &F = GetParam();
  MathProgram &Program = MathProgram::get();
  VORION_REQUIRE_DEVICE(Program.Device);
  ASSERT_EQ(Program.Log, "");
  constexpr std::size_t Count = 4096;
  const std::vector<std::vector<float>> Arguments = {
      draw(F.X, Count, 1), draw(F.Y, Count, 2), draw(F.Y, Count, 3)};
  const std::vector<float> Results = Program.run(F, Arguments);
  double Worst = 0;
  std::size_t At = 0;
  for (std::size_t I = 0; I < Count; ++I) {
    const float X = Arguments[0][I], Y = Arguments[1][I], Z = Arguments[2][I];
    // A fused operation is compared in its own type: a double would round
    // twice.
    const double Exact = F.Exact ? F.Exact(X, Y, Z) : std::fma(X, Y, Z);
    const double Rounded = F.Limit == 0 ? static_cast<float>(Exact) : Exact;
    const double Error = ulpError(Results[I], Rounded);
    if (Error > Worst) {
      Worst = Error;
      At = I;
    }
  }
  RecordProperty("worst_ulp", std::to_string(Worst));
  EXPECT_LE(Worst, F.Limit)
      << F.Expression << " of " << Arguments[0][At] << ", " << Arguments[1][At]
      << ", " << Arguments[2][At] << " gave " << Results[At];
  std::printf("%-14s worst error %.3f ulp, limit %g\n", F.Name, Worst, F.Limit);
}

INSTANTIATE_TEST_SUITE_P(Functions, MathAccuracy, testing::ValuesIn(Functions),
                         [](const auto &Info) {
                           return std::string(Info.param.Name);
                         });

} // namespace
