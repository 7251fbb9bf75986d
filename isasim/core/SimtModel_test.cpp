/// XVortex, Zicond and the atomics against a model that does one lane after
/// another what the records say (intrinsics/Simt.td; RISC-V unprivileged
/// specification, Zaamo, Zacas and Zicond), for each single lane, all lanes and
/// random masks, with operands in any registers, the same one twice included.

#include "core/Atomics.h"
#include "testing/WarpRunner.h"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <random>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

/// Instructions of a program: the tested one, then nops. A stack entry may go
/// on at any of them, which the number of retired instructions tells.
constexpr unsigned Length = 6;
constexpr unsigned NumBarriers = 16;
constexpr unsigned StackLimit = 4;
/// Words that atomics work on, few so that lanes meet: half in local memory.
constexpr unsigned Words = 12;

struct StackEntry {
  uint32_t Mask, Other;
  unsigned Pc;
  bool operator==(const StackEntry &) const = default;
};

/// A warp as the specification has it, and how it stopped.
struct Model {
  uint32_t X[32][MaxLanes] = {};
  uint32_t Mask = 0;
  uint32_t Whole = 0; ///< as vx_tmc has set the mask
  unsigned Pc = 0;
  std::vector<StackEntry> Stack;
  std::array<uint32_t, Words> Memory{};
  Stop Why = Stop::Ready;
  std::optional<TrapCause> Trap;
  unsigned TrapLane = 0;

  bool active(unsigned L) const { return Mask >> L & 1; }
  unsigned first() const {
    unsigned L = 0;
    while (!active(L))
      ++L;
    return L;
  }
  unsigned last() const {
    unsigned L = MaxLanes - 1;
    while (!active(L))
      --L;
    return L;
  }
  void trap(TrapCause Cause, unsigned Lane) {
    Why = Stop::Trapped;
    Trap = Cause;
    TrapLane = Lane;
  }
};

struct Operands {
  unsigned Rd, Rs1, Rs2;
};

uint32_t wordAddress(unsigned N) {
  return N < Words / 2 ? VX_LOCAL_BASE + 4 * N
                       : VX_GLOBAL_BASE + 4 * (N - Words / 2);
}

using Step = std::function<void(Model &, Operands)>;

/// rd of each active lane becomes F(lane); sources are read before.
void eachLane(Model &M, unsigned Rd,
              const std::function<uint32_t(unsigned)> &F) {
  std::array<uint32_t, MaxLanes> Results{};
  for (unsigned L = 0; L != MaxLanes; ++L)
    if (M.active(L))
      Results[L] = F(L);
  for (unsigned L = 0; L != MaxLanes; ++L)
    if (M.active(L) && Rd != 0)
      M.X[Rd][L] = Results[L];
}

Step vote(std::function<uint32_t(const std::vector<uint32_t> &)> Result) {
  return [Result](Model &M, Operands O) {
    std::vector<uint32_t> Values;
    for (unsigned L = 0; L != MaxLanes; ++L)
      if (M.active(L))
        Values.push_back(M.X[O.Rs1][L]);
    const uint32_t All = Result(Values);
    eachLane(M, O.Rd, [&](unsigned) { return All; });
  };
}

/// From gives the source lane, or nothing where it lies outside the segment.
Step shuffle(std::function<std::optional<int>(int Lane, int B, int Lo, int Hi,
                                              int Segment)>
                 From) {
  return [From](Model &M, Operands O) {
    eachLane(M, O.Rd, [&](unsigned L) {
      const uint32_t Control = M.X[O.Rs2][L];
      const int Lane = static_cast<int>(L);
      const int B = Control & 63, C = Control >> 6 & 63,
                Segment = Control >> 12 & 63;
      const int Lo = Lane & Segment, Hi = Lo | (C & ~Segment);
      const std::optional<int> Source = From(Lane, B, Lo, Hi, Segment);
      const bool Takes = Source && *Source >= 0 &&
                         *Source < static_cast<int>(MaxLanes) &&
                         M.active(static_cast<unsigned>(*Source));
      return M.X[O.Rs1][Takes ? static_cast<unsigned>(*Source) : L];
    });
  };
}

Step split(bool Negated) {
  return [Negated](Model &M, Operands O) {
    uint32_t Then = 0, Else = 0;
    for (unsigned L = 0; L != MaxLanes; ++L)
      if (M.active(L))
        ((M.X[O.Rs1][L] & 1) != Negated ? Then : Else) |= 1U << L;
    const auto Depth = static_cast<uint32_t>(M.Stack.size());
    const bool Divergent = Then && Else;
    if (Divergent && Depth == StackLimit)
      return M.trap(TrapCause::DivergenceOverflow, M.first());
    eachLane(M, O.Rd, [&](unsigned) { return Depth; });
    if (!Divergent)
      return;
    M.Stack.push_back({M.Mask, Else, M.Pc + 1});
    M.Mask = Then;
  };
}

