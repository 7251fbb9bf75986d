/// The integer implementation against the host's unit in every rounding mode
/// that the host has, and by hand in the one that it has not.

#include "core/SoftFloat.h"

#include "core/HostFp.h"
#include "core/RoundingMode.h"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace vorion::isasim;

namespace {

/// Bits that are likely to matter: specials, neighbours, halves, and noise.
class Operands {
public:
  uint32_t next() {
    static constexpr uint32_t Special[] = {
        0x00000000, 0x80000000, 0x3F800000, 0xBF800000, 0x7F800000, 0xFF800000,
        0x7FC00000, 0x7F800001, 0xFFC12345, 0x00000001, 0x80000001, 0x007FFFFF,
        0x00800000, 0x7F7FFFFF, 0xFF7FFFFF, 0x33800000, 0x4B000000, 0x4B7FFFFF,
        0x3F000000, 0x4F000000, 0xCF000000, 0x4F7FFFFF, 0x5F000000, 0x00FFFFFF};
    switch (Random() % 4) {
    case 0:
      return Special[Random() % std::size(Special)];
    case 1: // near one another, so that sums cancel
      return 0x3F800000 + Random() % 16 - 8 + (Random() % 2 << 31);
    case 2: // near the subnormals
      return Random() % 0x02000000 + (Random() % 2 << 31);
    default:
      return static_cast<uint32_t>(Random());
    }
  }

private:
  std::mt19937 Random{42};
};

float asFloat(uint32_t Bits) { return std::bit_cast<float>(Bits); }

/// The host's result, canonical NaNs, and its flags in mode Rm. The operands
/// are volatile so that nothing is computed at another time.
template <typename Function>
uint32_t onHost(unsigned Rm, uint32_t &Flags, Function F) {
  const HostFp Guard;
  HostFp::enter(Rm);
  const volatile float R = F();
  Flags = HostFp::takeFlags();
  const float Value = R;
  const auto Bits = std::bit_cast<uint32_t>(Value);
  return isNan(Bits) ? CanonicalNan : Bits;
}

template <typename Soft, typename Host>
void compare(const char *Name, Soft S, Host H) {
  Operands Next;
  for (unsigned Rm = 0; Rm != NumHostRoundings; ++Rm)
    for (int Try = 0; Try != 200000; ++Try) {
      const uint32_t A = Next.next(), B = Next.next(), C = Next.next();
      uint32_t Flags = 0, Expected = 0;
      const uint32_t Got = S(A, B, C, Rm, Flags);
      const uint32_t Want = onHost(Rm, Expected, [&] {
        const volatile float X = asFloat(A), Y = asFloat(B), Z = asFloat(C);
        return H(X, Y, Z);
      });
      ASSERT_EQ(Got, Want) << Name << std::hex << " " << A << " " << B << " "
                           << C << " rm " << Rm;
      ASSERT_EQ(Flags, Expected) << Name << std::hex << " " << A << " " << B
                                 << " " << C << " rm " << Rm;
    }
}

} // namespace

TEST(SoftFloat, AdditionIsTheHosts) {
  compare(
      "add",
      [](auto A, auto B, auto, auto Rm, auto &F) {
        return softAdd(A, B, Rm, F);
      },
      [](float X, float Y, float) { return X + Y; });
}

TEST(SoftFloat, MultiplicationIsTheHosts) {
  compare(
      "mul",
      [](auto A, auto B, auto, auto Rm, auto &F) {
        return softMul(A, B, Rm, F);
      },
      [](float X, float Y, float) { return X * Y; });
}

TEST(SoftFloat, DivisionIsTheHosts) {
  compare(
      "div",
      [](auto A, auto B, auto, auto Rm, auto &F) {
        return softDiv(A, B, Rm, F);
      },
      [](float X, float Y, float) { return X / Y; });
}

#if defined(__x86_64__)
TEST(SoftFloat, SquareRootIsTheHosts) {
  compare(
      "sqrt",
      [](auto A, auto, auto, auto Rm, auto &F) { return softSqrt(A, Rm, F); },
      [](float X, float, float) {
        return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(X)));
      });
}
#endif

#if defined(__x86_64__)
__attribute__((target("fma"))) static float hostFma(float X, float Y, float Z) {
  return _mm_cvtss_f32(
      _mm_fmadd_ss(_mm_set_ss(X), _mm_set_ss(Y), _mm_set_ss(Z)));
}

TEST(SoftFloat, FusedIsTheHosts) {
  if (!__builtin_cpu_supports("fma"))
    GTEST_SKIP() << "the host has no fused multiply-add";
  compare(
      "fma",
      [](auto A, auto B, auto C, auto Rm, auto &F) -> uint32_t {
        // Where x86 and RISC-V differ: tested by name below.
        const bool ZeroTimesInf =
            ((A & 0x7FFFFFFF) == 0 && (B & 0x7FFFFFFF) == 0x7F800000) ||
            ((B & 0x7FFFFFFF) == 0 && (A & 0x7FFFFFFF) == 0x7F800000);
        if (ZeroTimesInf && isNan(C)) {
          F = isSignalingNan(C) ? Invalid : 0U;
          return CanonicalNan;
        }
        return softFma(A, B, C, Rm, F);
      },
      [](float X, float Y, float Z) { return hostFma(X, Y, Z); });
}
#endif

