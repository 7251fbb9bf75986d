// Guesses which loads read one word for all lanes, as loads from tables do, and
// which accesses are to the lanes' stacks. The code alone does not say where a
// pointer comes from that a loop moves on. So a guess begins with the registers
// and the stack of a warp that stands there.

#include "core/State.h"
#include "translate/Region.h"

#include <algorithm>
#include <bit>
#include <bitset>
#include <cstring>
#include <deque>
#include <optional>

namespace vorion::isasim::translate {

namespace {

constexpr unsigned ReturnAddress = 1, StackPointer = 2, WordBytes = 4;

/// What has a property: registers, and the words from the stack pointer on,
/// where compilers keep what they have no register for.
struct Values {
  std::bitset<NumRegisters> Registers;
  std::bitset<256> Words;
};

struct Known {
  Values Uniform;  ///< one number in all active lanes
  Values InStacks; ///< addresses of stacks
};

/// The number in Values::Words that \p G loads or stores, if it does.
std::optional<size_t> stackWordOf(const GuestInsn &G) {
  const auto Word = static_cast<size_t>(G.I->Imm) / WordBytes;
  if ((G.Is != Kind::Load && G.Is != Kind::Store) ||
      numberOf(G.I->Rs1) != StackPointer || G.I->Imm < 0 ||
      Word >= Values().Words.size())
    return std::nullopt;
  return Word;
}

bool isSameNow(const WarpState &S, const LaneWords &Words) {
  const uint32_t First = Words[std::countr_zero(S.Mask)];
  bool Same = true;
  for (int L = 0; L != MaxLanes; ++L)
    Same &= (S.Mask >> L & 1) == 0 || Words[L] == First;
  return Same;
}

Known knownNow(const WarpState &S) {
  Known K;
  if (S.Mask == 0)
    return K;
  const auto IsInStacks = [&S](const LaneWords &Words) {
    return S.Mem->Stack.holds(Words[std::countr_zero(S.Mask)], WordBytes);
  };
  for (unsigned N = 0; N != NumRegisters; ++N) {
    K.Uniform.Registers[N] = isSameNow(S, S.Registers[N]);
    K.InStacks.Registers[N] = IsInStacks(S.Registers[N]);
  }
  for (size_t N = 0; N != K.Uniform.Words.size(); ++N) {
    LaneWords Words = {};
    bool IsThere = true;
    for (int L = 0; L != MaxLanes; ++L) {
      const uint32_t Address =
          S.Registers[StackPointer][L] + static_cast<uint32_t>(N) * WordBytes;
      if ((S.Mask >> L & 1) == 0)
        continue;
      IsThere &= S.Mem->Stack.holds(Address, WordBytes);
      if (!IsThere)
        break;
      uint32_t Word = 0;
      std::memcpy(&Word, S.Mem->Stack.Host + S.Mem->stackOffset(Address),
                  sizeof(Word));
      Words[L] = Word;
    }
    K.Uniform.Words[N] = IsThere && isSameNow(S, Words);
    K.InStacks.Words[N] = IsThere && IsInStacks(Words);
  }
  return K;
}

/// What is still known of \p K behind a call: a function may overwrite the
/// calling convention's temporaries and arguments.
Known behindCall(Known K) {
  const auto Lose = [&K](unsigned First, unsigned Last) {
    for (unsigned N = First; N <= Last; ++N) {
      K.Uniform.Registers[N] = false;
      K.InStacks.Registers[N] = false;
    }
  };
  for (const unsigned File : {XBase, FBase}) {
    Lose(File + 10, File + 17);
    Lose(File + 28, File + 31);
  }
  Lose(XBase + 5, XBase + 7);
  Lose(FBase + 0, FBase + 7);
  return K;
}

/// Whether the result of \p G is one number if its operands are as \p U has it.
bool isUniform(const GuestInsn &G, const Values &U) {
  const InsnInfo &Info = InsnTable[static_cast<unsigned>(G.Opcode)];
  const auto Is = [&U](File F, uint16_t Register) {
    return F == File::None || U.Registers[numberOf(Register)];
  };
  switch (G.Is) {
  case Kind::Integer:
    if (G.Opcode == Op::RV_CSRRS)
      return G.I->Word >> 20 == CSR_ACTIVE_THREADS;
    [[fallthrough]];
  case Kind::Float:
    return Is(Info.Rs1, G.I->Rs1) && Is(Info.Rs2, G.I->Rs2) &&
           Is(Info.Rs3, G.I->Rs3);
  case Kind::Load: {
    const auto Word = stackWordOf(G);
    return Word ? U.Words[*Word] : U.Registers[numberOf(G.I->Rs1)];
  }
  case Kind::Jump:
  case Kind::Indirect:
  case Kind::Lanes:
  case Kind::Vote:
    return true;
  default:
    return false;
  }
}

/// Whether the result of \p G is an address of stacks if its operands are as
/// \p V has it.
bool isInStacks(const GuestInsn &G, const Values &V) {
  if (G.Is == Kind::Load) {
    const auto Word = stackWordOf(G);
    return Word && V.Words[*Word];
  }
  const InsnInfo &Info = InsnTable[static_cast<unsigned>(G.Opcode)];
  const auto Is = [&V](File F, uint16_t Register) {
    return F == File::X && V.Registers[numberOf(Register)];
  };
  return G.Is == Kind::Integer &&
         (Is(Info.Rs1, G.I->Rs1) || Is(Info.Rs2, G.I->Rs2));
}

/// What is known in front of a region's instructions, and which are to be
/// followed.
class Flow {
public:
  explicit Flow(std::vector<GuestInsn> &RegionIn)
      : Region(RegionIn), Before(Region.size()) {}

