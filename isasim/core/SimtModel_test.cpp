/// XVortex, Zicond and the atomics against a model that does one lane after
/// another what the records say, for each single lane, all lanes and random
/// masks, with operands in any registers, the same one twice included.

#include "core/Effects.h"
#include "testing/SimtModel.h"
#include "testing/WarpRunner.h"

#include <algorithm>
#include <cstring>
#include <random>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

/// Instructions of a program: the tested one, then nops. A stack entry may go
/// on at any of them, which the number of retired instructions tells.
constexpr unsigned Length = 6;

bool isAmo(Op O) { return effectsOf(O).Class == EffectClass::Atomic; }

/// Values that make something of the instructions: small numbers, masks,
/// shuffle controls, all lanes alike, addresses for atomics.
class Values {
public:
  explicit Values(Op O) : O(O) {}

  void fill(SimtModel &M) {
    M.Mask = 0;
    M.Stack.clear();
    for (auto &Register : M.X)
      fillRegister(Register);
    std::fill_n(M.X[0], MaxLanes, 0U);
    for (uint32_t &W : M.Memory)
      W = Random() % 4;
    const unsigned Depth = Random() % (SimtModel::StackLimit + 1);
    for (unsigned N = 0; N != Depth; ++N)
      M.Stack.push_back({any() % 0xFFFF + 1,
                         Random() % 2 ? any() % 0xFFFF + 1 : 0,
                         1 + static_cast<unsigned>(Random() % Length)});
  }
  /// The mask of run N: each lane alone, all, then any.
  uint32_t mask(unsigned N) {
    return N < MaxLanes ? 1U << N : N == MaxLanes ? 0xFFFF : any() % 0xFFFF + 1;
  }
  /// rd and rs2 of an instruction with pairs are even.
  Operands operands() {
    Operands Where{registerNumber(), registerNumber(), registerNumber()};
    if (isPair()) {
      Where.Rd &= ~1U;
      Where.Rs2 &= ~1U;
    }
    return Where;
  }
  /// In half of the lanes, what compare-and-swap compares with becomes what is
  /// there.
  void makeSomeEqual(SimtModel &M, Operands Where) {
    if ((O != Op::RV_AMOCAS_W && !isPair()) || Where.Rd == 0 ||
        Where.Rs1 / 2 == Where.Rd / 2)
      return;
    for (unsigned L = 0; L != MaxLanes; ++L)
      if (const unsigned N = SimtModel::wordAt(M.X[Where.Rs1][L]);
          N != SimtModel::Words && Random() % 2) {
        M.X[Where.Rd][L] = M.Memory[N];
        if (isPair() && N % 2 == 0)
          M.X[Where.Rd + 1][L] = M.Memory[N + 1];
      }
  }

private:
  unsigned registerNumber() { return Random() % 6 * (Random() % 6); }
  bool isPair() const { return O == Op::RV_AMOCAS_D; }
  /// One of the first \p Count words that the atomic can access.
  uint32_t anyWord(unsigned Count) {
    return SimtModel::wordAddress(isPair() ? Random() % Count & ~1U
                                           : Random() % Count);
  }
  uint32_t any() { return static_cast<uint32_t>(Random()); }
  void fillRegister(uint32_t *Register) {
    const uint32_t Same = value();
    const bool Alike = Random() % 3 == 0;
    // Most accesses are good, so that some warps have no fault.
    const bool Faulty = Random() % 8 == 0;
    for (unsigned L = 0; L != MaxLanes; ++L)
      if (isAmo(O) && Random() % 2)
        Register[L] =
            Faulty && Random() % 8 == 0 ? any() : anyWord(SimtModel::Words);
      else
        Register[L] = Alike ? Same : value();
    if (isAmo(O) && !Faulty && Random() % 2)
      for (unsigned L = 0; L != MaxLanes; ++L)
        Register[L] =
            anyWord(Random() % 2 ? SimtModel::Words : SimtModel::Words / 2);
  }
  /// Where no memory is, so that it can stand for an address.
  uint32_t nowhere() {
    return Random() % 2 ? any() & 0xFFF : 0x90000000 | (any() & 0x5FFFFFFF);
  }
  uint32_t value() {
    if (isAmo(O))
      return nowhere();
    switch (Random() % 6) {
    case 0:
      return 0;
    case 1:
      return Random() % 6; // predicates, depths, counts of warps
    case 2:
      return Random() % 20 | (Random() % 2 ? 15 : Random() % 64) << 6 |
             (Random() % 2 ? 0 : 0x30 + Random() % 16) << 12;
    case 3:
      return (Random() % 2 << 31) | Random() % (SimtModel::NumBarriers + 2);
    default:
      return any();
    }
  }

  Op O;
  std::mt19937 Random{17};
};

std::byte *placeOfWord(WarpRunner &R, unsigned N) {
  const uint32_t Address = SimtModel::wordAddress(N);
  return SimtModel::isLocal(N) ? R.warp().Mem->Local.at(Address)
                               : R.global(Address);
}

