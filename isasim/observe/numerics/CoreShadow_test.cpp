#include "observe/numerics/CoreShadow.h"

#include "testing/WarpRunner.h"

#include <bit>
#include <random>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr unsigned AllLanes = 16;
constexpr int32_t Scratch = 0; // offset from x10, which holds VX_GLOBAL_BASE

uint32_t bits(float F) { return std::bit_cast<uint32_t>(F); }

/// A warp under the sanitizer; instruction N's counts are at(N).
struct Shadowed {
  explicit Shadowed(const std::vector<uint32_t> &Words,
                    NumericLimits LimitsIn = {})
      : Limits(LimitsIn), Run(execTable(true), Words),
        Shadow(Sites, Memory, Limits) {
    Run.Watcher.Observers = {&Shadow};
    Shadow.begin(Run.Shape, Run.Program);
    Run.setX(10, all(VX_GLOBAL_BASE));
  }
  Shadowed &f(unsigned N, float V) {
    Run.setF(N, all(bits(V)));
    return *this;
  }
  Shadowed &x(unsigned N, uint32_t V) {
    Run.setX(N, all(V));
    return *this;
  }
  Shadowed &run() {
    Run.run();
    EXPECT_TRUE(Run.ranToEnd());
    return *this;
  }
  uint32_t number(unsigned N) { return Sites.number(VX_IMAGE_BASE + 4 * N); }
  const NumericCounts &at(unsigned N) { return Sites.at(number(N)).Counts; }

  NumericLimits Limits;
  WarpRunner Run;
  NumericSites Sites;
  ShadowMemory Memory;
  CoreShadow Shadow;
};

uint32_t fadd(unsigned D, unsigned A, unsigned B) {
  return encode(Op::RV_FADD_S, {.Rd = D, .Rs1 = A, .Rs2 = B});
}
uint32_t fsub(unsigned D, unsigned A, unsigned B) {
  return encode(Op::RV_FSUB_S, {.Rd = D, .Rs1 = A, .Rs2 = B});
}
uint32_t fmul(unsigned D, unsigned A, unsigned B) {
  return encode(Op::RV_FMUL_S, {.Rd = D, .Rs1 = A, .Rs2 = B});
}
uint32_t fdiv(unsigned D, unsigned A, unsigned B) {
  return encode(Op::RV_FDIV_S, {.Rd = D, .Rs1 = A, .Rs2 = B});
}
uint32_t toX(unsigned D, unsigned A) {
  return encode(Op::RV_FMV_X_W, {.Rd = D, .Rs1 = A});
}
uint32_t toF(unsigned D, unsigned A) {
  return encode(Op::RV_FMV_W_X, {.Rd = D, .Rs1 = A});
}
uint32_t store(unsigned From) {
  return encode(Op::RV_SW, {.Rs1 = 10, .Rs2 = From, .Imm = Scratch});
}
uint32_t load(unsigned D) {
  return encode(Op::RV_LW, {.Rd = D, .Rs1 = 10, .Imm = Scratch});
}

/// Where a branch at the end leads.
const uint32_t Nop = encode(Op::RV_ADDI, {});

/// f3 = 1e7 + 0.1, which fp32 rounds to 1e7: its shadow shows as soon as f1 is
/// taken from it.
struct LostDigits : Shadowed {
  explicit LostDigits(std::vector<uint32_t> Rest)
      : Shadowed(before(std::move(Rest))) {
    f(1, 1e7F).f(2, 0.1F);
  }
  static std::vector<uint32_t> before(std::vector<uint32_t> Rest) {
    Rest.insert(Rest.begin(), fadd(3, 1, 2));
    return Rest;
  }
};

} // namespace

TEST(CoreShadow, CancellationIsBornWhereItHappens) {
  LostDigits S({fsub(4, 3, 1), fmul(5, 4, 1)});
  S.run();
  EXPECT_EQ(S.at(0).Born, 0U);
  EXPECT_LT(S.at(0).ErrorMax, 0x1p-23);
  EXPECT_EQ(S.at(1).Born, AllLanes);
  EXPECT_EQ(S.at(1).Cancelled, AllLanes);
  EXPECT_EQ(S.at(1).ErrorMax, 1.0);
  EXPECT_EQ(S.at(2).Born, 0U);
  EXPECT_EQ(S.at(2).Inherited, AllLanes);
  // The operands of the worst one, with their shadows.
  const NumericSample &Worst = S.Sites.at(S.number(1)).Worst;
  EXPECT_EQ(Worst.Words[0], bits(1e7F));
  EXPECT_NEAR(Worst.Shadows[0], 1e7 + 0.1, 1e-7);
  EXPECT_EQ(Worst.From[0].number(), S.number(0));
  EXPECT_FALSE(Worst.From[1].isKnown());
}

