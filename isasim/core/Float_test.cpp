/// Single precision on every vector level and mask: results and flags against
/// the integer implementation, and docs/decisions.md, 11 by name.

#include "core/SoftFloat.h"
#include "testing/WarpRunner.h"

#include <bit>
#include <functional>
#include <map>
#include <random>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr uint32_t Sign = 0x80000000, One = 0x3F800000, Inf = 0x7F800000,
                   QuietNan = 0x7FC01234, SignalingNan = 0x7F801234;
constexpr unsigned Dyn = DynamicRm;

using Scalar = std::function<uint32_t(uint32_t A, uint32_t B, uint32_t C,
                                      unsigned Rm, uint32_t &Flags)>;

uint32_t minMax(uint32_t A, uint32_t B, bool Min, uint32_t &Flags) {
  if (isSignalingNan(A) || isSignalingNan(B))
    Flags |= Invalid;
  if (isNan(A))
    return isNan(B) ? CanonicalNan : B;
  if (isNan(B))
    return A;
  const auto X = std::bit_cast<float>(A), Y = std::bit_cast<float>(B);
  if (X == Y) // also zeros of different sign
    return Min == ((A & Sign) != 0) ? A : B;
  return (X < Y) == Min ? A : B;
}

uint32_t compare(uint32_t A, uint32_t B, Op O, uint32_t &Flags) {
  const bool Quiet = O == Op::RV_FEQ_S;
  if (isNan(A) || isNan(B)) {
    if (!Quiet || isSignalingNan(A) || isSignalingNan(B))
      Flags |= Invalid;
    return 0;
  }
  const auto X = std::bit_cast<float>(A), Y = std::bit_cast<float>(B);
  return O == Op::RV_FEQ_S ? X == Y : O == Op::RV_FLT_S ? X < Y : X <= Y;
}

/// fclass.s, RISC-V F, table "Format of result of FCLASS".
uint32_t classify(uint32_t A) {
  const bool Negative = A & Sign;
  const uint32_t Exponent = A >> 23 & 0xFF, Fraction = A & 0x7FFFFF;
  if (Exponent == 255)
    return Fraction == 0 ? 1U << (Negative ? 0 : 7)
                         : 1U << (Fraction >> 22 ? 9 : 8);
  if (Exponent == 0)
    return Fraction == 0 ? 1U << (Negative ? 3 : 4) : 1U << (Negative ? 2 : 5);
  return 1U << (Negative ? 1 : 6);
}

const std::map<Op, Scalar> &reference() {
  static const std::map<Op, Scalar> Table = {
      {Op::RV_FADD_S, [](auto A, auto B, auto, auto Rm,
                         auto &F) { return softAdd(A, B, Rm, F); }},
      {Op::RV_FSUB_S, [](auto A, auto B, auto, auto Rm,
                         auto &F) { return softAdd(A, B ^ Sign, Rm, F); }},
      {Op::RV_FMUL_S, [](auto A, auto B, auto, auto Rm,
                         auto &F) { return softMul(A, B, Rm, F); }},
      {Op::RV_FDIV_S, [](auto A, auto B, auto, auto Rm,
                         auto &F) { return softDiv(A, B, Rm, F); }},
      {Op::RV_FSQRT_S,
       [](auto A, auto, auto, auto Rm, auto &F) { return softSqrt(A, Rm, F); }},
      {Op::RV_FMADD_S, [](auto A, auto B, auto C, auto Rm,
                          auto &F) { return softFma(A, B, C, Rm, F); }},
      {Op::RV_FMSUB_S, [](auto A, auto B, auto C, auto Rm,
                          auto &F) { return softFma(A, B, C ^ Sign, Rm, F); }},
      {Op::RV_FNMSUB_S, [](auto A, auto B, auto C, auto Rm,
                           auto &F) { return softFma(A ^ Sign, B, C, Rm, F); }},
      {Op::RV_FNMADD_S,
       [](auto A, auto B, auto C, auto Rm, auto &F) {
         return softFma(A ^ Sign, B, C ^ Sign, Rm, F);
       }},
      {Op::RV_FSGNJ_S, [](auto A, auto B, auto, auto,
                          auto &) { return (A & ~Sign) | (B & Sign); }},
      {Op::RV_FSGNJN_S, [](auto A, auto B, auto, auto,
                           auto &) { return (A & ~Sign) | (~B & Sign); }},
      {Op::RV_FSGNJX_S,
       [](auto A, auto B, auto, auto, auto &) { return A ^ (B & Sign); }},
      {Op::RV_FMIN_S, [](auto A, auto B, auto, auto,
                         auto &F) { return minMax(A, B, true, F); }},
      {Op::RV_FMAX_S, [](auto A, auto B, auto, auto,
                         auto &F) { return minMax(A, B, false, F); }},
      {Op::RV_FEQ_S, [](auto A, auto B, auto, auto,
                        auto &F) { return compare(A, B, Op::RV_FEQ_S, F); }},
      {Op::RV_FLT_S, [](auto A, auto B, auto, auto,
                        auto &F) { return compare(A, B, Op::RV_FLT_S, F); }},
      {Op::RV_FLE_S, [](auto A, auto B, auto, auto,
                        auto &F) { return compare(A, B, Op::RV_FLE_S, F); }},
      {Op::RV_FCVT_W_S, [](auto A, auto, auto, auto Rm,
                           auto &F) { return softToInt(A, true, Rm, F); }},
      {Op::RV_FCVT_WU_S, [](auto A, auto, auto, auto Rm,
                            auto &F) { return softToInt(A, false, Rm, F); }},
      {Op::RV_FCVT_S_W, [](auto A, auto, auto, auto Rm,
                           auto &F) { return softFromInt(A, true, Rm, F); }},
      {Op::RV_FCVT_S_WU, [](auto A, auto, auto, auto Rm,
                            auto &F) { return softFromInt(A, false, Rm, F); }},
      {Op::RV_FMV_X_W, [](auto A, auto, auto, auto, auto &) { return A; }},
      {Op::RV_FMV_W_X, [](auto A, auto, auto, auto, auto &) { return A; }},
      {Op::RV_FCLASS_S,
       [](auto A, auto, auto, auto, auto &) { return classify(A); }},
  };
  return Table;
}

