/// What kernels need from libdevice beside math: 64-bit integers, half
/// precision in memory, and printf, with other operands in each lane.

#include "TestDevice.h"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

using vorion::test::TestDevice;

namespace {

constexpr std::size_t Count = 1000, Group = 50;

TEST(Builtins, SixtyFourBitIntegersAgreeWithTheHost) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void integers(global const long *a, global const long *b,
                     global long *out) {
  size_t i = get_global_id(0);
  long x = a[i], y = b[i];
  ulong ux = x, uy = y;
  global long *o = out + 12 * i;
  o[0] = x / y;
  o[1] = x % y;
  o[2] = ux / uy;
  o[3] = ux % uy;
  o[4] = x * y;
  o[5] = x << (y & 63);
  o[6] = x >> (y & 63);
  o[7] = ux >> (y & 63);
  o[8] = mul_hi(ux, uy);
  o[9] = clz(x) * 100 + popcount(y);
  o[10] = x > y ? as_int((float)x) : as_int((float)uy);
  o[11] = (long)((float)x * 0.5f);
})");

  // Any number of significant bits: division has paths for small operands.
  std::mt19937_64 Random(1);
  std::vector<int64_t> A(Count), B(Count);
  for (std::size_t I = 0; I < Count; ++I) {
    A[I] = static_cast<int64_t>(Random()) >> Random() % 64;
    do
      B[I] = static_cast<int64_t>(Random()) >> Random() % 64;
    while (B[I] == 0 || B[I] == -1); // no host division is defined there
  }
  cl::Kernel Kernel(Program, "integers");
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 96 * Count);
  // A kernel does not keep its arguments alive.
  const cl::Buffer InA = Device.upload(A), InB = Device.upload(B);
  Kernel.setArg(0, InA);
  Kernel.setArg(1, InB);
  Kernel.setArg(2, Out);
  Device.run(Kernel, Count, Group);
  const auto Results = Device.download<int64_t>(Out, 12 * Count);

  for (std::size_t I = 0; I < Count; ++I) {
    const int64_t X = A[I], Y = B[I];
    const auto UX = static_cast<uint64_t>(X), UY = static_cast<uint64_t>(Y);
    const unsigned Shift = Y & 63;
    const auto Chosen = X > Y ? static_cast<float>(X) : static_cast<float>(UY);
    const std::array<uint64_t, 12> Expected = {
        static_cast<uint64_t>(X / Y),
        static_cast<uint64_t>(X % Y),
        UX / UY,
        UX % UY,
        UX * UY,
        UX << Shift,
        static_cast<uint64_t>(X >> Shift),
        UX >> Shift,
        static_cast<uint64_t>(static_cast<unsigned __int128>(UX) * UY >> 64),
        static_cast<uint64_t>(std::countl_zero(UX) * 100 + std::popcount(UY)),
        static_cast<uint64_t>(int64_t{std::bit_cast<int32_t>(Chosen)}),
        static_cast<uint64_t>(
            static_cast<int64_t>(static_cast<float>(X) * 0.5F))};
    for (std::size_t K = 0; K < Expected.size(); ++K)
      EXPECT_EQ(static_cast<uint64_t>(Results[12 * I + K]), Expected[K])
          << "operation " << K << " of " << X << " and " << Y;
  }
}

TEST(Builtins, EveryHalfIsReadAndWrittenExactly) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void halves(global const half *in, global float *wide, global half *out) {
  size_t i = get_global_id(0);
  float x = vload_half(i, in);
  wide[i] = x;
  vstore_half(x, i, out);
})");
  std::vector<uint16_t> In(1 << 16);
  for (std::size_t I = 0; I < In.size(); ++I)
    In[I] = static_cast<uint16_t>(I);
  cl::Kernel Kernel(Program, "halves");
  const cl::Buffer Wide(Device.context(), CL_MEM_READ_WRITE, 4 * In.size());
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 2 * In.size());
  const cl::Buffer Narrow = Device.upload(In);
  Kernel.setArg(0, Narrow);
  Kernel.setArg(1, Wide);
  Kernel.setArg(2, Out);
  Device.run(Kernel, In.size(), 64);
  const auto Floats = Device.download<float>(Wide, In.size());
  const auto Halves = Device.download<uint16_t>(Out, In.size());
  for (std::size_t I = 0; I < In.size(); ++I) {
    const unsigned Exponent = I >> 10 & 31, Fraction = I & 1023;
    if (Exponent == 31 && Fraction) {
      EXPECT_TRUE(std::isnan(Floats[I])) << I;
      EXPECT_GT(Halves[I] & 0x7fff, 0x7c00) << I;
      continue;
    }
    const double Magnitude =
        Exponent == 31 ? INFINITY
        : Exponent == 0
            ? std::ldexp(Fraction, -24)
            : std::ldexp(1024 + Fraction, static_cast<int>(Exponent) - 25);
    EXPECT_EQ(Floats[I], I >> 15 ? -Magnitude : Magnitude) << I;
    EXPECT_EQ(Halves[I], In[I]) << I;
  }
}