TEST(CoreShadow, WhatReachesMemoryCountsWhereItWasBorn) {
  LostDigits S({fsub(4, 3, 1), fmul(5, 4, 1), toX(5, 5), store(5)});
  S.run();
  EXPECT_EQ(S.at(1).Reached, AllLanes);
  EXPECT_EQ(S.at(2).Reached, 0U) << "it only passed it on";
  LostDigits Local({fsub(4, 3, 1), toX(5, 4), store(5)});
  Local.x(10, VX_LOCAL_BASE).run();
  EXPECT_EQ(Local.at(1).Born, AllLanes);
  EXPECT_EQ(Local.at(1).Reached, 0U);
}

TEST(CoreShadow, OnlyActiveLanesCount) {
  LostDigits S({fsub(4, 3, 1)});
  S.Run.setActive(0x0411);
  S.run();
  EXPECT_EQ(S.at(1).Results, 3U);
  EXPECT_EQ(S.at(1).Born, 3U);
}

TEST(CoreShadow, ASumThatStandsStillIsBornOnce) {
  // 2^24 + 1 rounds to 2^24: each addition loses one more.
  std::vector<uint32_t> Words(30, fadd(1, 1, 2));
  Shadowed S(Words, {.Relative = 1e-6});
  S.f(1, 0x1p24F).f(2, 1).run();
  uint64_t Born = 0, Inherited = 0;
  for (unsigned N = 0; N != Words.size(); ++N) {
    Born += S.at(N).Born;
    Inherited += S.at(N).Inherited;
  }
  EXPECT_EQ(Born, AllLanes);
  EXPECT_EQ(S.at(16).Born, AllLanes) << "17 / 2^24 is above 1e-6";
  EXPECT_EQ(Inherited, AllLanes * 13);
}

TEST(CoreShadow, TheChainOfANanLeadsToItsZero) {
  Shadowed S({fsub(3, 1, 1), fdiv(4, 2, 3), fmul(5, 4, 3), fadd(6, 5, 2)});
  S.f(1, 7).f(2, 1).run();
  EXPECT_EQ(S.at(1).NotFinite, AllLanes);
  EXPECT_EQ(S.at(2).NotFinite, AllLanes);
  EXPECT_EQ(S.at(3).NotFinite, 0U) << "a NaN that is carried on";
  ASSERT_EQ(S.Sites.events().size(), 2U);
  const NumericEvent &Inf = S.Sites.events()[0], &Nan = S.Sites.events()[1];
  EXPECT_EQ(Inf.Site, S.number(1));
  EXPECT_EQ(Inf.What.From[1].number(), S.number(0));
  EXPECT_EQ(Nan.Site, S.number(2));
  ASSERT_TRUE(Nan.What.From[0].isEvent());
  EXPECT_EQ(Nan.What.From[0].number(), 0U);
  EXPECT_EQ(Nan.What.From[1].number(), S.number(0));
}

TEST(CoreShadow, ZeroTimesAnInfinityOfTheHostMakesANan) {
  Shadowed S({fmul(3, 1, 2)});
  S.f(1, 0).f(2, std::numeric_limits<float>::infinity()).run();
  EXPECT_EQ(S.at(0).NotFinite, AllLanes);
  ASSERT_EQ(S.Sites.events().size(), 1U);
  EXPECT_FALSE(S.Sites.events()[0].What.From[1].isKnown());
}

TEST(CoreShadow, SmallResultsAreCounted) {
  Shadowed S({fmul(3, 1, 1), fmul(4, 3, 1)});
  S.f(1, 1e-20F).run();
  EXPECT_EQ(S.at(0).Subnormal, AllLanes);
  EXPECT_EQ(S.at(0).Flushed, 0U);
  EXPECT_EQ(S.at(1).Flushed, AllLanes);
  EXPECT_EQ(S.at(1).Subnormal, 0U);
}

