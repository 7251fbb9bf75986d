/// The translator against the interpreter: random programs of every
/// instruction that is translated, with all kinds of operands, active lanes,
/// rounding modes and ends of a turn, must leave the same in every register,
/// flag, counter and word of memory, and stop at the same place for the same
/// reason.

#include "testing/Operations.h"
#include "testing/Setting.h"
#include "testing/WarpRunner.h"
#include "translate/Translator.h"

#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <ostream>
#include <random>
#include <string>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

const std::vector<Op> Operations = [] {
  std::vector<Op> Ops = computations();
  Ops.insert(Ops.end(), {Op::RV_CSRRS, Op::RV_FENCE});
  return Ops;
}();

const std::vector<Op> MemoryAccesses = accesses();

constexpr Op Branches[] = {
#define BRANCH(OP, CONDITION) Op::OP,
#include "core/insns/branch.def"
};

/// What splits give to their joins; a predicate, and a place in the code.
constexpr unsigned FirstToken = 16, Place = 14, Predicate = 15;
/// Registers that hold the same in each lane, for branches; the counter of the
/// loop; addresses.
constexpr unsigned FirstUniform = 26, LastUniform = 29, Counter = 30,
                   FirstAddress = 20, LastAddress = 25, StackPointer = 2;

class Programs {
public:
  explicit Programs(unsigned Seed) : Random(Seed) {
    for (unsigned &R : Favourites)
      R = 3 + below(11);
    HasFavourites = below(2);
  }

  uint32_t below(uint32_t Most) {
    return std::uniform_int_distribution<uint32_t>(0, Most - 1)(Random);
  }
  template <typename Range> auto oneOf(const Range &All) {
    return All[below(std::size(All))];
  }

  uint32_t operand() {
    static constexpr uint32_t Special[] = {
        0,          1,          0x80000000, 0x7FFFFFFF, 0xFFFFFFFF, 0x7F800000,
        0xFF800000, 0x7FC00000, 0xFFC00001, 0x7F800001, 0xFFA00000, 0x00000001,
        0x807FFFFF, 0x00800000, 0x7F7FFFFF, 0xFF7FFFFF, 0x3F800000, 0xBF800000,
        0x4F000000, 0xCF000000, 0x4F800000, 0xBF000000, 0x3EFFFFFF, 0x0000FF00};
    switch (below(4)) {
    case 0:
      return Random();
    case 1: { // a float of usual size
      const auto Value = static_cast<float>(below(2000)) / 16 - 60;
      uint32_t Bits;
      std::memcpy(&Bits, &Value, 4);
      return Bits;
    }
    case 2: // also whom shuffles take from, among all lanes
      return below(64) + (below(4) ? 0 : (MaxLanes - 1) << 6);
    default:
      return oneOf(Special);
    }
  }

  /// Any register. In half of the programs it is mostly one of four, so that
  /// instructions use what the vectors of the host still have of them.
  unsigned any(unsigned Most = 32) {
    return HasFavourites && below(8) ? oneOf(Favourites) : below(Most);
  }

  /// A destination that branches do not need.
  unsigned destination() {
    const unsigned R = any(FirstToken);
    return R == StackPointer || R >= Place ? 0 : R;
  }

  uint32_t computation() {
    Fields F;
    const Op O = oneOf(Operations);
    F.Rd = InsnTable[static_cast<unsigned>(O)].Rd == File::F ? any()
                                                             : destination();
    F.Rs1 = any();
    F.Rs2 = any();
    F.Rs3 = any();
    F.Imm = static_cast<int32_t>(below(4096)) - 2048;
    static constexpr unsigned Modes[] = {7, 7, 7, 0, 0, 1, 2, 3, 4};
    F.Rm = oneOf(Modes);
    if (O == Op::RV_CSRRS) {
      static constexpr unsigned Csrs[] = {CSR_FFLAGS, CSR_FRM, CSR_MCYCLE,
                                          CSR_THREAD_ID, CSR_ACTIVE_THREADS};
      F.Csr = oneOf(Csrs);
      F.Rs1 = 0;
    }
    return encode(O, F);
  }