void join(Model &M, Operands O) {
  if (M.X[O.Rs1][M.last()] == M.Stack.size())
    return;
  if (M.Stack.empty())
    return M.trap(TrapCause::DivergenceUnderflow, M.first());
  StackEntry &Top = M.Stack.back();
  if (Top.Other != 0) {
    M.Mask = Top.Other;
    Top.Other = 0;
    M.Pc = Top.Pc - 1; // one is added to it
    return;
  }
  M.Mask = Top.Mask;
  M.Stack.pop_back();
}

Step pred(bool Negated) {
  return [Negated](Model &M, Operands O) {
    uint32_t Mask = 0;
    for (unsigned L = 0; L != MaxLanes; ++L)
      if (M.active(L) && (M.X[O.Rs1][L] & 1) != Negated)
        Mask |= 1U << L;
    if (Mask == 0)
      Mask = M.X[O.Rs2][M.last()] & 0xFFFF;
    if (Mask == 0)
      return M.trap(TrapCause::EmptyMask, M.first());
    M.Mask = Mask;
  };
}

void barrier(Model &M, Operands O) {
  const uint32_t Id = M.X[O.Rs1][M.last()], Count = M.X[O.Rs2][M.last()];
  if (M.Mask != M.Whole)
    return M.trap(TrapCause::DivergentBarrier, M.last());
  if ((Id & 0x7FFFFFFF) >= NumBarriers)
    return M.trap(TrapCause::BadBarrier, M.last());
  if (Count > 1)
    M.Why = Id >> 31 ? Stop::GlobalBarrier : Stop::LocalBarrier;
}

/// The number of the word at an address, Words if there is none.
unsigned wordAt(uint32_t Address) {
  unsigned N = 0;
  while (N != Words && wordAddress(N) != Address)
    ++N;
  return N;
}

/// Read, modify and write, one lane after the other.
Step amo(
    std::function<uint32_t(uint32_t Old, uint32_t Operand, uint32_t Rd)> New) {
  return [New](Model &M, Operands O) {
    std::array<uint32_t, MaxLanes> Olds{};
    for (unsigned L = 0; L != MaxLanes; ++L) {
      if (!M.active(L))
        continue;
      const uint32_t Address = M.X[O.Rs1][L];
      if (Address % 4 != 0)
        return M.trap(TrapCause::MisalignedStore, L);
      const unsigned N = wordAt(Address);
      if (N == Words)
        return M.trap(TrapCause::StoreFault, L);
      Olds[L] = M.Memory[N];
      M.Memory[N] = New(Olds[L], M.X[O.Rs2][L], M.X[O.Rd][L]);
    }
    eachLane(M, O.Rd, [&](unsigned L) { return Olds[L]; });
  };
}

/// amocas.d: registers of two words, of which x0 is none.
void swapPair(Model &M, Operands O) {
  std::array<std::array<uint32_t, MaxLanes>, 2> Olds{};
  const auto Word = [&](unsigned Register, unsigned Half, unsigned L) {
    return Register == 0 ? 0 : M.X[Register + Half][L];
  };
  for (unsigned L = 0; L != MaxLanes; ++L) {
    if (!M.active(L))
      continue;
    const uint32_t Address = M.X[O.Rs1][L];
    if (Address % 8 != 0)
      return M.trap(TrapCause::MisalignedStore, L);
    const unsigned N = wordAt(Address);
    if (N == Words)
      return M.trap(TrapCause::StoreFault, L);
    bool Same = true;
    for (unsigned Half = 0; Half != 2; ++Half) {
      Olds[Half][L] = M.Memory[N + Half];
      Same &= Olds[Half][L] == Word(O.Rd, Half, L);
    }
    for (unsigned Half = 0; Same && Half != 2; ++Half)
      M.Memory[N + Half] = Word(O.Rs2, Half, L);
  }
  for (unsigned Half = 0; O.Rd != 0 && Half != 2; ++Half)
    eachLane(M, O.Rd + Half, [&](unsigned L) { return Olds[Half][L]; });
}

int32_t s(uint32_t V) { return static_cast<int32_t>(V); }

