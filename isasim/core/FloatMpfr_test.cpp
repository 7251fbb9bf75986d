/// Every floating-point instruction, interpreted and translated, against exact
/// arithmetic (MPFR): boundary values exhaustively, and random operands of the
/// kinds at which roundings go wrong.
///
/// The environment variable VORION_FLOAT_OPERANDS sets how many random operands
/// an instruction and rounding mode get (the long run is 100000), and
/// VORION_FLOAT_SEED where they begin.

#include "testing/MpfrOracle.h"
#include "testing/Setting.h"
#include "testing/WarpRunner.h"
#include "translate/Translator.h"

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr uint32_t SignBit = 0x80000000;
constexpr unsigned NumModes = 5; // with rmm
constexpr unsigned Dyn = 7;

/// Fractions at which roundings change: a few bits at either end.
uint32_t fraction(std::mt19937 &Random) {
  switch (Random() % 5) {
  case 0:
    return 0;
  case 1: // one bit
    return 1U << Random() % 23;
  case 2: // all ones above a place
    return 0x7FFFFF & ~0U << Random() % 24;
  case 3: // products of these have half as their lower half
    return (Random() % 4096) << 11;
  default:
    return Random() & 0x7FFFFF;
  }
}

uint32_t make(std::mt19937 &Random, int Exponent) {
  const auto Biased = static_cast<uint32_t>(std::clamp(Exponent, 0, 254));
  return (Random() % 2 << 31) | Biased << 23 | fraction(Random);
}

uint32_t anyFloat(std::mt19937 &Random) {
  switch (Random() % 8) {
  case 0: // infinities, NaNs, zeros
    return (Random() % 2 << 31) |
           std::array{0U, 0x7F800000U, 0x7FC00000U, 0x7F800001U}[Random() % 4];
  case 1: // subnormal or nearly
    return make(Random, static_cast<int>(Random() % 3));
  case 2: // huge
    return make(Random, 254 - static_cast<int>(Random() % 3));
  case 3: // about one
    return make(Random, 127 + static_cast<int>(Random() % 5) - 2);
  case 4: // a whole number or half of one, or as large as integers are
    return make(Random, 126 + static_cast<int>(Random() % 34));
  default:
    return static_cast<uint32_t>(Random());
  }
}

int exponentOf(uint32_t Bits) { return static_cast<int>(Bits >> 23 & 0xFF); }

using Triple = std::array<uint32_t, 3>;

/// Operands that go together: so that sums cancel or just reach each other's
/// last places, products and quotients lie at the ends of the range or between
/// two floats, and roots and integers are nearly exact.
Triple related(std::mt19937 &Random) {
  Triple V = {anyFloat(Random), anyFloat(Random), anyFloat(Random)};
  const auto Near = static_cast<int>(Random() % 56) - 28;
  const uint32_t Nudge = Random() % 5 - 2;
  switch (Random() % 8) {
  case 0: // a sum's terms
    V[1] = make(Random, exponentOf(V[0]) + Near);
    break;
  case 1: // a product or a quotient at the top or at the bottom
    V[1] =
        make(Random, (Random() % 2 ? 381 : 127) + Near / 4 - exponentOf(V[0]));
    break;
  case 2:
    V[1] =
        make(Random, exponentOf(V[0]) + (Random() % 2 ? -127 : 127) + Near / 4);
    break;
  case 3: { // a product and what cancels it, or nearly
    V[0] = make(Random, 64 + static_cast<int>(Random() % 128));
    V[1] = make(Random, 64 + static_cast<int>(Random() % 128));
    const float Product =
        std::bit_cast<float>(V[0]) * std::bit_cast<float>(V[1]);
    V[2] = (std::bit_cast<uint32_t>(Product) ^ (Random() % 2 << 31)) + Nudge;
    break;
  }
  case 4: // a product and an addend that reaches its last places
    V[2] = make(Random, exponentOf(V[0]) + exponentOf(V[1]) - 127 + Near);
    break;
  case 5: { // nearly a square, nearly a multiple
    const float Root = 1.0F + static_cast<float>(Random() % 4096) / 2048.0F;
    V[0] = std::bit_cast<uint32_t>(Root * Root) + Nudge;
    V[1] = std::bit_cast<uint32_t>(Root);
    break;
  }
  case 6: // an integer at which conversions round, overflow or wrap
    V[0] = (Random() % 2 ? 0U : ~0U) ^ ((1U << Random() % 32) + Nudge);
    break;
  default:
    break;
  }
  return V;
}