  /// Some that round, one behind the other, which share a few registers.
  void addRounded(std::vector<uint32_t> &Words) {
    static constexpr Op Rounding[] = {
        Op::RV_FADD_S,  Op::RV_FSUB_S,   Op::RV_FMUL_S,   Op::RV_FDIV_S,
        Op::RV_FMADD_S, Op::RV_FMSUB_S,  Op::RV_FNMADD_S, Op::RV_FNMSUB_S,
        Op::RV_FSQRT_S, Op::RV_FSGNJN_S, Op::RV_FMIN_S};
    const unsigned Last = 3 + below(8);
    for (uint32_t N = 2 + below(4); N != 0; --N) {
      const Op O = oneOf(Rounding);
      Words.push_back(encode(O, {.Rd = below(Last),
                                 .Rs1 = below(Last),
                                 .Rs2 = O == Op::RV_FSQRT_S ? 0 : below(Last),
                                 .Rs3 = below(Last)}));
    }
  }

  uint32_t access() {
    Fields F;
    F.Rd = destination();
    F.Rs1 = below(5) ? FirstAddress + below(LastAddress - FirstAddress + 1)
                     : StackPointer;
    F.Rs2 = any();
    F.Imm = static_cast<int32_t>(below(9)) * 4 - 16;
    if (below(300) == 0)
      F.Imm += 1;
    const Op O = oneOf(MemoryAccesses);
    // An atomic without a result.
    if (below(4) == 0)
      F.Rd = 0;
    // Pairs are even registers.
    if (O == Op::RV_AMOCAS_D) {
      F.Rd &= ~1U;
      F.Rs2 &= ~1U;
    }
    return encode(O, F);
  }

  /// An access at an index that was loaded: of lanes far apart, of neighbours
  /// or of one place, now and then otherwise than before.
  void addIndexed(std::vector<uint32_t> &Words) {
    constexpr unsigned Index = 5, Address = 6;
    const auto Base = FirstAddress + below(LastAddress - FirstAddress + 1);
    Words.push_back(encode(
        Op::RV_LW, {.Rd = Index,
                    .Rs1 = FirstAddress + below(LastAddress - FirstAddress + 1),
                    .Imm = 4 * static_cast<int32_t>(below(4))}));
    if (below(3))
      Words.push_back(
          encode(Op::RV_ANDI, {.Rd = Index, .Rs1 = Index, .Imm = 15}));
    Words.push_back(
        encode(Op::RV_SH2ADD, {.Rd = Address, .Rs1 = Index, .Rs2 = Base}));
    Fields F;
    F.Rd = destination();
    F.Rs1 = Address;
    F.Rs2 = any();
    F.Imm = static_cast<int32_t>(below(3)) * 4;
    Words.push_back(encode(oneOf(MemoryAccesses), F));
  }

  uint32_t branch(int32_t Bytes) {
    Fields F;
    F.Rs1 = FirstUniform + below(LastUniform - FirstUniform + 1);
    F.Rs2 = FirstUniform + below(LastUniform - FirstUniform + 1);
    // Lanes may disagree, which is a trap.
    if (below(200) == 0)
      F.Rs2 = below(32);
    F.Imm = Bytes;
    return encode(oneOf(Branches), F);
  }

  /// Of this warp alone; rarely of others, which never come.
  uint32_t barrier() {
    const unsigned Uniform =
        FirstUniform + below(LastUniform - FirstUniform + 1);
    return encode(Op::VX_BAR, {.Rs1 = below(3) ? 0 : Uniform,
                               .Rs2 = below(6) ? 0 : Uniform});
  }