TEST(CoreShadow, DecisionsAndBranchesThatDiffer) {
  // 1e7 < 1e7 + 0.1 only in the shadow.
  LostDigits S({encode(Op::RV_FLT_S, {.Rd = 5, .Rs1 = 1, .Rs2 = 3}),
                encode(Op::RV_XORI, {.Rd = 6, .Rs1 = 5, .Imm = 1}),
                encode(Op::RV_BNE, {.Rs1 = 6, .Rs2 = 0, .Imm = 4}),
                encode(Op::RV_FLT_S, {.Rd = 5, .Rs1 = 2, .Rs2 = 3}),
                encode(Op::RV_BNE, {.Rs1 = 5, .Rs2 = 0, .Imm = 4}), Nop});
  S.run();
  EXPECT_EQ(S.at(1).Decisions, AllLanes);
  EXPECT_EQ(S.at(3).Branches, AllLanes);
  EXPECT_EQ(S.at(4).Decisions, 0U);
  EXPECT_EQ(S.at(5).Branches, 0U);
}

TEST(CoreShadow, ASplitAndItsBranchAreOneDecision) {
  LostDigits S({encode(Op::RV_FLT_S, {.Rd = 5, .Rs1 = 1, .Rs2 = 3}),
                encode(Op::VX_SPLIT, {.Rd = 6, .Rs1 = 5}),
                encode(Op::RV_BNE, {.Rs1 = 5, .Rs2 = 0, .Imm = 4}), Nop});
  S.run();
  EXPECT_EQ(S.at(2).Branches, AllLanes);
  EXPECT_EQ(S.at(3).Branches, 0U);
}

TEST(CoreShadow, ConversionsThatDiffer) {
  // 2^24 + 0.5 is 2^24; upwards the shadow gives one more.
  const auto Up = [](unsigned Rm) {
    return encode(Op::RV_FCVT_W_S, {.Rd = 5, .Rs1 = 3, .Rm = Rm});
  };
  Shadowed S({fadd(3, 1, 2), Up(3), Up(1),
              encode(Op::RV_FCVT_S_W, {.Rd = 4, .Rs1 = 5})});
  S.f(1, 0x1p24F).f(2, 0.5F).run();
  EXPECT_EQ(S.at(1).Decisions, AllLanes);
  EXPECT_EQ(S.at(2).Decisions, 0U) << "towards zero both are 2^24";
  EXPECT_EQ(S.at(3).ErrorMax, 0);
}

TEST(CoreShadow, IntegersAreExactWhateverTheirSign) {
  Shadowed S({encode(Op::RV_FCVT_S_W, {.Rd = 3, .Rs1 = 5}),
              encode(Op::RV_FCVT_S_WU, {.Rd = 4, .Rs1 = 5}), fadd(5, 3, 1)});
  S.x(5, 0xFFFFFFF9U).f(1, 0.5F).run(); // -7
  for (const unsigned N : {0U, 2U})
    EXPECT_EQ(S.at(N).ErrorMax, 0) << N;
  EXPECT_GT(S.at(1).ErrorMax, 0);
  EXPECT_LT(S.at(1).ErrorMax, 0x1p-24);
}

TEST(CoreShadow, ShadowsPassThroughIntegerRegistersAndMemory) {
  LostDigits S({toX(5, 3), encode(Op::RV_ADDI, {.Rd = 6, .Rs1 = 5}), store(6),
                load(7), toF(4, 7), fsub(4, 4, 1)});
  S.run();
  EXPECT_EQ(S.at(6).Born, AllLanes);
}

TEST(CoreShadow, AnIntegerOfTheSameBitsHasNoShadow) {
  LostDigits S(
      {toX(5, 3), store(5), store(9), load(7), toF(4, 7), fsub(4, 4, 1)});
  S.x(9, bits(1e7F)).run();
  EXPECT_EQ(S.at(6).Born, 0U);
  EXPECT_EQ(S.at(6).ErrorMax, 0);
}