/// Where something changes, with either sign.
std::vector<uint32_t> boundaries() {
  std::vector<uint32_t> V;
  for (const uint32_t Bits :
       {0x00000000U, 0x00000001U, 0x00400000U, 0x007FFFFFU, 0x00800000U,
        0x00800001U, 0x33800000U, 0x34000000U, 0x3F000000U, 0x3F7FFFFFU,
        0x3F800000U, 0x3F800001U, 0x3FC00000U, 0x4B000000U, 0x4B7FFFFFU,
        0x4EFFFFFFU, 0x4F000000U, 0x4F7FFFFFU, 0x4F800000U, 0x7EFFFFFFU,
        0x7F000000U, 0x7F7FFFFFU, 0x7F800000U, 0x7F800001U, 0x7FC00000U})
    for (const uint32_t Sign : {0U, SignBit})
      V.push_back(Bits | Sign);
  return V;
}
/// Fewer, for three operands at once.
constexpr uint32_t FewBoundaries[] = {
    0x00000000, 0x00000001, 0x007FFFFF, 0x00800000, 0x33800000,
    0x3F7FFFFF, 0x3F800000, 0x3F800001, 0x5F000000, 0x7F7FFFFF,
    0x7F800000, 0x7F800001, 0x7FC00000};

bool isFloat(const InsnInfo &I) {
  const uint32_t Opcode = I.Match & 0x7F;
  return Opcode == 0x53 || (Opcode >= 0x43 && Opcode <= 0x4F);
}

/// What executes an instruction: a vector level, or a translation.
struct Runner {
  std::unique_ptr<WarpRunner> Of;
  std::unique_ptr<Translator> Translation; ///< or nullptr
  bool IsStatic; ///< the rounding mode is the instruction's, and frm another
  std::string Name;
};

/// One instruction in one rounding mode on every vector level and translated
/// for every kind of vectors, with the mode in the instruction and in frm.
class Checker {
public:
  Checker(Op OIn, unsigned RmIn)
      : O(OIn), Info(InsnTable[static_cast<unsigned>(OIn)]), Rm(RmIn) {
    for (const ExecTable *Table : allTables())
      for (const unsigned Field : {Rm, Dyn})
        if (Info.HasRm || Field == Dyn)
          Runners.push_back({std::make_unique<WarpRunner>(
                                 *Table, std::vector{instruction(Field)}),
                             nullptr, Field != Dyn, Table->Level});
    for (const VectorUnit Unit : {VectorUnit::Avx2, VectorUnit::Avx512})
      if (Unit <= Translator::unitOfHost())
        for (const unsigned Field : {Rm, Dyn})
          if (Info.HasRm || Field == Dyn)
            addTranslated(Unit, Field);
  }

  /// Adds operands; runs them when there are enough for a warp.
  void add(const Triple &V) {
    for (unsigned N = 0; N != 3; ++N)
      In[N][Lanes] = V[N];
    Want[Lanes] = oracle(O, V[0], V[1], V[2], Rm);
    if (++Lanes == MaxLanes)
      flush();
  }

  void flush() {
    if (Lanes == 0)
      return;
    Count += Lanes;
    for (size_t N = 0; N != Runners.size(); ++N) {
      runLanes(Runners[N], (1U << Lanes) - 1);
      // Alone, so that no other lane's flags hide one that is missing.
      if (N < 2 || Runners[N].Translation)
        for (unsigned L = 0; L != Lanes; ++L)
          runLanes(Runners[N], 1U << L);
    }
    Lanes = 0;
  }

  uint64_t Count = 0;

private:
  uint32_t instruction(unsigned Field) const {
    return encode(O, {.Rd = 12, .Rs1 = 9, .Rs2 = 10, .Rs3 = 11, .Rm = Field});
  }

