// Guesses which loads read one word for all lanes, as loads from tables do,
// which accesses are to places far apart, and which to the lanes' stacks. The
// code alone does not say where a pointer comes from that a loop moves on. So a
// guess begins with the registers and the stack of a warp that stands there.

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
  Values Uniform;   ///< one number in all active lanes
  Values Scattered; ///< numbers that do not grow slowly with the lane
  Values InStacks;  ///< addresses of stacks
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

bool isSameNow(uint32_t Mask, const LaneWords &Words) {
  const uint32_t First = Words[std::countr_zero(Mask)];
  bool Same = true;
  for (int L = 0; L != MaxLanes; ++L)
    Same &= (Mask >> L & 1) == 0 || Words[L] == First;
  return Same;
}

/// Whether active lanes' words do not grow by the same few bytes a lane, or
/// elements, as addresses of neighbours do.
bool isScatteredNow(uint32_t Mask, const LaneWords &Words) {
  constexpr uint32_t Most = WordBytes;
  const uint32_t First = std::countr_zero(Mask);
  const uint32_t Others = Mask & (Mask - 1);
  if (Others == 0)
    return false;
  const uint32_t Second = std::countr_zero(Others);
  const uint32_t Step = (Words[Second] - Words[First]) / (Second - First);
  bool Same = Step <= Most;
  for (uint32_t L = 0; L != MaxLanes; ++L)
    Same &=
        (Mask >> L & 1) == 0 || Words[L] - Words[First] == (L - First) * Step;
  return !Same;
}

Known knownNow(const WarpState &S) {
  Known K;
  // One lane agrees with itself, which says nothing of the others, that come
  // back behind.
  const uint32_t Mask =
      std::has_single_bit(S.Mask) ? S.Mask | S.WholeMask : S.Mask;
  if (Mask == 0)
    return K;
  const auto IsInStacks = [&S, Mask](const LaneWords &Words) {
    return S.Mem->Stack.holds(Words[std::countr_zero(Mask)], WordBytes);
  };
  for (unsigned N = 0; N != NumRegisters; ++N) {
    K.Uniform.Registers[N] = isSameNow(Mask, S.Registers[N]);
    K.Scattered.Registers[N] = isScatteredNow(S.Mask, S.Registers[N]);
    K.InStacks.Registers[N] = IsInStacks(S.Registers[N]);
  }
  for (size_t N = 0; N != K.Uniform.Words.size(); ++N) {
    LaneWords Words = {};
    bool IsThere = true;
    for (int L = 0; L != MaxLanes; ++L) {
      const uint32_t Address =
          S.Registers[StackPointer][L] + static_cast<uint32_t>(N) * WordBytes;
      if ((Mask >> L & 1) == 0)
        continue;
      IsThere &= S.Mem->Stack.holds(Address, WordBytes);
      if (!IsThere)
        break;
      uint32_t Word = 0;
      std::memcpy(&Word, S.Mem->Stack.Host + S.Mem->stackOffset(Address),
                  sizeof(Word));
      Words[L] = Word;
    }
    K.Uniform.Words[N] = IsThere && isSameNow(Mask, Words);
    K.Scattered.Words[N] = IsThere && isScatteredNow(S.Mask, Words);
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
      K.Scattered.Registers[N] = false;
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

/// Whether the result of \p G is scattered if its operands are as \p K has it.
bool isScattered(const GuestInsn &G, const Known &K) {
  if (isUniform(G, K.Uniform))
    return false;
  const InsnInfo &Info = InsnTable[static_cast<unsigned>(G.Opcode)];
  const auto Is = [&K](File F, uint16_t Register) {
    return F == File::X && K.Scattered.Registers[numberOf(Register)];
  };
  switch (G.Is) {
  case Kind::Integer:
    return Is(Info.Rs1, G.I->Rs1) || Is(Info.Rs2, G.I->Rs2);
  case Kind::Load: {
    const auto Word = stackWordOf(G);
    return !Word || K.Scattered.Words[*Word];
  }
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
  Flow(const WarpState &S, std::vector<GuestInsn> &RegionIn)
      : Warp(S), Region(RegionIn), Before(Region.size()) {}

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

  void reachAddress(uint32_t Address, const Known &K) {
    const uint32_t Number = (Address - Warp.CodeLo) / WordBytes;
    if (Number < Warp.CodeCount)
      reach(Warp.Code + Number, K);
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
      G.IsScattered = Before[N]->Scattered.Registers[Base];
      G.IsInStacks = Before[N]->InStacks.Registers[Base];
    }
  }

private:
  void pass(const GuestInsn &G, Known K) {
    if (G.Opcode == Op::VX_TMC && G.I->Rs1 == XBase)
      return; // the warp's end
    const InsnInfo &Info = InsnTable[static_cast<unsigned>(G.Opcode)];
    if (const auto Word = stackWordOf(G); Word && G.Is == Kind::Store)
      for (Values *V : {&K.Uniform, &K.Scattered, &K.InStacks})
        V->Words[*Word] = V->Registers[numberOf(G.I->Rs2)];
    if (Info.Rd != File::None && !isSink(G.I->Rd)) {
      const unsigned Rd = numberOf(G.I->Rd);
      const bool IsUniform = isUniform(G, K.Uniform);
      const bool IsFar = isScattered(G, K);
      K.Uniform.Registers[Rd] = IsUniform;
      K.Scattered.Registers[Rd] = IsFar;
      K.InStacks.Registers[Rd] = isInStacks(G, K.InStacks);
      if (Rd == StackPointer)
        for (Values *V : {&K.Uniform, &K.Scattered, &K.InStacks})
          V->Words.reset();
    }
    if (G.Is == Kind::Branch || G.Is == Kind::Jump)
      reach(G.I + (G.I->Imm >> 2), K);
    if (G.Is != Kind::Jump && G.Is != Kind::Indirect)
      return reach(G.I + 1, K);
    if (isSink(G.I->Rd))
      return;
    // Loops over work-items keep their kernel's address in a register.
    if (G.Is == Kind::Indirect)
      reachAddress(Warp.Registers[numberOf(G.I->Rs1)][Warp.LastLane] +
                       static_cast<uint32_t>(G.I->Imm),
                   K);
    reach(G.I + 1, behindCall(K));
  }

  const WarpState &Warp;
  std::vector<GuestInsn> &Region;
  std::vector<std::optional<Known>> Before;
  std::deque<size_t> Ahead;
};

} // namespace

void guessAddresses(std::vector<GuestInsn> &Region, const WarpState &S) {
  Flow F(S, Region);
  const Known Now = knownNow(S);
  F.reach(S.Next, Now);
  // In a short function nothing else says what its caller has.
  F.reachAddress(S.Registers[ReturnAddress][S.LastLane], Now);
  F.follow();
  F.mark();
}

} // namespace vorion::isasim::translate
