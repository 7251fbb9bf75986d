// The exponential units and the blend arithmetics' rounding against MPFR and
// doubles, on every vector level of this host.
#include "raster/ExpUnits.h"
#include "raster/UnitTables.h"

#include "raster/Datapath.h"
#include "raster/ScalarUnits.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <mpfr.h>
#include <string>
#include <vector>

namespace vorion::raster {
namespace {

constexpr uint32_t CorrectlyRounded = VR_EXP_EXACT;

/// exp(X) rounded once to fp32, subnormal results included.
float mpfrExp(float X) {
  // MPFR knows no subnormals: its exponent range and mpfr_subnormalize make
  // fp32's (precision 24, smallest number 2^-149).
  mpfr_t V;
  mpfr_init2(V, 24);
  const mpfr_exp_t OldMin = mpfr_get_emin();
  mpfr_set_emin(-148);
  mpfr_set_flt(V, X, MPFR_RNDN);
  const int Ternary = mpfr_exp(V, V, MPFR_RNDN);
  mpfr_subnormalize(V, Ternary, MPFR_RNDN);
  const float Result = mpfr_get_flt(V, MPFR_RNDN);
  mpfr_set_emin(OldMin);
  mpfr_clear(V);
  return Result;
}

float negative(uint32_t Magnitude) {
  return std::bit_cast<float>(Magnitude | 0x80000000U);
}

uint32_t magnitude(float X) { return std::bit_cast<uint32_t>(X) & 0x7fffffffU; }

/// Whether a double that is exp(x) to within 2^-51 could round to either of two
/// floats.
bool nearMidpoint(double E) {
  const double Slack = E * 0x1p-50;
  return static_cast<float>(E - Slack) != static_cast<float>(E + Slack);
}

/// Inputs magnitude First, First + Step, ... up to \p Last, as \p Check(inputs,
/// results) in pieces.
template <typename F>
void sweep(const Datapath &Level, uint32_t Unit, float First, float Last,
           uint32_t Step, F Check) {
  constexpr std::size_t Piece = 1 << 14;
  std::vector<float> In(Piece);
  std::vector<float> Out(Piece);
  for (uint64_t M = magnitude(First); M <= magnitude(Last);) {
    for (float &X : In) {
      X = negative(
          static_cast<uint32_t>(std::min<uint64_t>(M, magnitude(Last))));
      M += Step;
    }
    Out = In;
    Level.Exp[Unit](Out.data(), Piece);
    Check(In, Out);
  }
}

class EveryLevel : public testing::TestWithParam<const Datapath *> {};

INSTANTIATE_TEST_SUITE_P(Host, EveryLevel,
                         testing::ValuesIn(datapaths().begin(),
                                           datapaths().end()),
                         [](const auto &Info) { return Info.param->Name; });

// Not a sample: all 277 million fp32 numbers from -104 to -2^-26. Below, the
// result is 0; above, 1 (the next tests). glibc's exp is good to 1 ulp of
// double, so MPFR is asked only where that does not settle the float. The
// baseline computes without multiply-adds, all other levels with them.
TEST(ExpUnits, CorrectlyRoundedForEveryInput) {
  const Datapath &Level = *datapaths().back(), &Baseline = *datapaths().front();
  uint64_t Inputs = 0;
  uint64_t AskedMpfr = 0;
  uint64_t Wrong = 0;
  // A sanitizer build takes a sample, and so does a host without vectors, which
  // may be an emulated one.
#if __has_feature(address_sanitizer)
  const uint32_t Step = 61;
#else
  const uint32_t Step = datapaths().size() == 1 ? 997 : 1;
#endif
  sweep(Level, CorrectlyRounded, 0x1p-26F, 104.0F, Step,
        [&](const std::vector<float> &In, const std::vector<float> &Out) {
          std::vector<float> Plain = In;
          Baseline.Exp[CorrectlyRounded](Plain.data(), Plain.size());
          for (std::size_t I = 0; I != In.size(); ++I) {
            const double E = std::exp(static_cast<double>(In[I]));
            const bool Hard = nearMidpoint(E);
            const float Right = Hard ? mpfrExp(In[I]) : static_cast<float>(E);
            AskedMpfr += Hard;
            Wrong += Out[I] != Right || Plain[I] != Right;
          }
          Inputs += In.size();
        });
  EXPECT_EQ(Wrong, 0U);
  if (Step == 1) {
    EXPECT_GT(AskedMpfr, 0U);
  }
  RecordProperty("inputs", std::to_string(Inputs));
  RecordProperty("asked_mpfr", std::to_string(AskedMpfr));
}

TEST_P(EveryLevel, CorrectlyRoundedAgainstMpfr) {
  uint64_t Wrong = 0;
  sweep(*GetParam(), CorrectlyRounded, 0x1p-30F, 90.0F, 30011,
        [&](const std::vector<float> &In, const std::vector<float> &Out) {
          for (std::size_t I = 0; I != In.size(); ++I)
            Wrong += Out[I] != mpfrExp(In[I]);
        });
  EXPECT_EQ(Wrong, 0U);
}

TEST_P(EveryLevel, EndsOfTheRange) {
  constexpr float Inf = std::numeric_limits<float>::infinity();
  float V[16] = {0.0F,   -0.0F,     -0x1p-149F, -0x1p-30F,  -103.97F, -103.98F,
                 -104.F, -1e30F,    -Inf,       -87.4F,     -90.0F,   -1.0F,
                 0.0F,   -0x1p-25F, -0x1p-24F,  -0x1.8p-25F};
  float Out[16];
  std::copy(std::begin(V), std::end(V), Out);
  GetParam()->Exp[CorrectlyRounded](Out, 16);
  for (unsigned I = 0; I != 16; ++I)
    EXPECT_EQ(Out[I], mpfrExp(V[I])) << V[I];

  for (uint32_t Unit = 1; Unit != ExpUnitCount; ++Unit) {
    std::copy(std::begin(V), std::end(V), Out);
    GetParam()->Exp[Unit](Out, 16);
    for (const unsigned I : {0, 1, 12})
      EXPECT_EQ(Out[I], 1.0F) << Unit;
    for (const unsigned I : {4, 5, 6, 7, 8, 10})
      EXPECT_EQ(Out[I], 0.0F) << Unit << ' ' << V[I];
  }
}

TEST_P(EveryLevel, UnitsKeepTheirBoundsAndFall) {
  for (uint32_t Row = 0; Row != ExpUnitCount; ++Row) {
    const ExpUnit &Unit = ExpUnits[Row];
    double Largest = 0;
    float Previous = 2.0F;
    uint64_t Rises = 0;
    sweep(*GetParam(), Row, 0x1p-30F, 86.6F, 1009,
          [&](const std::vector<float> &In, const std::vector<float> &Out) {
            for (std::size_t I = 0; I != In.size(); ++I) {
              const double E = std::exp(static_cast<double>(In[I]));
              Largest = std::max(Largest, std::fabs(Out[I] / E - 1));
              Rises += Out[I] > Previous;
              Previous = Out[I];
            }
          });
    EXPECT_LE(Largest, Unit.MaxRelativeError) << Unit.Name;
    // The stated bound is the unit's, not a comfortable one.
    EXPECT_GE(Largest, 0.95 * Unit.MaxRelativeError) << Unit.Name;
    // fp32's rounding may lift a polynomial by an ulp.
    const bool Polynomial =
        VR_EXP_POLY2 <= Unit.Option && Unit.Option <= VR_EXP_POLY4;
    if (!Polynomial)
      EXPECT_EQ(Rises, 0U) << Unit.Name;
    RecordProperty(std::string(Unit.Name),
                   std::to_string(Largest * 1e6) + "e-6");
  }
}

TEST_P(EveryLevel, SameBitsAsBaseline) {
  const Datapath &Baseline = *datapaths().front();
  for (uint32_t Unit = 0; Unit != ExpUnitCount; ++Unit)
    sweep(*GetParam(), Unit, 0x1p-40F, 120.0F, 4001,
          [&](const std::vector<float> &In, const std::vector<float> &Out) {
            std::vector<float> Other = In;
            Baseline.Exp[Unit](Other.data(), Other.size());
            ASSERT_EQ(Out, Other);
          });
}

// Every number of the unit's grid and between, each unit one number at a time.
TEST_P(EveryLevel, BitsOfTheScalarUnits) {
  for (uint32_t Unit = 1; Unit != ExpUnitCount; ++Unit)
    sweep(*GetParam(), Unit, 0x1p-40F, 120.0F, 1511,
          [&](const std::vector<float> &In, const std::vector<float> &Out) {
            uint64_t Wrong = 0;
            for (std::size_t I = 0; I != In.size(); ++I)
              Wrong += Out[I] != scalar::exp(Unit, In[I]);
            ASSERT_EQ(Wrong, 0U) << Unit;
          });
}

TEST_P(EveryLevel, OperandsAreRoundedToNearest) {
  // All exponents, and of significands those around every bf16 and fp16 number
  // and midpoint.
  std::vector<float> In;
  for (uint32_t Exponent = 0; Exponent != 255; ++Exponent)
    for (uint32_t High = 0; High != 1 << 11; ++High)
      for (const uint32_t Low : {0U, 1U, 0x800U, 0xfffU})
        for (const uint32_t Sign : {0U, 1U})
          In.push_back(std::bit_cast<float>(Sign << 31 | Exponent << 23 |
                                            High << 12 | Low));
  In.resize(In.size() / 16 * 16);
  for (uint32_t Unit = 0; Unit != BlendUnitCount; ++Unit) {
    std::vector<float> Out = In;
    GetParam()->Operand[Unit](Out.data(), Out.size());
    uint64_t Wrong = 0;
    for (std::size_t I = 0; I != In.size(); ++I)
      Wrong += std::bit_cast<uint32_t>(Out[I]) !=
               std::bit_cast<uint32_t>(scalar::operand(Unit, In[I]));
    EXPECT_EQ(Wrong, 0U) << BlendUnits[Unit].Name;
  }
  constexpr float Inf = std::numeric_limits<float>::infinity();
  float V[16] = {Inf, -Inf, 65504, 65519, 65520, 1e30F, -1e30F, 0x1p-25F};
  GetParam()->Operand[VR_BLEND_FP16](V, 16);
  EXPECT_EQ(V[0], 65504.0F);
  EXPECT_EQ(V[1], -65504.0F);
  EXPECT_EQ(V[4], 65504.0F);
  EXPECT_EQ(V[6], -65504.0F);
  EXPECT_EQ(V[7], 0.0F); // a tie, to even
  float W[16] = {Inf, -Inf, 0x1.fep127F, 0x1.ffp127F};
  GetParam()->Operand[VR_BLEND_BF16](W, 16);
  EXPECT_EQ(W[0], Inf);
  EXPECT_EQ(W[1], -Inf);
  EXPECT_EQ(W[2], 0x1.fep127F);
  EXPECT_EQ(W[3], Inf);
}

TEST(ExpUnits, OptionsAreTheirPlaces) {
  for (std::size_t I = 0; I != std::size(BlendUnits); ++I)
    EXPECT_EQ(BlendUnits[I].Option, I);
}

} // namespace
} // namespace vorion::raster