  /// Both sides of a split, nested, and a way past a part of it.
  void addSplit(std::vector<uint32_t> &Words, unsigned Depth) {
    const unsigned Token = FirstToken + Depth;
    Words.push_back(
        below(2)
            ? encode(Op::RV_ANDI, {.Rd = Predicate, .Rs1 = below(32), .Imm = 1})
            : encode(Op::RV_SLTU,
                     {.Rd = Predicate, .Rs1 = below(32), .Rs2 = below(32)}));
    const bool IsNegated = below(2);
    Words.push_back(encode(IsNegated ? Op::VX_SPLIT_N : Op::VX_SPLIT,
                           {.Rd = Token, .Rs1 = Predicate}));
    const uint32_t Length = 1 + below(4);
    Words.push_back(encode(
        IsNegated ? Op::RV_BNE : Op::RV_BEQ,
        {.Rs1 = Predicate, .Imm = 4 * static_cast<int32_t>(Length + 1)}));
    for (uint32_t N = 0; N != Length; ++N)
      Words.push_back(computation());
    if (Depth < 2 && below(3) == 0)
      addSplit(Words, Depth + 1);
    if (below(60) != 0)
      Words.push_back(encode(Op::VX_JOIN, {.Rs1 = Token}));
  }

  /// A loop that lanes leave one after the other, one of them mostly long after
  /// the others.
  void addDivergentLoop(std::vector<uint32_t> &Words,
                        uint32_t PercentAccesses) {
    constexpr unsigned Active = FirstToken + 2, Spare = FirstToken + 1,
                       Left = 31;
    constexpr unsigned ThreadId = CSR_THREAD_ID, Mask = CSR_ACTIVE_THREADS;
    Words.push_back(encode(Op::RV_CSRRS, {.Rd = Active, .Csr = Mask}));
    Words.push_back(
        encode(Op::RV_ANDI, {.Rd = Left, .Rs1 = 3 + below(11), .Imm = 7}));
    if (below(4)) {
      Words.push_back(encode(Op::RV_CSRRS, {.Rd = Spare, .Csr = ThreadId}));
      Words.push_back(
          encode(Op::RV_ADDI, {.Rd = Spare,
                               .Rs1 = Spare,
                               .Imm = -static_cast<int32_t>(below(MaxLanes))}));
      Words.push_back(
          encode(Op::RV_SLTIU, {.Rd = Spare, .Rs1 = Spare, .Imm = 1}));
      Words.push_back(
          encode(Op::RV_SLLI, {.Rd = Spare, .Rs1 = Spare, .Imm = 5}));
      Words.push_back(
          encode(Op::RV_OR, {.Rd = Left, .Rs1 = Left, .Rs2 = Spare}));
    }
    const size_t Begin = Words.size();
    for (uint32_t N = 1 + below(4); N != 0; --N) {
      if (below(100) >= PercentAccesses)
        Words.push_back(computation());
      else if (below(2))
        Words.push_back(access());
      else
        addIndexed(Words);
    }
    Words.push_back(
        encode(Op::RV_SLTU, {.Rd = Predicate, .Rs1 = 0, .Rs2 = Left}));
    Words.push_back(encode(Op::RV_ADDI, {.Rd = Left, .Rs1 = Left, .Imm = -1}));
    Words.push_back(encode(Op::VX_PRED, {.Rs1 = Predicate, .Rs2 = Active}));
    Words.push_back(
        encode(Op::RV_BNE, {.Rs1 = Predicate,
                            .Imm = 4 * (static_cast<int32_t>(Begin) -
                                        static_cast<int32_t>(Words.size()))}));
  }

  /// A short function, its call, and the way around it. Seldom it overwrites
  /// the place to return to.
  void addCall(std::vector<uint32_t> &Words, uint32_t PercentAccesses) {
    constexpr unsigned ReturnAddress = 1;
    const uint32_t Length = below(11);
    Words.push_back(encode(Op::RV_JAL, {.Rd = ReturnAddress, .Imm = 8}));
    Words.push_back(
        encode(Op::RV_JAL, {.Imm = 4 * static_cast<int32_t>(Length + 2)}));
    for (uint32_t N = 0; N != Length;) {
      const uint32_t Word =
          below(100) < PercentAccesses ? access() : computation();
      if (decode(Word)->Rd == ReturnAddress && below(20))
        continue;
      Words.push_back(Word);
      ++N;
    }
    Words.push_back(encode(Op::RV_JALR, {.Rs1 = ReturnAddress}));
  }