  /// Behind enough others for a translation.
  void addTranslated(VectorUnit Unit, unsigned Field) {
    std::vector<uint32_t> Words(15, encode(Op::RV_ADDI, {.Rd = 5, .Rs1 = 6}));
    Words.push_back(instruction(Field));
    const ExecTable &Exec = execTable(false);
    auto R = std::make_unique<WarpRunner>(Exec, Words);
    auto T = std::make_unique<Translator>(R->Code, Exec, Translator::UsualCost,
                                          Unit);
    T->seen(R->Code.begin(), UINT64_MAX);
    EXPECT_EQ(T->regions(), 1U);
    Runners.push_back(
        {std::move(R), std::move(T), Field != Dyn,
         Unit == VectorUnit::Avx2 ? "translation with AVX2" : "translation"});
  }

  void runLanes(Runner &Which, uint32_t Mask) {
    WarpRunner &R = *Which.Of;
    for (unsigned N = 0; N != 3; ++N)
      Info.Rs1 == File::F ? R.setF(9 + N, In[N]) : R.setX(9 + N, In[N]);
    R.setActive(Mask);
    R.rewind();
    // Translations are executed while frm is 0.
    R.warp().Frm = !Which.IsStatic     ? Rm
                   : Which.Translation ? 0
                                       : (Rm + 1) % NumModes;
    R.run();
    const Lanes16 Got = Info.Rd == File::F ? R.getF(12) : R.getX(12);
    uint32_t Flags = 0;
    for (unsigned L = 0; L != MaxLanes; ++L) {
      if (!(Mask >> L & 1))
        continue;
      Flags |= Want[L].Flags;
      ASSERT_EQ(Got[L], Want[L].Bits)
          << Info.Mnemonic << " on " << Which.Name << std::hex << " "
          << In[0][L] << " " << In[1][L] << " " << In[2][L] << " rm " << Rm
          << (Which.IsStatic ? " in the word" : " in frm");
    }
    ASSERT_EQ(R.warp().Fflags, Flags)
        << Info.Mnemonic << " on " << Which.Name << std::hex << " " << In[0][0]
        << " " << In[1][0] << " " << In[2][0] << " rm " << Rm << " mask "
        << Mask;
  }

  Op O;
  const InsnInfo &Info;
  unsigned Rm;
  std::vector<Runner> Runners;
  std::array<Lanes16, 3> In{};
  std::array<OracleResult, MaxLanes> Want{};
  unsigned Lanes = 0;
};

/// Calls F(checker, number of operands) for every instruction and mode.
template <typename Function> uint64_t forEachMode(Function F) {
  uint64_t Count = 0;
  for (unsigned N = 0; N != NumOps; ++N) {
    const InsnInfo &Info = InsnTable[N];
    if (!isFloat(Info))
      continue;
    const unsigned Operands = Info.Rs3 != File::None   ? 3
                              : Info.Rs2 != File::None ? 2
                                                       : 1;
    for (unsigned Rm = 0; Rm != (Info.HasRm ? NumModes : 1); ++Rm) {
      Checker C(static_cast<Op>(N), Rm);
      F(C, Operands);
      C.flush();
      Count += C.Count;
      if (::testing::Test::HasFatalFailure())
        return Count;
    }
  }
  return Count;
}

} // namespace

TEST(FloatMpfr, BoundaryValues) {
  const std::vector<uint32_t> All = boundaries();
  std::vector<uint32_t> Few;
  for (const uint32_t Bits : FewBoundaries)
    for (const uint32_t Sign : {0U, SignBit})
      Few.push_back(Bits | Sign);
  const uint64_t Count = forEachMode([&](Checker &C, unsigned Operands) {
    if (Operands == 3) {
      for (const uint32_t X : Few)
        for (const uint32_t Y : Few)
          for (const uint32_t Z : Few)
            C.add({X, Y, Z});
      return;
    }
    for (const uint32_t X : All)
      for (const uint32_t Y : All) {
        C.add({X, Y, 0});
        if (Operands == 1)
          break;
      }
  });
  std::printf("%llu operands\n", static_cast<unsigned long long>(Count));
}

TEST(FloatMpfr, RandomOperands) {
  const unsigned Operands = vorion::setting("VORION_FLOAT_OPERANDS", 20000);
  std::mt19937 Random(vorion::setting("VORION_FLOAT_SEED", 1));
  const uint64_t Count = forEachMode([&](Checker &C, unsigned) {
    for (unsigned N = 0; N != Operands; ++N)
      C.add(related(Random));
  });
  std::printf("%llu operands\n", static_cast<unsigned long long>(Count));
}
