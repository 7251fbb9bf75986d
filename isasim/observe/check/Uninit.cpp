/// Checker of uses of memory that nothing was written to.
#include "core/Effects.h"
#include "core/Isa.h"
#include "core/State.h"
#include "observe/check/Check.h"
#include "observe/check/ShadowBits.h"
#include "raster/WorkLog.h"

#include <bit>
#include <fmt/format.h>
#include <vector>

namespace vorion::isasim {

/// Follows, for each byte of memory and of each lane of each register, whether
/// its value comes from something that was written. Copying and computing with
/// what was not is no finding; deciding (a branch, split or vote), addressing,
/// writing a CSR, an atomic, and storing to a buffer are. One byte of a word
/// that was not written spoils results of the word, except where an and, or or
/// conditional zero with a constant hides it. But a copy of the word is stored
/// as it is, and is a finding only if none of its bytes was written: structures
/// are copied with the bytes between their members.
class UninitCheck : public Check {
public:
  UninitCheck(Reporter Out, const Places &Where) : Out(Out), Where(Where) {}

  void allocated(uint32_t Address, uint64_t Bytes,
                 const std::string &) override {
    Global.set(Address, Bytes, false);
  }
  void hostWrote(uint32_t Address, uint64_t Bytes) override {
    Global.set(Address, Bytes, true);
  }

  void runBegins(const RunStart &R) override;
  void fetch(const Step &S) override;
  void commit(const Commit &C) override;
  void rasterCommand(const raster::CommandWork &W) override;

private:
  /// Of a word in each lane: a bit for each lane, by byte, that is known to be
  /// good.
  struct Word {
    std::array<uint32_t, 4> Bytes{};

    static Word wholeIn(uint32_t Lanes) {
      return {{Lanes, Lanes, Lanes, Lanes}};
    }
    /// Lanes in which all bytes are good.
    uint32_t whole() const { return Bytes[0] & Bytes[1] & Bytes[2] & Bytes[3]; }
    void set(uint32_t Lanes, const Word &To) {
      for (size_t N = 0; N != Bytes.size(); ++N)
        Bytes[N] = (Bytes[N] & ~Lanes) | (To.Bytes[N] & Lanes);
    }
  };
  struct Warp {
    std::array<Word, 64> Good{}; ///< x0 to x31, f0 to f31
    Word Result; ///< what the present instruction's result will be
    std::array<uint32_t, 16> StackPointer{}; ///< before it
  };

  uint32_t goodSource(const Step &S, const Warp &W) const;
  uint32_t maskedSource(const Step &S, const Warp &W) const;
  void use(const Step &S, Warp &W, unsigned Register, uint32_t Lanes,
           const char *What);
  void checkUses(const Step &S, Warp &W);
  void checkStore(const Step &S, Warp &W);
  Word load(const Step &S);
  Word resultOfOwn(const Step &S, const Warp &W) const;
  Word resultOf(const Step &S, const Warp &W);
  ShadowBits *shadowOf(uint32_t Address, const Step &S);
  void moveStack(const Commit &C, Warp &W);

