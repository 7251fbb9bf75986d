// Guesses which loads read one word for all lanes, as loads from tables do. The
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

/// What has one number in all active lanes: registers, and the words from the
/// stack pointer on, where compilers keep what they have no register for.
struct Uniform {
  std::bitset<NumRegisters> Registers;
  std::bitset<256> Words;
};

/// The number in Uniform::Words that \p G loads or stores, if it does.
std::optional<size_t> stackWordOf(const GuestInsn &G, const Uniform &U) {
  const auto Word = static_cast<size_t>(G.I->Imm) / WordBytes;
  if ((G.Is != Kind::Load && G.Is != Kind::Store) ||
      numberOf(G.I->Rs1) != StackPointer || G.I->Imm < 0 ||
      Word >= U.Words.size())
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

Uniform uniformNow(const WarpState &S) {
  Uniform U;
  if (S.Mask == 0)
    return U;
  for (unsigned N = 0; N != NumRegisters; ++N)
    U.Registers[N] = isSameNow(S, S.Registers[N]);
  for (size_t N = 0; N != U.Words.size(); ++N) {
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
    U.Words[N] = IsThere && isSameNow(S, Words);
  }
  return U;
}

/// What is still known of \p U behind a call: a function may overwrite the
/// calling convention's temporaries and arguments.
Uniform behindCall(Uniform U) {
  const auto Lose = [&U](unsigned First, unsigned Last) {
    for (unsigned N = First; N <= Last; ++N)
      U.Registers[N] = false;
  };
  for (const unsigned File : {XBase, FBase}) {
    Lose(File + 10, File + 17);
    Lose(File + 28, File + 31);
  }
  Lose(XBase + 5, XBase + 7);
  Lose(FBase + 0, FBase + 7);
  return U;
}

/// Whether the result of \p G is one number if its operands are as \p U has it.
bool isUniform(const GuestInsn &G, const Uniform &U) {
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
    const auto Word = stackWordOf(G, U);
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

/// What is uniform in front of a region's instructions, and which are to be
/// followed.
class Flow {
public:
  explicit Flow(std::vector<GuestInsn> &RegionIn)
      : Region(RegionIn), Before(Region.size()) {}

  /// \p U is in front of \p I on the shortest way, which comes first. Longer
  /// ones know less.
  void reach(const Insn *I, const Uniform &U) {
    const auto At = std::ranges::lower_bound(Region, I, {}, &GuestInsn::I);
    if (At == Region.end() || At->I != I)
      return;
    const auto N = static_cast<size_t>(At - Region.begin());
    if (Before[N])
      return;
    Before[N] = U;
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
    for (size_t N = 0; N != Region.size(); ++N)
      if (GuestInsn &G = Region[N]; G.Is == Kind::Load && Before[N])
        G.HasOneAddress = Before[N]->Registers[numberOf(G.I->Rs1)];
  }

private:
  void pass(const GuestInsn &G, Uniform U) {
    const InsnInfo &Info = InsnTable[static_cast<unsigned>(G.Opcode)];
    if (const auto Word = stackWordOf(G, U); Word && G.Is == Kind::Store)
      U.Words[*Word] = U.Registers[numberOf(G.I->Rs2)];
    if (Info.Rd != File::None && !isSink(G.I->Rd)) {
      U.Registers[numberOf(G.I->Rd)] = isUniform(G, U);
      if (numberOf(G.I->Rd) == StackPointer)
        U.Words.reset();
    }
    if (G.Is == Kind::Branch || G.Is == Kind::Jump)
      reach(G.I + (G.I->Imm >> 2), U);
    if (G.Is != Kind::Jump && G.Is != Kind::Indirect)
      reach(G.I + 1, U);
    else if (!isSink(G.I->Rd))
      reach(G.I + 1, behindCall(U));
  }

  std::vector<GuestInsn> &Region;
  std::vector<std::optional<Uniform>> Before;
  std::deque<size_t> Ahead;
};

} // namespace

void guessAddresses(std::vector<GuestInsn> &Region, const WarpState &S) {
  Flow F(Region);
  const Uniform Now = uniformNow(S);
  F.reach(S.Next, Now);
  // In a short function nothing else says what its caller has.
  const uint32_t Back = (S.Registers[ReturnAddress][S.LastLane] - S.CodeLo) / 4;
  if (Back < S.CodeCount)
    F.reach(S.Code + Back, Now);
  F.follow();
  F.mark();
}

} // namespace vorion::isasim::translate