/// Specials and neighbours as often as noise; small exponents' differences, so
/// that sums round. \p Calm leaves out what raises flags often, so that the
/// fast path of whole warps is tried as well.
Lanes16 operands(std::mt19937 &Random, bool Calm) {
  static constexpr uint32_t Special[] = {
      0,          Sign,       One,          One | Sign, Inf,        Inf | Sign,
      QuietNan,   0xFFC00000, SignalingNan, 1,          0x80000001, 0x007FFFFF,
      0x00800000, 0x7F7FFFFF, 0x4F000000,   0xCF000000, 0x4F800000, 0xBF000000,
      0x40200000, 0xC0200000, 0x33800000,   0x4EFFFFFF, 0x3EFFFFFF, 0x80800000};
  Lanes16 V;
  for (uint32_t &Lane : V)
    if (Calm)
      Lane = 0x3F000000 + Random() % 0x04000000 + (Random() % 2 << 31);
    else
      Lane = Random() % 2 ? static_cast<uint32_t>(Random())
                          : Special[Random() % std::size(Special)];
  return V;
}

constexpr uint32_t Untouched = 0xDEADBEEF;

/// Runs the instruction under frm and its static mode on one mask.
void check(WarpRunner &R, Op O, unsigned Rm, unsigned Frm, uint32_t Mask,
           const std::array<Lanes16, 3> &In) {
  const InsnInfo &Info = InsnTable[static_cast<unsigned>(O)];
  Lanes16 Old;
  Old.fill(Untouched);
  Info.Rd == File::F ? R.setF(12, Old) : R.setX(12, Old);
  for (unsigned N = 0; N != 3; ++N)
    Info.Rs1 == File::F ? R.setF(9 + N, In[N]) : R.setX(9 + N, In[N]);
  R.setActive(Mask);
  R.rewind();
  R.warp().Frm = Frm;
  R.run();
  ASSERT_TRUE(R.ranToEnd());
  const Lanes16 Got = Info.Rd == File::F ? R.getF(12) : R.getX(12);
  uint32_t Flags = 0;
  for (unsigned L = 0; L != MaxLanes; ++L) {
    const uint32_t Want = Mask >> L & 1
                              ? reference().at(O)(In[0][L], In[1][L], In[2][L],
                                                  Rm == Dyn ? Frm : Rm, Flags)
                              : Untouched;
    ASSERT_EQ(Got[L], Want)
        << Info.Mnemonic << " on " << R.Exec.Level << std::hex << " "
        << In[0][L] << " " << In[1][L] << " " << In[2][L] << " rm " << Rm
        << " frm " << Frm << " mask " << Mask << " lane " << L;
  }
  ASSERT_EQ(R.warp().Fflags, Flags)
      << Info.Mnemonic << " on " << R.Exec.Level << " rm " << Rm << " frm "
      << Frm << std::hex << " mask " << Mask;
}

uint32_t word(Op O, unsigned Rm) {
  return encode(O, {.Rd = 12, .Rs1 = 9, .Rs2 = 10, .Rs3 = 11, .Rm = Rm});
}

void fill(WarpRunner &R, uint32_t A, uint32_t B, uint32_t C = 0) {
  for (const auto &[Register, Bits] :
       {std::pair(9U, A), std::pair(10U, B), std::pair(11U, C)}) {
    Lanes16 V;
    V.fill(Bits);
    R.setF(Register, V);
    R.setX(Register, V);
  }
}