TEST(SoftFloat, InfinityTimesZeroPlusQuietNanIsInvalid) {
  uint32_t Flags = 0;
  EXPECT_EQ(softFma(0x7F800000, 0, 0x7FC00001, 0, Flags), CanonicalNan);
  EXPECT_EQ(Flags, Invalid);
}

TEST(SoftFloat, ConversionsRoundAsTheHosts) {
  Operands Next;
  for (unsigned Rm = 0; Rm != NumHostRoundings; ++Rm)
    for (int Try = 0; Try != 100000; ++Try) {
      const uint32_t A = Next.next();
      uint32_t Flags = 0, Expected = 0;
      const uint32_t Got = softFromInt(A, true, Rm, Flags);
      const uint32_t Want = onHost(Rm, Expected, [&] {
        const volatile int64_t X = static_cast<int32_t>(A);
        return static_cast<float>(X);
      });
      ASSERT_EQ(Got, Want) << std::hex << A << " rm " << Rm;
      ASSERT_EQ(Flags, Expected) << std::hex << A;
      Flags = 0;
      const uint32_t GotU = softFromInt(A, false, Rm, Flags);
      const uint32_t WantU = onHost(Rm, Expected, [&] {
        const volatile int64_t X = A;
        return static_cast<float>(X);
      });
      ASSERT_EQ(GotU, WantU) << std::hex << A << " rm " << Rm;
      ASSERT_EQ(Flags, Expected) << std::hex << A;
    }
}

TEST(SoftFloat, ToIntSaturates) {
  struct Case {
    uint32_t A;
    bool Signed;
    uint32_t Result, Flags;
  };
  // RISC-V F, table "Domains of float-to-integer conversions".
  for (const Case &C : {
           Case{0x7FC00000, true, 0x7FFFFFFF, Invalid},
           Case{0xFFC00000, true, 0x7FFFFFFF, Invalid},
           Case{0x7F800000, true, 0x7FFFFFFF, Invalid},
           Case{0xFF800000, true, 0x80000000, Invalid},
           Case{0x4F000000, true, 0x7FFFFFFF, Invalid}, // 2^31
           Case{0xCF000000, true, 0x80000000, 0},       // -2^31
           Case{0xCF000001, true, 0x80000000, Invalid},
           Case{0x7FC00000, false, 0xFFFFFFFF, Invalid},
           Case{0xFF800000, false, 0, Invalid},
           Case{0xBF800000, false, 0, Invalid},          // -1
           Case{0xBF000000, false, 0, Inexact},          // -0.5
           Case{0x4F800000, false, 0xFFFFFFFF, Invalid}, // 2^32
           Case{0x4F7FFFFF, false, 0xFFFFFF00, 0},
           Case{0x80000000, false, 0, 0},
           Case{0x00000001, true, 0, Inexact},
       }) {
    uint32_t Flags = 0;
    EXPECT_EQ(softToInt(C.A, C.Signed, 1, Flags), C.Result) << std::hex << C.A;
    EXPECT_EQ(Flags, C.Flags) << std::hex << C.A;
  }
}

TEST(SoftFloat, ToIntRoundsInEveryMode) {
  struct Case {
    float X;
    int32_t ByMode[5]; ///< rne, rtz, rdn, rup, rmm
  };
  for (const Case &C :
       {Case{2.5F, {2, 2, 2, 3, 3}}, Case{3.5F, {4, 3, 3, 4, 4}},
        Case{-2.5F, {-2, -2, -3, -2, -3}}, Case{0.25F, {0, 0, 0, 1, 0}},
        Case{-0.75F, {-1, 0, -1, 0, -1}}})
    for (unsigned Rm = 0; Rm != 5; ++Rm) {
      uint32_t Flags = 0;
      EXPECT_EQ(softToInt(std::bit_cast<uint32_t>(C.X), true, Rm, Flags),
                static_cast<uint32_t>(C.ByMode[Rm]))
          << C.X << " rm " << Rm;
      EXPECT_EQ(Flags, Inexact);
    }
}

TEST(SoftFloat, NearestAwayBreaksTiesOutwards) {
  uint32_t Flags = 0;
  // 1 + 2^-24 is half way between 1 and its neighbour.
  EXPECT_EQ(softAdd(0x3F800000, 0x33800000, Rmm, Flags), 0x3F800001U);
  EXPECT_EQ(softAdd(0xBF800000, 0xB3800000, Rmm, Flags), 0xBF800001U);
  EXPECT_EQ(softAdd(0x3F800000, 0x33800000, 0, Flags), 0x3F800000U);
  EXPECT_EQ(Flags, Inexact);
  // A little less than half way goes down.
  EXPECT_EQ(softAdd(0x3F800000, 0x337FFFFF, Rmm, Flags), 0x3F800000U);
  // Half of the smallest subnormal goes up to it.
  Flags = 0;
  EXPECT_EQ(softMul(0x00000001, 0x3F000000, Rmm, Flags), 0x00000001U);
  EXPECT_EQ(Flags, Inexact | Underflow);
  // Past the largest number: infinity.
  Flags = 0;
  EXPECT_EQ(softAdd(0x7F7FFFFF, 0x73000000, Rmm, Flags), 0x7F800000U);
  EXPECT_EQ(Flags, Inexact | Overflow);
  EXPECT_EQ(softFromInt(0x01000001, false, Rmm, Flags), 0x4B800001U);
}
