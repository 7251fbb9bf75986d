/// The device's math functions against MPFR, in units of the last place:
/// scalars and vectors of half, float and double, within the limits of OpenCL
/// C.
///
///     opencl_math_test [--samples=N] [--table]
///
/// --table prints the table of docs/math.md.

#include "../TestDevice.h"
#include "Arguments.h"
#include "Functions.h"
#include "Ulp.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <type_traits>
#include <vector>

namespace vorion::test {

/// What GoogleTest shows for a parameter.
[[maybe_unused]] void PrintTo(const MathFunction &F, std::ostream *Stream) {
  *Stream << F.Expression;
}

} // namespace vorion::test

namespace {

using namespace vorion::test;

std::size_t Samples = 2048;

/// What a program with all functions is written with.
template <typename Real> struct Spelled;
template <> struct Spelled<_Float16> {
  static constexpr const char *Name = "half";
};
template <> struct Spelled<float> {
  static constexpr const char *Name = "float";
};
template <> struct Spelled<double> {
  static constexpr const char *Name = "double";
};

template <typename Real> std::vector<MathFunction> functionsOf() {
  std::vector<MathFunction> All(mathFunctions().begin(), mathFunctions().end());
  if constexpr (std::is_same_v<Real, float>)
    All.insert(All.end(), floatFunctions().begin(), floatFunctions().end());
  return All;
}

/// Vectors have code of their own in the library; one width stands for all.
constexpr unsigned Width = 4;

/// One program with two kernels an expression: scalar<N> and vector<N>, N the
/// expression's number. Built once.
template <typename Real> class MathProgram {
public:
  static MathProgram &get() {
    static MathProgram TheProgram;
    return TheProgram;
  }

  std::vector<Real> run(const MathFunction &F, const char *Kind,
                        const std::vector<std::vector<Real>> &Arguments) {
    const std::size_t Count = Arguments[0].size();
    cl::Kernel Kernel(Program,
                      (Kind + std::to_string(Numbers[F.Expression])).c_str());
    std::vector<cl::Buffer>
        Buffers; // a kernel's argument is not kept alive by it
    cl_uint Next = 0;
    for (const auto &Values : Arguments) {
      Buffers.push_back(Device.upload(Values));
      Kernel.setArg(Next++, Buffers.back());
    }
    const cl::Buffer Out(Device.context(), CL_MEM_WRITE_ONLY,
                         sizeof(Real) * Count);
    Kernel.setArg(Next, Out);
    Device.run(Kernel, Kind[0] == 'v' ? Count / Width : Count, 64);
    return Device.download<Real>(Out, Count);
  }

  TestDevice Device;

private:
  MathProgram() {
    if (!Device.usable())
      return;
    const std::string Name = Spelled<Real>::Name, Wide = std::to_string(Width);
    std::string Scalars = "#pragma OPENCL EXTENSION cl_khr_fp16 : enable\n"
                          "#define real " +
                          Name +
                          "\n#define WHOLE convert_int\n#define REAL(c) "
                          "((real)(c))\n";
    std::string Vectors = "#undef WHOLE\n#define WHOLE convert_int" + Wide +
                          "\n#undef REAL\n#define REAL(c) ((" + Name + Wide +
                          ")(c))\n";
    for (const MathFunction &F : functionsOf<Real>()) {
      if (!Numbers.emplace(F.Expression, Numbers.size()).second)
        continue;
      const std::string Head =
          std::to_string(Numbers[F.Expression]) +
          "(global const real *a, global const real *b, global const real *c, "
          "global real *out) {\n  size_t i = get_global_id(0);\n";
      Scalars += "kernel void scalar" + Head +
                 "  real x = a[i], y = b[i], z = c[i], ignored;\n  out[i] = " +
                 F.Expression + ";\n}\n";
      Vectors += "kernel void vector" + Head + "  " + Name + Wide +
                 " x = vload4(i, a), y = vload4(i, b), z = vload4(i, c), "
                 "ignored;\n  vstore4(" +
                 F.Expression + ", i, out);\n}\n";
    }
    Program = Device.build(Scalars + Vectors);
  }

  cl::Program Program;
  std::map<std::string, std::size_t> Numbers; ///< by expression
};

/// The worst errors, for the table.
struct Row {
  double Half = 0, Single = 0, Double = 0;
};
std::map<std::string, Row> Worst;

template <typename Real> double &worstOf(const MathFunction &F) {
  Row &R = Worst[F.Name];
  if constexpr (sizeof(Real) == sizeof(_Float16))
    return R.Half;
  else
    return sizeof(Real) == sizeof(double) ? R.Double : R.Single;
}

template <typename Real> void measure(const MathFunction &F, double Limit) {
  MathProgram<Real> &Program = MathProgram<Real>::get();
  VORION_REQUIRE_DEVICE(Program.Device);
  const auto Arguments = argumentsOf<Real>(F, Samples);
  const std::vector<Real> Results[] = {Program.run(F, "scalar", Arguments),
                                       Program.run(F, "vector", Arguments)};
  double Most = 0;
  std::string Where;
  for (std::size_t I = 0; I < Samples; ++I) {
    Number X(Arguments[0][I]), Y(Arguments[1][I]), Z(Arguments[2][I]), Exact;
    F.Exact(Exact.get(), X.get(), Y.get(), Z.get());
    for (const auto &Of : Results) {
      const double Error = ulpError(Of[I], Exact.get());
      if (Error <= Most)
        continue;
      Most = Error;
      char Text[256];
      std::snprintf(Text, sizeof(Text), "%s of %a, %a, %a gave %a, not %a",
                    &Of == Results ? "scalar" : "vector",
                    double(Arguments[0][I]), double(Arguments[1][I]),
                    double(Arguments[2][I]), double(Of[I]),
                    mpfr_get_d(Exact.get(), MPFR_RNDN));
      Where = Text;
    }
  }
  worstOf<Real>(F) = std::max(worstOf<Real>(F), Most);
  EXPECT_LE(Most, Limit) << F.Expression << ": " << Where;
}

class MathAccuracy : public testing::TestWithParam<MathFunction> {};

TEST_P(MathAccuracy, HalfStaysWithinTheLimit) {
  measure<_Float16>(GetParam(), GetParam().HalfLimit);
}

TEST_P(MathAccuracy, SingleStaysWithinTheLimit) {
  measure<float>(GetParam(), GetParam().SingleLimit);
}

TEST_P(MathAccuracy, DoubleStaysWithinTheLimit) {
  measure<double>(GetParam(), GetParam().DoubleLimit);
}

std::string nameOf(const testing::TestParamInfo<MathFunction> &Info) {
  std::string Name;
  for (const char *C = Info.param.Expression; *C && *C != '('; ++C)
    if (std::isalnum(*C))
      Name += *C;
  return Name + "_" + std::to_string(Info.index);
}

INSTANTIATE_TEST_SUITE_P(Functions, MathAccuracy,
                         testing::ValuesIn(mathFunctions().begin(),
                                           mathFunctions().end()),
                         nameOf);

class FloatAccuracy : public testing::TestWithParam<MathFunction> {};

TEST_P(FloatAccuracy, StaysWithinTheLimit) {
  measure<float>(GetParam(), GetParam().SingleLimit);
}

INSTANTIATE_TEST_SUITE_P(Functions, FloatAccuracy,
                         testing::ValuesIn(floatFunctions().begin(),
                                           floatFunctions().end()),
                         nameOf);

void printTable() {
  const auto Text = [](double Limit) {
    char Digits[32];
    std::snprintf(Digits, sizeof(Digits), "%g", Limit);
    return std::isinf(Limit) ? std::string("none") : std::string(Digits);
  };
  std::printf("| function | fp16 | limit | fp32 | limit | fp64 | limit |\n"
              "|---|--:|--:|--:|--:|--:|--:|\n");
  const char *Last = "";
  for (const MathFunction &F : mathFunctions()) {
    if (std::strcmp(Last, F.Name) != 0)
      std::printf("| `%s` | %.2f | %s | %.2f | %s | %.2f | %s |\n", F.Name,
                  Worst[F.Name].Half, Text(F.HalfLimit).c_str(),
                  Worst[F.Name].Single, Text(F.SingleLimit).c_str(),
                  Worst[F.Name].Double, Text(F.DoubleLimit).c_str());
    Last = F.Name;
  }
  for (const MathFunction &F : floatFunctions())
    std::printf("| `%s` | | | %.2f | %s | | |\n", F.Name, Worst[F.Name].Single,
                Text(F.SingleLimit).c_str());
}

} // namespace

int main(int Argc, char **Argv) {
  testing::InitGoogleTest(&Argc, Argv);
  bool Table = false;
  for (int I = 1; I < Argc; ++I) {
    const std::string Option = Argv[I];
    if (Option == "--table")
      Table = true;
    else if (Option.starts_with("--samples="))
      Samples = (std::stoul(Option.substr(10)) + 255) / 256 * 256;
  }
  const int Code = RUN_ALL_TESTS();
  if (Table)
    printTable();
  return Code;
}