  Reporter Out;
  const Places &Where;
  ShadowBits Global, Stacks;
  std::vector<ShadowBits> Locals; ///< by core
  std::vector<Warp> Warps;
  unsigned WarpsPerCore = 1;
};

namespace {

constexpr uint32_t AllLanes = 0xFFFF;
constexpr unsigned StackRegister = 2;

/// The place of a register in Warp::Good, or -1.
int place(File F, unsigned Number) {
  return F == File::X   ? static_cast<int>(XBase + Number)
         : F == File::F ? static_cast<int>(FBase + Number)
                        : -1;
}

uint32_t lastLane(uint32_t Mask) { return 1U << (std::bit_width(Mask) - 1); }

const uint32_t *words(const Step &S, unsigned Register) {
  return S.State.lanes(Register * sizeof(LaneWords));
}

template <typename Function> uint32_t lanesWhere(uint32_t Mask, Function F) {
  uint32_t Result = 0;
  for (uint32_t Left = Mask; Left; Left &= Left - 1)
    if (F(static_cast<unsigned>(std::countr_zero(Left))))
      Result |= Left & -Left;
  return Result;
}

} // namespace

void UninitCheck::runBegins(const RunStart &R) {
  const Config &Shape = R.Shape;
  WarpsPerCore = Shape.WarpsPerCore;
  Warps.assign(size_t{Shape.cores()} * WarpsPerCore, Warp());
  for (Warp &W : Warps)
    W.Good[0] = Word::wholeIn(AllLanes);
  Locals = std::vector<ShadowBits>(Where.agents());
  Stacks.clear();
}

ShadowBits *UninitCheck::shadowOf(uint32_t Address, const Step &S) {
  switch (Where.kindOf(Address)) {
  case Places::Global:
    return &Global;
  case Places::Local:
    return &Locals[Where.agentOf(S)];
  case Places::Stack:
    return &Stacks;
  case Places::Program:
  case Places::Nothing:
    break;
  }
  return nullptr; // always good: the loader has written it
}

/// Lanes in which every source register is good.
uint32_t UninitCheck::goodSource(const Step &S, const Warp &W) const {
  const InsnInfo &Info = S.Insn.info();
  uint32_t Good = AllLanes;
  for (const int R : {place(Info.Rs1, S.Insn.Rs1), place(Info.Rs2, S.Insn.Rs2),
                      place(Info.Rs3, S.Insn.Rs3)})
    if (R >= 0)
      Good &= W.Good[static_cast<size_t>(R)].whole();
  return Good;
}

/// Lanes in which a good operand alone decides the result.
uint32_t UninitCheck::maskedSource(const Step &S, const Warp &W) const {
  const uint32_t *A = words(S, S.Insn.Rs1), *B = words(S, S.Insn.Rs2);
  const uint32_t GoodA = W.Good[S.Insn.Rs1].whole(),
                 GoodB = W.Good[S.Insn.Rs2].whole();
  const auto Where0 = [&](uint32_t Good, const uint32_t *V, uint32_t Value) {
    return lanesWhere(Good & S.LaneMask,
                      [&](unsigned L) { return V[L] == Value; });
  };
  switch (S.Insn.Opcode) {
  case Op::RV_AND:
  case Op::RV_MUL:
    return Where0(GoodA, A, 0) | Where0(GoodB, B, 0);
  case Op::RV_ANDN:
    return Where0(GoodA, A, 0) | Where0(GoodB, B, ~0U);
  case Op::RV_OR:
    return Where0(GoodA, A, ~0U) | Where0(GoodB, B, ~0U);
  case Op::RV_ORN:
    return Where0(GoodA, A, ~0U) | Where0(GoodB, B, 0);
  case Op::RV_CZERO_EQZ:
    return Where0(GoodB, B, 0);
  case Op::RV_CZERO_NEZ:
    return lanesWhere(GoodB & S.LaneMask,
                      [&](unsigned L) { return B[L] != 0; });
  case Op::RV_XOR:
  case Op::RV_SUB:
    // How a register is zeroed.
    return S.Insn.Rs1 == S.Insn.Rs2 ? AllLanes : 0;
  default:
    return 0;
  }
}

void UninitCheck::use(const Step &S, Warp &W, unsigned Register, uint32_t Lanes,
                      const char *What) {
  const uint32_t Bad = S.LaneMask & Lanes & ~W.Good[Register].whole();
  if (!Bad)
    return;
  Out.add(
      Culprit::of(S, static_cast<unsigned>(std::countr_zero(Bad))),
      fmt::format("{} from uninitialized memory (lanes 0x{:04x})", What, Bad));
  // Once is enough.
  W.Good[Register].set(Bad, Word::wholeIn(AllLanes));
}

void UninitCheck::checkUses(const Step &S, Warp &W) {
  const Decoded &D = S.Insn;
  for (const OperandUse &U : effectsOf(D.Opcode).Uses) {
    if (U.Which == UsedOperand::None)
      break;
    const unsigned Register = U.Which == UsedOperand::Rs1 ? D.Rs1 : D.Rs2;
    const uint32_t Lanes = U.LastLane ? lastLane(S.LaneMask) : AllLanes;
    use(S, W, Register, Lanes, U.What);
    if (U.Which == UsedOperand::Rs2 && D.info().Pairs && Register != 0)
      use(S, W, Register + 1, Lanes, U.What);
  }
}

UninitCheck::Word UninitCheck::load(const Step &S) {
  Word Result = Word::wholeIn(AllLanes);
  const unsigned Bytes = S.Access->Bytes;
  for (uint32_t Left = S.LaneMask; Left; Left &= Left - 1) {
    const uint32_t Address =
        S.Access->Addresses[static_cast<size_t>(std::countr_zero(Left))];
    ShadowBits *Shadow = shadowOf(Address, S);
    if (!Shadow || Address % Bytes != 0 || Shadow->all(Address, Bytes))
      continue;
    const uint32_t Lane = Left & -Left;
    // What extends a byte or half comes from its last byte. An atomic of more
    // than a word computes.
    for (unsigned N = 0; N != Result.Bytes.size(); ++N)
      if (Bytes > Result.Bytes.size() ||
          !Shadow->all(Address + std::min(N, Bytes - 1), 1))
        Result.Bytes[N] &= ~Lane;
  }
  return Result;
}

/// The definedness of what an instruction gives each lane of its own operands.
UninitCheck::Word UninitCheck::resultOfOwn(const Step &S, const Warp &W) const {
  const Decoded &D = S.Insn;
  switch (D.Opcode) {
  case Op::RV_ADDI:
    if (D.Imm == 0)
      return W.Good[D.Rs1];
    break;
  case Op::RV_FMV_X_W:
    return W.Good[FBase + D.Rs1];
  case Op::RV_FMV_W_X:
    return W.Good[D.Rs1];
  case Op::RV_FSGNJ_S:
    if (D.Rs1 == D.Rs2)
      return W.Good[FBase + D.Rs1];
    break;
  default: // any other operation of the lane's own operands
    break;
  }
  return Word::wholeIn(goodSource(S, W) | maskedSource(S, W));
}

UninitCheck::Word UninitCheck::resultOf(const Step &S, const Warp &W) {
  const uint32_t Good = W.Good[S.Insn.Rs1].whole();
  switch (effectsOf(S.Insn.Opcode).Result) {
  case Definedness::NoResult:
  case Definedness::Always:
    return Word::wholeIn(AllLanes);
  case Definedness::OwnOperands:
    return resultOfOwn(S, W);
  case Definedness::EveryLane:
    return Word::wholeIn(S.LaneMask & ~Good ? 0 : AllLanes);
  case Definedness::AnyLane:
    return Word::wholeIn(S.LaneMask & Good ? AllLanes : 0);
  case Definedness::FromMemory:
    return load(S);
  }
  __builtin_unreachable();
}

void UninitCheck::fetch(const Step &S) {
  Warp &W = Warps[size_t{S.Core} * WarpsPerCore + S.Warp];
  // A group begins: what its predecessor left in local memory is not its own.
  if (Where.hasLaunch() && S.Pc == Where.launch().Entry)
    Locals[Where.agentOf(S)].clear();
  checkUses(S, W);
  const InsnInfo &Info = S.Insn.info();
  if (Info.Rd == File::X && S.Insn.Rd == StackRegister)
    std::copy_n(words(S, StackRegister), W.StackPointer.size(),
                W.StackPointer.begin());
  W.Result = resultOf(S, W);
}

void UninitCheck::checkStore(const Step &S, Warp &W) {
  const InsnInfo &Info = S.Insn.info();
  const bool IsStore = S.Access->What == MemoryAccess::Store;
  const auto Register =
      static_cast<unsigned>(std::max(0, place(Info.Rs2, S.Insn.Rs2)));
  const Word Good = IsStore ? W.Good[Register] : Word::wholeIn(AllLanes);
  const unsigned Bytes = S.Access->Bytes;
  for (uint32_t Left = S.LaneMask; Left; Left &= Left - 1) {
    const auto L = static_cast<unsigned>(std::countr_zero(Left));
    const uint32_t Address = S.Access->Addresses[L];
    ShadowBits *Shadow = shadowOf(Address, S);
    if (!Shadow)
      continue;
    if (Good.whole() >> L & 1) {
      Shadow->set(Address, Bytes, true);
      continue;
    }
    bool HasGood = false;
    for (unsigned N = 0; N != Bytes; ++N) {
      const bool IsGood = Good.Bytes[N] >> L & 1;
      Shadow->set(Address + N, 1, IsGood);
      HasGood |= IsGood;
    }
    if (HasGood || Shadow != &Global || !Where.Held.find(Address, 1))
      continue;
    // The driver's own memory keeps values across barriers: a copy.
    if (Where.hasLaunch() && Where.isContext(Address))
      continue;
    Out.add(Culprit::of(S, L),
            fmt::format(
                "store of a value from uninitialized memory at 0x{:08x}, {}",
                Address, Where.describe(Address, S, L)));
    Shadow->set(Address, Bytes, true);
  }
}

void UninitCheck::moveStack(const Commit &C, Warp &W) {
  // A frame that is made holds nothing yet, whatever lay there before.
  for (uint32_t Left = C.LaneMask; Left; Left &= Left - 1) {
    const auto L = static_cast<unsigned>(std::countr_zero(Left));
    const uint32_t Old = W.StackPointer[L], New = C.Result[L];
    if (New < Old && Old - New < Where.shape().StackBytes &&
        Where.kindOf(New) == Places::Stack)
      Stacks.set(New, Old - New, false);
  }
}

void UninitCheck::commit(const Commit &C) {
  Warp &W = Warps[size_t{C.Core} * WarpsPerCore + C.Warp];
  const InsnInfo &Info = C.Insn.info();
  if (C.Access && C.Access->What != MemoryAccess::Load)
    checkStore(C, W);
  const int Rd = place(Info.Rd, C.Insn.Rd);
  if (Rd <= 0)
    return;
  const size_t Registers = Info.Pairs ? 2 : 1;
  for (Word &Good :
       std::span(W.Good).subspan(static_cast<size_t>(Rd), Registers))
    Good.set(C.LaneMask, W.Result);
  if (Rd == StackRegister && !C.Result.empty())
    moveStack(C, W);
}

void UninitCheck::rasterCommand(const raster::CommandWork &W) {
  const raster::Job &J = W.What;
  if (!J.usesOutput())
    return;
  for (unsigned Row = 0; Row < J.Height; ++Row)
    Global.set(J.Output + Row * J.OutputPitch, J.Width * J.pixelBytes(), true);
}

std::unique_ptr<Check> makeUninitCheck(Reporter Out, const Places &Where) {
  return std::make_unique<UninitCheck>(Out, Where);
}

} // namespace vorion::isasim