/// Result of lane 0 and flags of one instruction with all lanes alike.
std::pair<uint32_t, uint32_t> runOne(const ExecTable &Table, Op O, unsigned Rm,
                                     uint32_t A, uint32_t B, uint32_t C = 0) {
  WarpRunner R(Table, {word(O, Rm)});
  fill(R, A, B, C);
  R.run();
  const bool ToF = InsnTable[static_cast<unsigned>(O)].Rd == File::F;
  return {ToF ? R.getF(12)[0] : R.getX(12)[0], R.warp().Fflags};
}

} // namespace

TEST(Float, EveryInstructionInEveryModeOnEveryMask) {
  std::mt19937 Random(11);
  for (const ExecTable *Table : allTables())
    for (const auto &[O, Expected] : reference()) {
      const bool Rounds = InsnTable[static_cast<unsigned>(O)].HasRm;
      for (const unsigned Rm :
           std::initializer_list<unsigned>{Rne, Rtz, Rdn, Rup, Rmm, Dyn}) {
        if (!Rounds && Rm != Dyn)
          continue;
        WarpRunner R(*Table, {Rounds ? word(O, Rm) : word(O, 0)});
        for (unsigned Frm = 0; Frm != 5; ++Frm)
          for (const uint32_t Mask : MaskPatterns)
            for (const bool Calm : {false, true, false}) {
              const std::array<Lanes16, 3> In = {operands(Random, Calm),
                                                 operands(Random, Calm),
                                                 operands(Random, Calm)};
              check(R, O, Rm, Frm, Mask, In);
              if (::testing::Test::HasFatalFailure())
                return;
            }
      }
    }
}

TEST(Float, TableCoversEveryFloatInstruction) {
  for (unsigned N = 0; N != NumOps; ++N) {
    const InsnInfo &I = InsnTable[N];
    const uint32_t Opcode = I.Match & 0x7F;
    if (Opcode == 0x53 || (Opcode >= 0x43 && Opcode <= 0x4F))
      EXPECT_TRUE(reference().contains(static_cast<Op>(N))) << I.Mnemonic;
  }
}

TEST(Float, InfinityTimesZeroPlusQuietNanIsInvalid) {
  for (const ExecTable *Table : allTables())
    EXPECT_EQ(runOne(*Table, Op::RV_FMADD_S, Dyn, Inf, 0, QuietNan),
              std::pair(CanonicalNan, uint32_t{Invalid}))
        << Table->Level;
}

TEST(Float, NanResultsAreCanonical) {
  for (const ExecTable *Table : allTables()) {
    EXPECT_EQ(runOne(*Table, Op::RV_FADD_S, Dyn, QuietNan, One),
              std::pair(CanonicalNan, 0U));
    EXPECT_EQ(runOne(*Table, Op::RV_FSUB_S, Dyn, Inf, Inf),
              std::pair(CanonicalNan, uint32_t{Invalid}));
    EXPECT_EQ(runOne(*Table, Op::RV_FSQRT_S, Dyn, One | Sign, 0),
              std::pair(CanonicalNan, uint32_t{Invalid}));
    EXPECT_EQ(runOne(*Table, Op::RV_FMUL_S, Dyn, SignalingNan, One),
              std::pair(CanonicalNan, uint32_t{Invalid}));
  }
}

TEST(Float, MinAndMaxOrderZerosAndIgnoreOneNan) {
  for (const ExecTable *Table : allTables()) {
    EXPECT_EQ(runOne(*Table, Op::RV_FMIN_S, 0, 0, Sign), std::pair(Sign, 0U));
    EXPECT_EQ(runOne(*Table, Op::RV_FMAX_S, 1, Sign, 0), std::pair(0U, 0U));
    EXPECT_EQ(runOne(*Table, Op::RV_FMIN_S, 0, QuietNan, One),
              std::pair(One, 0U));
    EXPECT_EQ(runOne(*Table, Op::RV_FMAX_S, 1, One, SignalingNan),
              std::pair(One, uint32_t{Invalid}));
    EXPECT_EQ(runOne(*Table, Op::RV_FMAX_S, 1, QuietNan, 0xFFC00000),
              std::pair(CanonicalNan, 0U));
  }
}

