/// Half precision: arithmetic is rounded once, functions keep the limits of the
/// standard, conversions round as their name says.

#include "TestDevice.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <random>

using vorion::test::TestDevice;

namespace {

using Half = _Float16;
constexpr std::size_t Count = 1 << 16, Group = 64;

Half halfOf(std::size_t Bits) {
  return std::bit_cast<Half>(static_cast<uint16_t>(Bits));
}
uint16_t bitsOf(Half Value) { return std::bit_cast<uint16_t>(Value); }
bool isNan(uint16_t Bits) { return (Bits & 0x7FFF) > 0x7C00; }

/// How many halves lie between two.
int distance(uint16_t A, uint16_t B) {
  const auto Ordered = [](uint16_t Bits) {
    return Bits & 0x8000 ? 0x8000 - Bits : static_cast<int>(Bits);
  };
  return std::abs(Ordered(A) - Ordered(B));
}

class Halves : public testing::Test {
protected:
  void SetUp() override {
    VORION_REQUIRE_DEVICE(Device);
    // Every half, a random one, and one near both, so that sums cancel.
    std::mt19937 Random(1);
    for (std::size_t I = 0; I < Count; ++I) {
      A.push_back(static_cast<uint16_t>(I));
      B.push_back(static_cast<uint16_t>(Random()));
      const auto Product =
          static_cast<Half>(static_cast<float>(halfOf(A[I])) * halfOf(B[I]));
      C.push_back(Random() % 2 ? bitsOf(-Product) ^ (Random() & 3)
                               : static_cast<uint16_t>(Random()));
    }
  }

  /// \p Expression of a, b, c for all of them.
  std::vector<uint16_t> run(const std::string &Expression) {
    const cl::Program Program = Device.build(
        "#pragma OPENCL EXTENSION cl_khr_fp16 : enable\n"
        "kernel void call(global const half *as, global const half *bs,\n"
        "                 global const half *cs, global half *out) {\n"
        "  size_t i = get_global_id(0);\n"
        "  half a = as[i], b = bs[i], c = cs[i];\n"
        "  out[i] = " +
        Expression + ";\n}");
    cl::Kernel Kernel(Program, "call");
    const cl::Buffer In[] = {Device.upload(A), Device.upload(B),
                             Device.upload(C)};
    const cl::Buffer Out(Device.context(), CL_MEM_READ_WRITE, 2 * Count);
    for (cl_uint I = 0; I < 3; ++I)
      Kernel.setArg(I, In[I]);
    Kernel.setArg(3, Out);
    Device.run(Kernel, Count, Group);
    return Device.download<uint16_t>(Out, Count);
  }

  /// Compares with \p Oracle, which may be off by \p Limit halves.
  void check(const std::string &Expression,
             const std::function<Half(Half, Half, Half)> &Oracle,
             int Limit = 0) {
    const auto Got = run(Expression);
    for (std::size_t I = 0; I < Count; ++I) {
      const uint16_t Expected =
          bitsOf(Oracle(halfOf(A[I]), halfOf(B[I]), halfOf(C[I])));
      if (isNan(Expected))
        ASSERT_TRUE(isNan(Got[I])) << Expression << " of " << std::hex << A[I];
      else
        ASSERT_LE(distance(Got[I], Expected), Limit)
            << Expression << " of " << std::hex << A[I] << ", " << B[I] << ", "
            << C[I] << ": " << Got[I] << ", expected " << Expected;
    }
  }