const std::map<Op, Step> &models() {
  using Values = const std::vector<uint32_t> &;
  static const std::map<Op, Step> Table = {
      {Op::VX_TMC,
       [](Model &M, Operands O) {
         M.Mask = M.Whole = M.X[O.Rs1][M.last()] & 0xFFFF;
         if (M.Mask == 0)
           M.Why = Stop::Ended;
       }},
      // A machine of one warp has none to start.
      {Op::VX_WSPAWN, [](Model &, Operands) {}},
      {Op::VX_SPLIT, split(false)},
      {Op::VX_SPLIT_N, split(true)},
      {Op::VX_JOIN, join},
      {Op::VX_BAR, barrier},
      {Op::VX_PRED, pred(false)},
      {Op::VX_PRED_N, pred(true)},
      {Op::VX_VOTE_ALL,
       vote([](Values V) { return std::ranges::count(V, 0U) == 0 ? 1U : 0U; })},
      {Op::VX_VOTE_ANY, vote([](Values V) {
         return std::ranges::count(V, 0U) != std::ssize(V) ? 1U : 0U;
       })},
      {Op::VX_VOTE_UNI, vote([](Values V) {
         return std::ranges::count(V, V[0]) == std::ssize(V) ? 1U : 0U;
       })},
      {Op::VX_VOTE_BALLOT,
       [](Model &M, Operands O) {
         uint32_t Ballot = 0;
         for (unsigned L = 0; L != MaxLanes; ++L)
           if (M.active(L) && M.X[O.Rs1][L] != 0)
             Ballot |= 1U << L;
         eachLane(M, O.Rd, [&](unsigned) { return Ballot; });
       }},
      {Op::VX_SHFL_UP, shuffle([](int Lane, int B, int Lo, int, int) {
         return Lane - B >= Lo ? std::optional(Lane - B) : std::nullopt;
       })},
      {Op::VX_SHFL_DOWN, shuffle([](int Lane, int B, int, int Hi, int) {
         return Lane + B <= Hi ? std::optional(Lane + B) : std::nullopt;
       })},
      {Op::VX_SHFL_BFLY, shuffle([](int Lane, int B, int, int Hi, int) {
         return (Lane ^ B) <= Hi ? std::optional(Lane ^ B) : std::nullopt;
       })},
      {Op::VX_SHFL_IDX, shuffle([](int, int B, int Lo, int Hi, int Segment) {
         const int From = Lo | (B & ~Segment);
         return From <= Hi ? std::optional(From) : std::nullopt;
       })},
      {Op::RV_CZERO_EQZ,
       [](Model &M, Operands O) {
         eachLane(M, O.Rd, [&](unsigned L) {
           return M.X[O.Rs2][L] == 0 ? 0 : M.X[O.Rs1][L];
         });
       }},
      {Op::RV_CZERO_NEZ,
       [](Model &M, Operands O) {
         eachLane(M, O.Rd, [&](unsigned L) {
           return M.X[O.Rs2][L] != 0 ? 0 : M.X[O.Rs1][L];
         });
       }},
      {Op::RV_AMOADD_W, amo([](auto Old, auto V, auto) { return Old + V; })},
      {Op::RV_AMOSWAP_W, amo([](auto, auto V, auto) { return V; })},
      {Op::RV_AMOXOR_W, amo([](auto Old, auto V, auto) { return Old ^ V; })},
      {Op::RV_AMOAND_W, amo([](auto Old, auto V, auto) { return Old & V; })},
      {Op::RV_AMOOR_W, amo([](auto Old, auto V, auto) { return Old | V; })},
      {Op::RV_AMOMIN_W,
       amo([](auto Old, auto V, auto) { return s(V) < s(Old) ? V : Old; })},
      {Op::RV_AMOMAX_W,
       amo([](auto Old, auto V, auto) { return s(V) > s(Old) ? V : Old; })},
      {Op::RV_AMOMINU_W,
       amo([](auto Old, auto V, auto) { return V < Old ? V : Old; })},
      {Op::RV_AMOMAXU_W,
       amo([](auto Old, auto V, auto) { return V > Old ? V : Old; })},
      {Op::RV_AMOCAS_W,
       amo([](auto Old, auto V, auto Rd) { return Old == Rd ? V : Old; })},
      {Op::RV_AMOCAS_D, swapPair},
  };
  return Table;
}

bool isAmo(Op O) {
  return (InsnTable[static_cast<unsigned>(O)].Match & 0x7F) == 0x2F;
}

/// Values that make something of the instructions: small numbers, masks,
/// shuffle controls, all lanes alike, addresses for atomics.
class Values {
public:
  explicit Values(Op OIn) : O(OIn) {}