TEST(Builtins, EdgesOfPowAndFractAreAsInC) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void edges(global const float *x, global const float *y,
                  global float *out) {
  size_t i = get_global_id(0);
  float whole;
  out[3 * i] = pow(x[i], y[i]);
  out[3 * i + 1] = fract(x[i], &whole);
  out[3 * i + 2] = whole;
})");
  const float Infinity = std::numeric_limits<float>::infinity();
  std::vector<float> Edges = {
      0,         1,    2,          3,         0.5F,
      1.5F,      1e10, 0x1p23F,    0x1p24F,   Infinity,
      0x1p-149F, NAN,  8388607.5F, 0x1p-126F, 0x1.fffffep127F};
  for (std::size_t I = 0, Of = Edges.size(); I < Of; ++I)
    Edges.push_back(-Edges[I]);
  std::vector<float> X, Y;
  for (const float A : Edges)
    for (const float B : Edges) {
      X.push_back(A);
      Y.push_back(B);
    }
  cl::Kernel Kernel(Program, "edges");
  const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 12 * X.size());
  const cl::Buffer InX = Device.upload(X), InY = Device.upload(Y);
  Kernel.setArg(0, InX);
  Kernel.setArg(1, InY);
  Kernel.setArg(2, Out);
  Device.run(Kernel, X.size(), Edges.size());
  const auto Results = Device.download<float>(Out, 3 * X.size());
  const auto Bits = [](float Value) {
    return std::isnan(Value) ? 0x7fc00000U : std::bit_cast<uint32_t>(Value);
  };
  for (std::size_t I = 0; I < X.size(); ++I) {
    // Finite powers may be rounded otherwise.
    const auto Power = static_cast<float>(std::pow(double{X[I]}, double{Y[I]}));
    if (Power == 0 || !std::isfinite(Power))
      EXPECT_EQ(Bits(Results[3 * I]), Bits(Power))
          << X[I] << " to the power of " << Y[I];
    const float Whole = std::floor(X[I]);
    const float Part = std::isinf(X[I]) || X[I] == 0
                           ? std::copysign(0.0F, X[I])
                           : std::fmin(X[I] - Whole, 0x1.fffffep-1F);
    EXPECT_EQ(Bits(Results[3 * I + 2]), Bits(Whole)) << X[I];
    EXPECT_EQ(Bits(Results[3 * I + 1]), Bits(std::isnan(X[I]) ? NAN : Part))
        << X[I];
  }
}

/// Where a kernel's constants and ranges show that C would leave the result of
/// a step inside a function undefined.
TEST(Builtins, ResultsAreDefinedForConstantsAndKnownRanges) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
float twice(float x) { return exp(x) * 2.0f + exp2(-x) + tgamma(x); }
kernel void look(global const int *least, global const float *x,
                 global int *out) {
  const int a = least[0];
  const long b = (long)a << 32;
  const char c = a >> 24;
  const int good[] = {
      abs(a) == 0x80000000u, abs(a) >> 31 == 1, abs(a) > 0x7fffffffu,
      abs(b) >> 63 == 1, abs(c) >> 7 == 1, abs((int2)(a, 1)).x > 0x7fffffffu,
      abs_diff(a, 5) == 0x80000005u,
      abs_diff((int)0x80000000u, a & 7) == 0x80000000u,
      abs_diff(a, INT_MAX) == UINT_MAX, abs_diff(b, LONG_MAX) == ULONG_MAX,
      mad_sat(a, a, a) == INT_MAX, mad_hi(a, 2, a) == INT_MAX,
      isnan(exp(NAN)), !(exp(NAN) < 1.0f), isnan(exp(x[0]) + exp2(NAN)),
      isnan(tgamma(NAN)), isnan(twice(NAN)), isnan(exp((double)NAN)),
      isnan(native_tan(NAN)), isinf(exp(INFINITY)), exp(-INFINITY) == 0.0f,
      ldexp(1.0f, INT_MIN) == 0.0f, isinf(ldexp(1.0f, INT_MAX)),
      pown(-1.0f, INT_MIN) == 1.0f, rootn(1.0f, INT_MIN) == 1.0f,
      convert_char_sat(NAN) == 0, convert_uchar_sat(1e30f) == 255,
      vload_half(0, (global const half *)least) == 0.0f};
  *out = 0;
  for (int i = 0; i < sizeof(good) / sizeof(int); ++i)
    *out += !good[i] * (i + 1);
}
)");
  cl::Kernel Kernel(Program, "look");
  const cl::Buffer Least =
      Device.upload(std::vector<int32_t>{std::numeric_limits<int32_t>::min()});
  const cl::Buffer X = Device.upload(std::vector<float>{1});
  const cl::Buffer Out = Device.upload(std::vector<int32_t>{-1});
  Kernel.setArg(0, Least);
  Kernel.setArg(1, X);
  Kernel.setArg(2, Out);
  Device.run(Kernel, 1, 1);
  EXPECT_EQ(Device.download<int32_t>(Out, 1)[0], 0)
      << "the sum of the places of wrong ones, from 1";
}

TEST(Builtins, PrintfWritesWholeLinesInTheOrderOfLanes) {
  const TestDevice Device;
  VORION_REQUIRE_DEVICE(Device);
  const cl::Program Program = Device.build(R"(
kernel void print(global const float *x) {
  size_t i = get_global_id(0);
  if (i % 5 == 0)
    printf("%d: %f %v4hlg %s %lu %c%%\n", (int)i, x[i], (float4)(x[i], 1, 2, 3),
           "text", (ulong)i << 40, 'x');
  else if (i == 7)
    printf("plain\n");
})");
  std::vector<float> X(20);
  for (std::size_t I = 0; I < X.size(); ++I)
    X[I] = static_cast<float>(I) / 4;
  cl::Kernel Kernel(Program, "print");
  const cl::Buffer In = Device.upload(X);
  Kernel.setArg(0, In);
  testing::internal::CaptureStdout();
  Device.run(Kernel, 20, 20);
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "0: 0.000000 0,1,2,3 text 0 x%\n"
            "5: 1.250000 1.25,1,2,3 text 5497558138880 x%\n"
            "10: 2.500000 2.5,1,2,3 text 10995116277760 x%\n"
            "15: 3.750000 3.75,1,2,3 text 16492674416640 x%\n"
            "plain\n");
}

} // namespace