  const TestDevice Device;
  std::vector<uint16_t> A, B, C;
};

TEST_F(Halves, ArithmeticIsRoundedOnce) {
  check("a + b", [](Half A, Half B, Half) { return A + B; });
  check("a * b", [](Half A, Half B, Half) { return A * B; });
  check("a / b", [](Half A, Half B, Half) {
    return static_cast<Half>(static_cast<double>(A) / static_cast<double>(B));
  });
  check("sqrt(a)", [](Half A, Half, Half) {
    return static_cast<Half>(std::sqrt(static_cast<double>(A)));
  });
  check("fma(a, b, c)", [](Half A, Half B, Half C) {
    return static_cast<Half>(static_cast<__float128>(A) * B + C);
  });
}

TEST_F(Halves, FunctionsKeepTheirLimits) {
  const auto OfOne = [](double (*F)(double)) {
    return [F](Half A, Half, Half) {
      return static_cast<Half>(F(static_cast<double>(A)));
    };
  };
  check("exp(a)", OfOne(std::exp), 2);
  check("log2(a)", OfOne(std::log2), 2);
  check("sin(a)", OfOne(std::sin), 2);
  check("atan(a)", OfOne(std::atan), 2);
  check("tgamma(a)", OfOne(std::tgamma), 4);
  check("floor(a)", OfOne(std::floor));
  check(
      "pow(a, b)",
      [](Half A, Half B, Half) {
        return static_cast<Half>(
            std::pow(static_cast<double>(A), static_cast<double>(B)));
      },
      4);
  check("fmod(a, b)", [](Half A, Half B, Half) {
    return static_cast<Half>(
        std::fmod(static_cast<double>(A), static_cast<double>(B)));
  });
  check("isnormal(a) ? a : isnan(a) ? b : c", [](Half A, Half B, Half C) {
    const uint16_t Exponent = bitsOf(A) & 0x7C00;
    return Exponent != 0 && Exponent != 0x7C00 ? A : isNan(bitsOf(A)) ? B : C;
  });
}

/// The library's functions write halves as integers.
TEST_F(Halves, WhatFunctionsStoreIsReadAsHalf) {
  check("({ half t[4]; vstore4((half4)(a, b, c, a), 0, t); t[1]; })",
        [](Half, Half B, Half) { return B; });
  check("({ half t[2]; t[1] = a; vstore_half((float)b, 1, t); t[1]; })",
        [](Half, Half B, Half) { return B; });
  check("({ volatile short t[3]; for (int j = 0; j < 3; ++j)"
        " t[j] = as_short(b); vload2(0, (private half *)t + 1).y; })",
        [](Half, Half B, Half) { return B; });
}

TEST_F(Halves, NextafterStepsByOneHalf) {
  const auto Got = run("nextafter(a, b)");
  for (std::size_t I = 0; I < Count; ++I) {
    const Half From = halfOf(A[I]), To = halfOf(B[I]);
    if (isNan(A[I]) || isNan(B[I])) {
      EXPECT_TRUE(isNan(Got[I]));
      continue;
    }
    ASSERT_EQ(distance(Got[I], A[I]), From == To ? 0 : 1) << std::hex << A[I];
    ASSERT_TRUE(From == To || (halfOf(Got[I]) > From) == (To > From))
        << std::hex << A[I] << ", " << B[I];
  }
}

/// The greatest half that is at most x, and so on; x between halves.
TEST_F(Halves, ConversionsRoundAsTheyAreNamed) {
  // Between a and its neighbour above, nearer to a.
  const std::string Value = "as_float(as_int((float)fabs(a)) + 5)";
  const auto Inside = [](uint16_t Bits) {
    return (Bits & 0x7FFF) < 0x7BFF && (Bits & 0x7FFF) != 0;
  };
  const auto Near = run("convert_half_rte(" + Value + ")"),
             Zero = run("convert_half_rtz(-" + Value + ")"),
             Up = run("convert_half_rtp(" + Value + ")"),
             Down = run("convert_half_rtn(" + Value + ")");
  for (std::size_t I = 0; I < Count; ++I) {
    if (!Inside(A[I]))
      continue;
    const uint16_t Below = A[I] & 0x7FFF;
    ASSERT_EQ(Near[I], Below);
    ASSERT_EQ(Zero[I], Below | 0x8000);
    ASSERT_EQ(Up[I], Below + 1);
    ASSERT_EQ(Down[I], Below);
  }
}

TEST_F(Halves, PrintfTakesVectorsOfThem) {
  const cl::Program Program = Device.build(R"(
#pragma OPENCL EXTENSION cl_khr_fp16 : enable
kernel void print(half x, half tiny) {
  half16 all = x;
  all.s1 = -INFINITY;
  all.sf = tiny;
  printf("%.2v2hf %v3hg %v4hg %v8ha %v16hg %.1hf\n", all.s01, all.s01f,
         all.lo.lo, all.hi, all, x);
})");
  cl::Kernel Kernel(Program, "print");
  Kernel.setArg(0, halfOf(0x3E00)); // 1.5
  Kernel.setArg(1, halfOf(1));
  testing::internal::CaptureStdout();
  Device.run(Kernel, 1, 1);
  EXPECT_EQ(testing::internal::GetCapturedStdout(),
            "1.50,-inf 1.5,-inf,5.96046e-08 1.5,-inf,1.5,1.5 "
            "0x1.8p+0,0x1.8p+0,0x1.8p+0,0x1.8p+0,0x1.8p+0,0x1.8p+0,0x1.8p+0,"
            "0x1p-24 "
            "1.5,-inf,1.5,1.5,1.5,1.5,1.5,1.5,1.5,1.5,1.5,1.5,1.5,1.5,1.5,"
            "5.96046e-08 1.5\n");
}

} // namespace