  /// A loop with ways through it.
  std::vector<uint32_t> program(uint32_t PercentAccesses) {
    const uint32_t Length = 20 + below(60);
    std::vector<uint32_t> Words;
    for (uint32_t N = 0; N != Length; ++N) {
      if (below(100) < PercentAccesses)
        below(4) ? Words.push_back(access()) : addIndexed(Words);
      else if (below(12) == 0)
        Words.push_back(branch(
            4 * static_cast<int32_t>(1 + below(std::min(6U, Length - N)))));
      else if (below(12) == 0)
        addSplit(Words, 0);
      else if (below(20) == 0)
        addCall(Words, PercentAccesses);
      else if (below(15) == 0)
        addDivergentLoop(Words, PercentAccesses);
      else if (below(10) == 0)
        addRounded(Words);
      else if (below(30) == 0)
        Words.push_back(
            encode(below(4) ? Op::RV_ADDI : Op::RV_LW,
                   {.Rd = StackPointer,
                    .Rs1 = StackPointer,
                    .Imm = (static_cast<int32_t>(below(9)) - 4) * 4}));
      else if (below(60) == 0)
        Words.push_back(barrier());
      else if (below(60) == 0)
        Words.push_back(encode(below(2) ? Op::VX_PRED : Op::VX_PRED_N,
                               {.Rs1 = below(32), .Rs2 = Place + 5}));
      else if (below(30) == 0) {
        Words.push_back(encode(Op::RV_AUIPC, {.Rd = Place}));
        Words.push_back(encode(
            Op::RV_JALR, {.Rd = below(2),
                          .Rs1 = Place,
                          .Imm = 4 * static_cast<int32_t>(2 + below(3))}));
      } else if (below(40) == 0)
        Words.push_back(encode(Op::RV_JAL, {.Rd = below(2), .Imm = 4}));
      else
        Words.push_back(computation());
    }
    Words.push_back(
        encode(Op::RV_ADDI, {.Rd = Counter, .Rs1 = Counter, .Imm = -1}));
    Words.push_back(
        encode(Op::RV_BNE, {.Rs1 = Counter,
                            .Imm = -4 * static_cast<int32_t>(Words.size())}));
    return Words;
  }

  void fill(WarpRunner &A, WarpRunner &B) {
    for (unsigned N = 0; N != 32; ++N) {
      Lanes16 X, F;
      for (unsigned L = 0; L != MaxLanes; ++L) {
        X[L] = N == 0 ? 0 : operand();
        F[L] = operand();
      }
      if (N >= FirstUniform)
        X.fill(below(2) ? below(3) : operand());
      if (N >= FirstAddress && N <= LastAddress)
        X = addresses();
      if (N == StackPointer)
        X = stackPointers();
      if (N == Place + 5)
        X.fill(below(2) ? 0xFFFF : 0x0FF0);
      if (N == Counter)
        X.fill(3);
      for (WarpRunner *R : {&A, &B}) {
        R->setX(N, X);
        R->setF(N, F);
      }
    }
  }

  /// The same place of all lanes' stacks, seldom near an end; or of all but
  /// one.
  Lanes16 stackPointers() {
    static constexpr uint32_t Depths[] = {64, 64, 64, 128, 16, (64 << 10) - 24};
    const uint32_t Depth = oneOf(Depths);
    Lanes16 A;
    for (uint32_t L = 0; L != MaxLanes; ++L)
      A[L] = VX_STACK_TOP - Depth - (L << 16);
    if (below(8) == 0)
      A[below(MaxLanes)] -= 4;
    return A;
  }