TEST(CoreShadow, ByteStoresAndTheHostDropShadows) {
  const std::vector<uint32_t> ByByte = {
      toX(5, 3),
      store(5),
      encode(Op::RV_SB, {.Rs1 = 10, .Rs2 = 5, .Imm = Scratch}),
      load(7),
      toF(4, 7),
      fsub(4, 4, 1)};
  LostDigits S(ByByte);
  S.run();
  EXPECT_EQ(S.at(6).ErrorMax, 0);

  ShadowMemory M;
  M.begin(2);
  for (const uint32_t Address : {0x10FFCU, 0x11000U, 0x11004U, VX_LOCAL_BASE})
    M.set(1, Address, {0.5, 7, 2});
  EXPECT_NE(M.find(0, 0x10FFC, 7), nullptr);
  EXPECT_EQ(M.find(0, 0x10FFC, 8), nullptr) << "other bits";
  EXPECT_NE(M.find(1, VX_LOCAL_BASE, 7), nullptr);
  EXPECT_EQ(M.find(0, VX_LOCAL_BASE, 7), nullptr) << "another core's";
  M.drop(0, 0x10FFE, 5);
  EXPECT_EQ(M.find(0, 0x10FFC, 7), nullptr);
  EXPECT_EQ(M.find(0, 0x11000, 7), nullptr);
  EXPECT_NE(M.find(0, 0x11004, 7), nullptr);
}

TEST(CoreShadow, SignAndExponentMayChangeInIntegers) {
  // (-(f3) * 2^3) / -2^3 - f1
  LostDigits S({toX(5, 3), encode(Op::RV_XOR, {.Rd = 5, .Rs1 = 5, .Rs2 = 8}),
                encode(Op::RV_ADD, {.Rd = 5, .Rs1 = 5, .Rs2 = 9}), toF(4, 5),
                fdiv(4, 4, 2), fsub(4, 4, 1)});
  S.f(2, 0.1F).x(8, 0x80000000U).x(9, 3U << 23).f(7, -8);
  S.run();
  // -8e7.8 / 0.1
  EXPECT_LT(S.at(5).ErrorMax, 1e-6) << "a shadow of another sign or size";
  EXPECT_GT(S.at(5).ErrorMax, 1e-9) << "no shadow at all";
}

TEST(CoreShadow, SelectionsByMaskKeepTheShadow) {
  LostDigits S({toX(5, 3),
                encode(Op::RV_CZERO_EQZ, {.Rd = 6, .Rs1 = 5, .Rs2 = 8}),
                encode(Op::RV_CZERO_NEZ, {.Rd = 7, .Rs1 = 9, .Rs2 = 8}),
                encode(Op::RV_OR, {.Rd = 6, .Rs1 = 6, .Rs2 = 7}), toF(4, 6),
                fsub(4, 4, 1)});
  S.x(8, 1).x(9, bits(3)).run();
  EXPECT_EQ(S.at(6).Born, AllLanes);
}

TEST(CoreShadow, MinMaxAndSignsKeepTheShadow) {
  LostDigits S({encode(Op::RV_FMAX_S, {.Rd = 4, .Rs1 = 3, .Rs2 = 1}),
                encode(Op::RV_FSGNJN_S, {.Rd = 4, .Rs1 = 4, .Rs2 = 4}),
                encode(Op::RV_FSGNJX_S, {.Rd = 4, .Rs1 = 4, .Rs2 = 4}),
                fsub(4, 4, 1)});
  S.run();
  EXPECT_EQ(S.at(4).Born, AllLanes);
}

TEST(CoreShadow, ShufflesTakeTheOtherLanesShadow) {
  LostDigits S({toX(5, 3),
                // Lane 0's value to all.
                encode(Op::VX_SHFL_IDX, {.Rd = 6, .Rs1 = 5, .Rs2 = 9}),
                toF(4, 6), fsub(4, 4, 1)});
  Lanes16 Small = all(0);
  Small[0] = bits(0.1F);
  S.Run.setF(2, Small); // the others have nothing to lose
  S.x(9, 15U << 6).run();
  EXPECT_EQ(S.at(4).Born, AllLanes);
}

TEST(CoreShadow, AtomicsKeepTheShadow) {
  // Lane addresses apart, x12.
  Lanes16 Addresses;
  for (unsigned L = 0; L != MaxLanes; ++L)
    Addresses[L] = VX_LOCAL_BASE + 4 * L;
  LostDigits S(
      {toX(5, 3), encode(Op::RV_AMOSWAP_W, {.Rd = 6, .Rs1 = 12, .Rs2 = 5}),
       encode(Op::RV_AMOCAS_W, {.Rd = 5, .Rs1 = 12, .Rs2 = 9}), toF(4, 5),
       fsub(4, 4, 1), encode(Op::RV_LW, {.Rd = 7, .Rs1 = 12}), toF(4, 7),
       fsub(4, 4, 1)});
  S.x(9, bits(1e7F));
  S.Run.setX(12, Addresses);
  S.run();
  EXPECT_EQ(S.at(5).Born, AllLanes) << "what the compare-exchange returned";
  EXPECT_EQ(S.at(8).Born, 0U) << "what it stored";
}