void load(WarpRunner &R, const SimtModel &M) {
  R.reset(); // barriers too
  for (unsigned N = 0; N != 32; ++N) {
    Lanes16 V;
    std::copy_n(M.X[N], MaxLanes, V.begin());
    R.setX(N, V);
  }
  R.setActive(M.Mask);
  R.warp().WholeMask = M.Whole;
  R.warp().StackLimit = SimtModel::StackLimit;
  R.warp().StackDepth = static_cast<uint32_t>(M.Stack.size());
  for (size_t N = 0; N != M.Stack.size(); ++N)
    R.warp().Stack[N] = {M.Stack[N].Mask, M.Stack[N].Other,
                         R.Code.begin() + M.Stack[N].Pc};
  for (unsigned N = 0; N != SimtModel::Words; ++N)
    std::memcpy(placeOfWord(R, N), &M.Memory[N], 4);
}

void expectSame(WarpRunner &R, const SimtModel &M) {
  WarpState &S = R.warp();
  for (unsigned N = 0; N != 32; ++N) {
    const Lanes16 Got = R.getX(N);
    for (unsigned L = 0; L != MaxLanes; ++L)
      ASSERT_EQ(Got[L], M.X[N][L]) << "x" << N << " of lane " << L;
  }
  for (unsigned N = 0; N != SimtModel::Words; ++N) {
    uint32_t Word = 0;
    std::memcpy(&Word, placeOfWord(R, N), 4);
    ASSERT_EQ(Word, M.Memory[N]) << "word " << N;
  }
  if (M.Trap) {
    ASSERT_EQ(S.Why, Stop::Trapped);
    ASSERT_EQ(R.cause(), *M.Trap);
    ASSERT_EQ(S.FaultLane, M.TrapLane);
    ASSERT_EQ(S.Next, R.Code.begin());
    ASSERT_EQ(S.Count.WarpInstructions, 0U);
  } else if (M.Why == Stop::Ready) {
    ASSERT_TRUE(R.ranToEnd());
    ASSERT_EQ(S.Count.WarpInstructions, 1 + Length - M.Pc);
  } else {
    ASSERT_EQ(S.Why, M.Why);
  }
  if (M.Why != Stop::Ended) {
    ASSERT_EQ(S.Mask, M.Mask);
    ASSERT_EQ(S.WholeMask, M.Whole);
  }
  ASSERT_EQ(S.StackDepth, M.Stack.size());
  for (size_t N = 0; N != M.Stack.size(); ++N)
    ASSERT_EQ((SimtModel::StackEntry{
                  S.Stack[N].Mask, S.Stack[N].Other,
                  static_cast<unsigned>(S.Stack[N].Pc - R.Code.begin())}),
              M.Stack[N]);
}

void check(const ExecTable &Table, Op O, Operands Where, Values &Source) {
  std::vector<uint32_t> Code(Length, encode(Op::RV_ADDI, {}));
  Code[0] = encode(O, {.Rd = Where.Rd, .Rs1 = Where.Rs1, .Rs2 = Where.Rs2});
  WarpRunner R(Table, Code);
  constexpr unsigned Masks = MaxLanes + 1 + 23;
  for (unsigned N = 0; N != Masks; ++N) {
    SimtModel M;
    Source.fill(M);
    Source.makeSomeEqual(M, Where);
    M.Mask = Source.mask(N);
    M.Whole = N % 3 ? M.Mask : M.Mask | Source.mask(MaxLanes + 1);
    load(R, M);
    const uint32_t Before = M.Mask;
    simtSteps().at(O)(M, Where);
    if (!M.Trap && M.Why == Stop::Ready)
      ++M.Pc;
    R.run();
    if (R.warp().Why == Stop::Atomic && R.completeAtomic())
      R.run();
    expectSame(R, M);
    if (::testing::Test::HasFatalFailure()) {
      ADD_FAILURE() << InsnTable[static_cast<unsigned>(O)].Mnemonic << " x"
                    << Where.Rd << ", x" << Where.Rs1 << ", x" << Where.Rs2
                    << " on " << Table.Level << ", mask " << std::hex << Before;
      return;
    }
  }
}

} // namespace

TEST(SimtModel, EveryInstructionOnEveryMask) {
  for (const ExecTable *Table : allTables())
    for (const auto &[O, Step] : simtSteps()) {
      Values Source(O);
      for (int Try = 0; Try != 24; ++Try) {
        check(*Table, O, Source.operands(), Source);
        if (::testing::Test::HasFatalFailure())
          return;
      }
    }
}

TEST(SimtModel, CoversTheRecords) {
  for (unsigned N = 0; N != NumOps; ++N) {
    const Op O = static_cast<Op>(N);
    const Effects &E = effectsOf(O);
    if (E.ReadsLanes || E.ChangesMask || E.Class == EffectClass::Atomic)
      EXPECT_TRUE(simtSteps().contains(O)) << InsnTable[N].Mnemonic;
  }
}