  /// Of neighbours, of one place, of any; in any region, and of nothing.
  Lanes16 addresses() {
    static constexpr uint32_t Bases[] = {
        VX_GLOBAL_BASE + 64,       VX_GLOBAL_BASE + 64,
        VX_GLOBAL_BASE + 4096,     VX_GLOBAL_BASE + (1 << 20) - 256,
        VX_LOCAL_BASE + 64,        VX_LOCAL_BASE + (32 << 10) - 256,
        VX_STACK_TOP - 128,        VX_STACK_TOP - 256,
        VX_IMAGE_BASE + (1 << 20), VX_LOCAL_BASE + 128};
    // What faults, at an end or in the code.
    static constexpr uint32_t Wrong[] = {0, VX_IMAGE_BASE + 64,
                                         VX_GLOBAL_BASE + (1 << 20) - 80,
                                         VX_LOCAL_BASE + (32 << 10) - 80};
    const uint32_t Base = below(20) ? oneOf(Bases) : oneOf(Wrong);
    static constexpr uint32_t Strides[] = {4, 4, 4, 4, 4, 0, 0, 0, 8, 12};
    uint32_t Stride = oneOf(Strides);
    if (below(40) == 0)
      Stride = 1 + below(2);
    if (Base >= VX_STACK_TOP - 256 && Base < VX_STACK_TOP && below(3))
      Stride = 0U - (64U << 10);
    Lanes16 A;
    const bool IsRandom = below(5) == 0;
    // Of neighbours in the stacks: each lane's own, anywhere in it.
    const bool IsOwn = Stride == 0U - (64U << 10);
    for (uint32_t L = 0; L != MaxLanes; ++L)
      A[L] = (IsRandom ? 4 * below(32) : 0) +
             (IsRandom && !IsOwn ? Base : Base + L * Stride);
    return A;
  }

private:
  std::mt19937 Random;
  unsigned Favourites[4];
  bool HasFavourites;
};

std::string countersOf(const WarpState &S) {
  std::string Text;
  for (const auto &C : CoreCounterTable)
    Text += std::to_string(S.Count.*C.Member) + " ";
  return Text + std::to_string(S.Count.Changes);
}

void expectSame(WarpRunner &A, WarpRunner &B) {
  const WarpState &X = A.warp(), &Y = B.warp();
  ASSERT_EQ(X.Next - A.Code.begin(), Y.Next - B.Code.begin());
  ASSERT_EQ(X.Why, Y.Why);
  ASSERT_EQ(countersOf(X), countersOf(Y));
  ASSERT_EQ(X.Fflags, Y.Fflags);
  ASSERT_EQ(X.Mask, Y.Mask);
  ASSERT_EQ(X.Full, Y.Full);
  ASSERT_EQ(X.LaneCount, Y.LaneCount);
  ASSERT_EQ(X.LastLane, Y.LastLane);
  ASSERT_EQ(X.StackDepth, Y.StackDepth);
  for (unsigned D = 0; D != X.StackDepth; ++D) {
    ASSERT_EQ(X.Stack[D].Mask, Y.Stack[D].Mask);
    ASSERT_EQ(X.Stack[D].Other, Y.Stack[D].Other);
    ASSERT_EQ(X.Stack[D].Pc - A.Code.begin(), Y.Stack[D].Pc - B.Code.begin());
  }
  for (unsigned L = 0; L != MaxLanes; ++L)
    ASSERT_EQ(X.MaskWords[L], Y.MaskWords[L]);
  ASSERT_EQ(X.FaultCause, Y.FaultCause);
  ASSERT_EQ(X.FaultLane, Y.FaultLane);
  ASSERT_EQ(X.FaultAddress, Y.FaultAddress);
  for (unsigned R = 0; R != SinkRegister; ++R)
    for (unsigned L = 0; L != MaxLanes; ++L)
      ASSERT_EQ(X.Registers[R][L], Y.Registers[R][L])
          << "register " << R << ", lane " << L;
  const MemoryView P = A.Storage->view(0), Q = B.Storage->view(0);
  for (const Region MemoryView::*In :
       {&MemoryView::Local, &MemoryView::Global, &MemoryView::Stack})
    ASSERT_EQ(std::memcmp((P.*In).Host, (Q.*In).Host, (P.*In).Bytes), 0);
}

struct Runs {
  VectorUnit Unit;
  unsigned Programs, PercentAccesses;
};

void PrintTo(const Runs &R, std::ostream *To) {
  *To << R.Programs << " programs, " << R.PercentAccesses << " % accesses";
}