TEST(CoreShadow, RoundingToWholeNumbersByShiftIsMeant) {
  Shadowed S({fadd(3, 1, 2), fsub(4, 3, 2), fsub(5, 1, 4)});
  S.f(1, 2.3F).f(2, 12582912.0F).run();
  for (const unsigned N : {0U, 1U, 2U}) {
    EXPECT_EQ(S.at(N).Born, 0U) << N;
    EXPECT_LT(S.at(N).ErrorMax, 1e-6) << N;
  }
}

TEST(CoreShadow, CompensationTermsAreResidues) {
  // Two-sum: s = a + b, v = s - a, e = (a - (s - v)) + (b - v).
  Shadowed S({fadd(3, 1, 2), fsub(4, 3, 1), fsub(5, 3, 4), fsub(5, 1, 5),
              fsub(6, 2, 4), fadd(5, 5, 6), fadd(7, 3, 5)});
  S.f(1, 3.1415927F).f(2, 0.00271828F).run();
  EXPECT_EQ(S.at(4).Born, 0U);
  EXPECT_EQ(S.at(4).Residues, AllLanes);
  EXPECT_EQ(S.at(5).Born + S.at(5).Inherited, 0U);
  EXPECT_EQ(S.at(5).ErrorMax, 0) << "what comes of a residue is no error";
  EXPECT_LT(S.at(6).ErrorMax, 0x1p-23) << "the sum is as it should be";
}

TEST(CoreShadow, ChangesNoRegisterAndNoFlag) {
  // Random float instructions on random bits, in every rounding mode.
  constexpr Op Ops[] = {
      Op::RV_FADD_S,   Op::RV_FSUB_S,   Op::RV_FMUL_S,    Op::RV_FDIV_S,
      Op::RV_FSQRT_S,  Op::RV_FMADD_S,  Op::RV_FNMSUB_S,  Op::RV_FMIN_S,
      Op::RV_FMAX_S,   Op::RV_FSGNJX_S, Op::RV_FLT_S,     Op::RV_FCVT_W_S,
      Op::RV_FCVT_S_W, Op::RV_FMV_X_W,  Op::RV_FMV_W_X,   Op::RV_FCLASS_S,
      Op::RV_XOR,      Op::RV_ADD,      Op::VX_SHFL_BFLY, Op::RV_CZERO_EQZ};
  std::mt19937 Random(7);
  const auto Below = [&](unsigned N) {
    return static_cast<unsigned>(Random() % N);
  };
  for (unsigned Round = 0; Round != 20; ++Round) {
    std::vector<uint32_t> Words;
    for (unsigned N = 0; N != 60; ++N)
      Words.push_back(encode(Ops[Below(std::size(Ops))], {.Rd = 1 + Below(7),
                                                          .Rs1 = 1 + Below(7),
                                                          .Rs2 = 1 + Below(7),
                                                          .Rs3 = 1 + Below(7),
                                                          .Rm = Below(5)}));
    WarpRunner Plain(execTable(true), Words);
    Shadowed S(Words);
    for (unsigned N = 0; N != 32; ++N) {
      Lanes16 F, X;
      for (unsigned L = 0; L != MaxLanes; ++L) {
        F[L] = Random();
        X[L] = Random();
      }
      for (WarpRunner *R : {&Plain, &S.Run}) {
        R->setF(N, F);
        if (N)
          R->setX(N, X);
      }
    }
    const uint32_t Mask = Random() & 0xFFFF;
    for (WarpRunner *R : {&Plain, &S.Run}) {
      R->setActive(Mask ? Mask : 1);
      R->run();
      EXPECT_TRUE(R->ranToEnd());
    }
    EXPECT_EQ(Plain.warp().Fflags, S.Run.warp().Fflags) << Round;
    for (unsigned N = 0; N != 32; ++N) {
      EXPECT_EQ(Plain.getF(N), S.Run.getF(N)) << Round << " f" << N;
      EXPECT_EQ(Plain.getX(N), S.Run.getX(N)) << Round << " x" << N;
    }
  }
}