  void fill(Model &M) {
    M.Mask = 0;
    M.Stack.clear();
    for (auto &Register : M.X)
      fillRegister(Register);
    std::fill_n(M.X[0], MaxLanes, 0U);
    for (uint32_t &W : M.Memory)
      W = Random() % 4;
    const unsigned Depth = Random() % (StackLimit + 1);
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
  void expect(Model &M, Operands Where) {
    if ((O != Op::RV_AMOCAS_W && !isPair()) || Where.Rd == 0 ||
        Where.Rs1 / 2 == Where.Rd / 2)
      return;
    for (unsigned L = 0; L != MaxLanes; ++L)
      if (const unsigned N = wordAt(M.X[Where.Rs1][L]);
          N != Words && Random() % 2) {
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
    return wordAddress(isPair() ? Random() % Count & ~1U : Random() % Count);
  }
  uint32_t any() { return static_cast<uint32_t>(Random()); }
  void fillRegister(uint32_t *Register) {
    const uint32_t Same = value();
    const bool Alike = Random() % 3 == 0;
    // Most accesses are good, so that some warps have no fault.
    const bool Faulty = Random() % 8 == 0;
    for (unsigned L = 0; L != MaxLanes; ++L)
      if (isAmo(O) && Random() % 2)
        Register[L] = Faulty && Random() % 8 == 0 ? any() : anyWord(Words);
      else
        Register[L] = Alike ? Same : value();
    if (isAmo(O) && !Faulty && Random() % 2)
      for (unsigned L = 0; L != MaxLanes; ++L)
        Register[L] = anyWord(Random() % 2 ? Words : Words / 2);
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
      return (Random() % 2 << 31) | Random() % (NumBarriers + 2);
    default:
      return any();
    }
  }

  Op O;
  std::mt19937 Random{17};
};

void load(WarpRunner &R, const Model &M) {
  R.reset(); // barriers too
  for (unsigned N = 0; N != 32; ++N) {
    Lanes16 V;
    std::copy_n(M.X[N], MaxLanes, V.begin());
    R.setX(N, V);
  }
  R.setActive(M.Mask);
  R.warp().WholeMask = M.Whole;
  R.warp().StackLimit = StackLimit;
  R.warp().StackDepth = static_cast<uint32_t>(M.Stack.size());
  for (size_t N = 0; N != M.Stack.size(); ++N)
    R.warp().Stack[N] = {M.Stack[N].Mask, M.Stack[N].Other,
                         R.Code.begin() + M.Stack[N].Pc};
  for (unsigned N = 0; N != Words; ++N) {
    std::byte *At = N < Words / 2 ? R.warp().Mem->Local.at(wordAddress(N))
                                  : R.global(wordAddress(N));
    std::memcpy(At, &M.Memory[N], 4);
  }
}

void expectSame(WarpRunner &R, const Model &M) {
  WarpState &S = R.warp();
  for (unsigned N = 0; N != 32; ++N) {
    const Lanes16 Got = R.getX(N);
    for (unsigned L = 0; L != MaxLanes; ++L)
      ASSERT_EQ(Got[L], M.X[N][L]) << "x" << N << " of lane " << L;
  }
  for (unsigned N = 0; N != Words; ++N) {
    uint32_t Word = 0;
    std::memcpy(&Word,
                N < Words / 2 ? S.Mem->Local.at(wordAddress(N))
                              : R.global(wordAddress(N)),
                4);
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
    ASSERT_EQ(
        (StackEntry{S.Stack[N].Mask, S.Stack[N].Other,
                    static_cast<unsigned>(S.Stack[N].Pc - R.Code.begin())}),
        M.Stack[N]);
}

/// A parked atomic executes as the machine does it.
void finishAtomic(WarpRunner &R) {
  WarpState &S = R.warp();
  if (S.Why != Stop::Atomic)
    return;
  if (amoNow(&S, S.Next, amoKind(S.Next))) {
    Core::complete(S);
    R.run();
  }
}

void check(const ExecTable &Table, Op O, Operands Where, Values &Source) {
  std::vector<uint32_t> Code(Length, encode(Op::RV_ADDI, {}));
  Code[0] = encode(O, {.Rd = Where.Rd, .Rs1 = Where.Rs1, .Rs2 = Where.Rs2});
  WarpRunner R(Table, Code);
  constexpr unsigned Masks = MaxLanes + 1 + 23;
  for (unsigned N = 0; N != Masks; ++N) {
    Model M;
    Source.fill(M);
    Source.expect(M, Where);
    M.Mask = Source.mask(N);
    M.Whole = N % 3 ? M.Mask : M.Mask | Source.mask(MaxLanes + 1);
    load(R, M);
    const uint32_t Before = M.Mask;
    models().at(O)(M, Where);
    if (!M.Trap && M.Why == Stop::Ready)
      ++M.Pc;
    R.run();
    finishAtomic(R);
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
    for (const auto &[O, Step] : models()) {
      Values Source(O);
      for (int Try = 0; Try != 24; ++Try) {
        check(*Table, O, Source.operands(), Source);
        if (::testing::Test::HasFatalFailure())
          return;
      }
    }
}

TEST(SimtModel, CoversTheRecords) {
  constexpr uint32_t CustomZero = 0x0B;
  for (unsigned N = 0; N != NumOps; ++N)
    if ((InsnTable[N].Match & 0x7F) == CustomZero || isAmo(static_cast<Op>(N)))
      EXPECT_TRUE(models().contains(static_cast<Op>(N)))
          << InsnTable[N].Mnemonic;
}