TEST(Float, ConversionsToIntegersSaturate) {
  for (const ExecTable *Table : allTables()) {
    const uint32_t Nv = Invalid;
    EXPECT_EQ(runOne(*Table, Op::RV_FCVT_W_S, Rtz, QuietNan, 0),
              std::pair(0x7FFFFFFFU, Nv));
    EXPECT_EQ(runOne(*Table, Op::RV_FCVT_W_S, Rtz, Inf | Sign, 0),
              std::pair(0x80000000U, Nv));
    EXPECT_EQ(runOne(*Table, Op::RV_FCVT_W_S, Rtz, 0xCF000000, 0),
              std::pair(0x80000000U, 0U));
    EXPECT_EQ(runOne(*Table, Op::RV_FCVT_WU_S, Rtz, One | Sign, 0),
              std::pair(0U, Nv));
    EXPECT_EQ(runOne(*Table, Op::RV_FCVT_WU_S, Rdn, 0xBF000000, 0),
              std::pair(0U, Nv)); // rounds to -1 first
    EXPECT_EQ(runOne(*Table, Op::RV_FCVT_WU_S, Rtz, 0x4F800000, 0),
              std::pair(0xFFFFFFFFU, Nv));
  }
}

TEST(Float, NearestAwayIsExact) {
  for (const ExecTable *Table : allTables()) {
    EXPECT_EQ(runOne(*Table, Op::RV_FADD_S, Rmm, One, 0x33800000).first,
              0x3F800001U);
    EXPECT_EQ(runOne(*Table, Op::RV_FCVT_W_S, Rmm, 0x40200000, 0).first, 3U);
    EXPECT_EQ(runOne(*Table, Op::RV_FCVT_W_S, Rne, 0x40200000, 0).first, 2U);
  }
}

TEST(Float, StaticModeWinsOverFrm) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {word(Op::RV_FADD_S, Rup)});
    fill(R, One, 1);
    R.warp().Frm = Rdn;
    R.run();
    EXPECT_EQ(R.getF(12)[3], 0x3F800001U);
  }
}

TEST(Float, InactiveLanesRaiseNoFlags) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {word(Op::RV_FDIV_S, Dyn)});
    Lanes16 Divisors{}; // zero in every lane but two
    Divisors[3] = Divisors[7] = One;
    Lanes16 Ones;
    Ones.fill(One);
    R.setF(9, Ones);
    R.setF(10, Divisors);
    R.setActive(0x0088);
    R.run();
    EXPECT_EQ(R.warp().Fflags, 0U) << Table->Level;
    R.rewind();
    R.setActive(0x0188);
    R.run();
    EXPECT_EQ(R.warp().Fflags, uint32_t{DivideByZero}) << Table->Level;
  }
}

TEST(Float, FlagsAccumulateInFcsr) {
  for (const ExecTable *Table : allTables()) {
    // fdiv (divide by zero), fadd (inexact), csrr a0, fflags; csrw fflags, 0;
    // csrr a1, fcsr.
    WarpRunner R(*Table,
                 {word(Op::RV_FDIV_S, Dyn),
                  encode(Op::RV_FADD_S, {.Rd = 13, .Rs1 = 9, .Rs2 = 11}),
                  encode(Op::RV_CSRRS, {.Rd = 20, .Rs1 = 0, .Csr = 1}),
                  encode(Op::RV_CSRRWI, {.Rd = 0, .Imm = 0, .Csr = 1}),
                  encode(Op::RV_CSRRWI, {.Rd = 0, .Imm = 2, .Csr = 2}),
                  encode(Op::RV_CSRRS, {.Rd = 21, .Rs1 = 0, .Csr = 3})});
    fill(R, One, 0, 1);
    R.run();
    EXPECT_EQ(R.getX(20)[5], DivideByZero | Inexact) << Table->Level;
    EXPECT_EQ(R.getX(21)[5], 2U << 5) << Table->Level;
  }
}

TEST(Float, FrmAppliesFromTheNextInstruction) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {word(Op::RV_FADD_S, Dyn),
                  encode(Op::RV_CSRRWI, {.Rd = 0, .Imm = 3, .Csr = 2}),
                  encode(Op::RV_FADD_S, {.Rd = 13, .Rs1 = 9, .Rs2 = 10}),
                  encode(Op::RV_CSRRWI, {.Rd = 0, .Imm = 4, .Csr = 2}),
                  encode(Op::RV_FADD_S, {.Rd = 14, .Rs1 = 9, .Rs2 = 11})});
    fill(R, One, 1, 0x33800000);
    R.run();
    EXPECT_EQ(R.getF(12)[0], One);
    EXPECT_EQ(R.getF(13)[0], 0x3F800001U);
    EXPECT_EQ(R.getF(14)[0], 0x3F800001U);
  }
}

TEST(Float, ReservedFrmMakesDynamicInstructionsIllegal) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::RV_CSRRWI, {.Rd = 0, .Imm = 5, .Csr = 2}),
                          word(Op::RV_FADD_S, Rne), word(Op::RV_FADD_S, Dyn)});
    R.run();
    EXPECT_EQ(R.cause(), TrapCause::IllegalInstruction);
    EXPECT_EQ(R.warp().pcOf(R.warp().Next), VX_IMAGE_BASE + 8);
  }
}