class TranslatedPrograms : public ::testing::TestWithParam<Runs> {
protected:
  void SetUp() override {
    if (GetParam().Unit > Translator::unitOfHost())
      GTEST_SKIP() << "the translation needs another host";
  }
};

TEST_P(TranslatedPrograms, DoesWhatTheInterpreterDoes) {
  unsigned Translated = 0;
  uint64_t Executed = 0;
  const unsigned Count =
      vorion::setting("VORION_TRANSLATOR_PROGRAMS", GetParam().Programs);
  const unsigned First = vorion::setting("VORION_TRANSLATOR_SEED", 0);
  for (unsigned Seed = First; Seed != First + Count; ++Seed) {
    Programs P(Seed + 1000 * GetParam().PercentAccesses);
    const std::vector<uint32_t> Words = P.program(GetParam().PercentAccesses);
    const ExecTable &Exec = execTable(false);
    // Machines with fewer lanes share lines of stacks.
    Config Shape = WarpRunner::smallShape();
    Shape.LanesPerWarp = P.below(4) ? MaxLanes : 1 + P.below(MaxLanes);
    const uint32_t AllLanes = (1U << Shape.LanesPerWarp) - 1;
    WarpRunner Interpreted(Exec, Words, Shape), Fast(Exec, Words, Shape);
    Translator T(Fast.Code, Exec, Translator::UsualCost, GetParam().Unit);
    uint32_t Some = P.oneOf(MaskPatterns) & AllLanes;
    // For one lane it has other code.
    if (Seed % 4 == 1) {
      Some = 1U << P.below(Shape.LanesPerWarp);
      Fast.setActive(Some);
    }
    // Registers of 0 make it guess that addresses are the same in all lanes,
    // others that some are scattered.
    if (Seed % 4 == 3)
      P.fill(Interpreted, Fast);
    T.seen(Fast.Code.begin(), UINT64_MAX, Seed % 2 ? &Fast.warp() : nullptr);
    Translated += T.regions();
    for (const uint32_t Active : {AllLanes, Some ? Some : 1}) {
      for (WarpRunner *R : {&Interpreted, &Fast}) {
        R->reset();
        R->setActive(Active);
      }
      P.fill(Interpreted, Fast);
      const uint32_t Frm = P.below(4) ? 0 : P.below(6);
      const uint32_t Quantum = P.below(2) ? 1000 : 1 + P.below(100);
      Interpreted.warp().Frm = Fast.warp().Frm = Frm;
      for (unsigned Turn = 0;
           Turn != 6 && Interpreted.warp().Why == Stop::Ready; ++Turn) {
        Interpreted.run(Quantum);
        Fast.run(Quantum);
        expectSame(Interpreted, Fast);
        ASSERT_FALSE(HasFatalFailure())
            << "seed " << Seed << ", active " << Active << ", frm " << Frm;
        // An atomic that waits for the other cores, which there are not.
        if (Interpreted.warp().Why == Stop::Atomic)
          for (WarpRunner *R : {&Interpreted, &Fast})
            R->completeAtomic();
      }
      Executed += Fast.warp().Count.WarpInstructions;
    }
  }
  RecordProperty("instructions", std::to_string(Executed));
  EXPECT_GT(Translated, Count / 2);
  EXPECT_GT(Executed, 100 * uint64_t{Count})
      << "they end too early to tell anything";
}

INSTANTIATE_TEST_SUITE_P(Random, TranslatedPrograms,
                         ::testing::Values(Runs{VectorUnit::Avx512, 300, 0},
                                           Runs{VectorUnit::Avx512, 300, 15},
                                           Runs{VectorUnit::Avx2, 300, 0},
                                           Runs{VectorUnit::Avx2, 300, 15}),
                         [](const ::testing::TestParamInfo<Runs> &Of) {
                           return std::string(Of.param.Unit == VectorUnit::Avx2
                                                  ? "Avx2"
                                                  : "Avx512") +
                                  (Of.param.PercentAccesses ? "Memory" : "");
                         });

} // namespace