  /// \p K is in front of \p I on the shortest way, which comes first. Longer
  /// ones know less.
  void reach(const Insn *I, const Known &K) {
    const auto At = std::ranges::lower_bound(Region, I, {}, &GuestInsn::I);
    if (At == Region.end() || At->I != I)
      return;
    const auto N = static_cast<size_t>(At - Region.begin());
    if (Before[N])
      return;
    Before[N] = K;
    Ahead.push_back(N);
  }

  void follow() {
    while (!Ahead.empty()) {
      const size_t N = Ahead.front();
      Ahead.pop_front();
      pass(Region[N], *Before[N]);
    }
  }

  void mark() const {
    for (size_t N = 0; N != Region.size(); ++N) {
      GuestInsn &G = Region[N];
      if ((G.Is != Kind::Load && G.Is != Kind::Store) || !Before[N])
        continue;
      const unsigned Base = numberOf(G.I->Rs1);
      G.HasOneAddress =
          G.Is == Kind::Load && Before[N]->Uniform.Registers[Base];
      G.IsInStacks = Before[N]->InStacks.Registers[Base];
    }
  }

private:
  void pass(const GuestInsn &G, Known K) {
    const InsnInfo &Info = InsnTable[static_cast<unsigned>(G.Opcode)];
    if (const auto Word = stackWordOf(G); Word && G.Is == Kind::Store)
      for (Values *V : {&K.Uniform, &K.InStacks})
        V->Words[*Word] = V->Registers[numberOf(G.I->Rs2)];
    if (Info.Rd != File::None && !isSink(G.I->Rd)) {
      const unsigned Rd = numberOf(G.I->Rd);
      const bool IsUniform = isUniform(G, K.Uniform);
      K.Uniform.Registers[Rd] = IsUniform;
      K.InStacks.Registers[Rd] = isInStacks(G, K.InStacks);
      if (Rd == StackPointer)
        for (Values *V : {&K.Uniform, &K.InStacks})
          V->Words.reset();
    }
    if (G.Is == Kind::Branch || G.Is == Kind::Jump)
      reach(G.I + (G.I->Imm >> 2), K);
    if (G.Is != Kind::Jump && G.Is != Kind::Indirect)
      reach(G.I + 1, K);
    else if (!isSink(G.I->Rd))
      reach(G.I + 1, behindCall(K));
  }

  std::vector<GuestInsn> &Region;
  std::vector<std::optional<Known>> Before;
  std::deque<size_t> Ahead;
};

} // namespace

void guessAddresses(std::vector<GuestInsn> &Region, const WarpState &S) {
  Flow F(Region);
  const Known Now = knownNow(S);
  F.reach(S.Next, Now);
  // In a short function nothing else says what its caller has.
  const uint32_t Back = (S.Registers[ReturnAddress][S.LastLane] - S.CodeLo) / 4;
  if (Back < S.CodeCount)
    F.reach(S.Code + Back, Now);
  F.follow();
  F.mark();
}

} // namespace vorion::isasim::translate
