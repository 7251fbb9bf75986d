#include "translate/Region.h"

#include "core/Atomics.h"
#include "core/Effects.h"

#include <algorithm>
#include <deque>
#include <map>
#include <set>

namespace vorion::isasim::translate {

namespace {

/// Instructions of a region at most: half a million bytes of host code with
/// AVX-512. The kernels of `splat` that have most are whole with it.
constexpr size_t MostInstructions = 2500;

/// What going to the interpreter and coming back costs, in instructions that
/// the interpreter could do meanwhile.
constexpr unsigned WorthEntering = 10;

/// Rounds to nearest, as the translation's only mode does.
bool roundsAsHost(const Insn *I) {
  const auto Mode = static_cast<unsigned>(I->Imm);
  return Mode == Rne || Mode == DynamicRm;
}

/// Those with a third operand are rare.
constexpr bool canTranslate(Amo Kind) {
  return Kind != Amo::Cas && Kind != Amo::CasPair;
}

/// What takes many instructions of AVX2, and is rare.
bool needsWide(Op O, const Insn *I) {
  switch (O) {
  case Op::RV_FCLASS_S:
    return true;
  case Op::RV_FCVT_S_W:
  case Op::RV_FCVT_S_WU:
    return !roundsAsHost(I);
  default:
    return false;
  }
}

/// Operations of each lane's own operands.
Kind kindOfOwn(Op O, const Insn *I) {
  switch (O) {
#define INT(OP, RESULT) case Op::OP:
#include "core/insns/integer.def"
  case Op::RV_LUI:
  case Op::RV_AUIPC:
    return Kind::Integer;
#define FLOAT(OP, SOFT, RESULT) case Op::OP:
#define FUSED(OP, SOFT, FACTOR, ADDEND) case Op::OP:
#include "core/insns/float.def"
    return roundsAsHost(I) ? Kind::Float : Kind::Other;
#define TOINT(OP, SIGNED, SOFT) case Op::OP:
#define FROMINT(OP, SIGNED, SOFT) case Op::OP:
#include "core/insns/float.def"
    // The host has a form for every mode but ties away from zero.
    return static_cast<unsigned>(I->Imm) == Rmm ? Kind::Other : Kind::Float;
  case Op::RV_FEQ_S:
  case Op::RV_FLT_S:
  case Op::RV_FLE_S:
  case Op::RV_FMIN_S:
  case Op::RV_FMAX_S:
    return Kind::Float;
  default:
    return Kind::Other;
  }
}

/// Whether the emitter has host code for what lanes do with each other.
bool hasHostCode(Op O) {
  switch (O) {
  case Op::VX_SPLIT:
  case Op::VX_SPLIT_N:
  case Op::VX_JOIN:
  case Op::VX_PRED:
  case Op::VX_PRED_N:
  case Op::VX_VOTE_ALL:
  case Op::VX_VOTE_ANY:
  case Op::VX_VOTE_UNI:
  case Op::VX_VOTE_BALLOT:
  case Op::VX_SHFL_UP:
  case Op::VX_SHFL_DOWN:
  case Op::VX_SHFL_BFLY:
  case Op::VX_SHFL_IDX:
    return true;
  default:
    return false;
  }
}

Kind kindOfAtomic(Op O) {
  switch (O) {
#define AMO(OP, KIND)                                                          \
  case Op::OP:                                                                 \
    return canTranslate(Amo::KIND) ? Kind::Atomic : Kind::Other;
#include "core/insns/memory.def"
  default:
    return Kind::Other;
  }
}

/// csrr of what every work-item function reads.
bool readsLanes(const Insn *I) {
  const bool OnlyReads = (I->Word >> 12 & 0xFF) == 2; // csrrs rd, csr, x0
  const uint32_t Number = I->Word >> 20;
  return OnlyReads && (Number == CSR_THREAD_ID || Number == CSR_ACTIVE_THREADS);
}

Kind kindOf(VectorUnit Unit, Op O, const Insn *I) {
  if (Unit != VectorUnit::Avx512 && needsWide(O, I))
    return Kind::Other;
  switch (effectsOf(O).Class) {
  case EffectClass::LaneWise:
    return kindOfOwn(O, I);
  case EffectClass::Split:
  case EffectClass::Join:
  case EffectClass::Predicate:
    return hasHostCode(O) ? Kind::Lanes : Kind::Other;
  case EffectClass::Vote:
    return hasHostCode(O) ? Kind::Vote : Kind::Other;
  case EffectClass::Shuffle:
    return hasHostCode(O) ? Kind::Shuffle : Kind::Other;
  case EffectClass::Warps:
    return O == Op::VX_BAR ? Kind::Barrier : Kind::Other;
  case EffectClass::Load:
    return Kind::Load;
  case EffectClass::Store:
    return Kind::Store;
  case EffectClass::Atomic:
    return kindOfAtomic(O);
  case EffectClass::Fence:
    return Kind::Fence;
  case EffectClass::Branch:
    return I->Imm == BadTarget ? Kind::Other : Kind::Branch;
  case EffectClass::Jump:
    return I->Imm == BadTarget ? Kind::Other : Kind::Jump;
  case EffectClass::IndirectJump:
    return Kind::Indirect;
  case EffectClass::CsrRegister:
  case EffectClass::CsrImmediate:
    return readsLanes(I) ? Kind::Integer : Kind::Other;
  case EffectClass::SetMask:
  case EffectClass::Trap:
    return Kind::Other;
  }
  __builtin_unreachable();
}

/// Whether the instruction behind it is not reached from it.
bool endsPath(const GuestInsn &G) {
  const EffectClass Class = effectsOf(G.Opcode).Class;
  if (Class == EffectClass::Jump || Class == EffectClass::IndirectJump)
    return isSink(G.I->Rd); // a call comes back
  return Class == EffectClass::Trap;
}

using Found = std::map<const Insn *, GuestInsn>;

/// Where a branch or jump goes, as far as the code says it: a jalr does behind
/// the auipc of its address, as far calls are written. Else nullptr.
const Insn *targetOf(const CodeTable &Code, const GuestInsn &G) {
  if (G.Is == Kind::Branch || G.Is == Kind::Jump)
    return G.I + (G.I->Imm >> 2);
  if (G.Is != Kind::Indirect || G.I == Code.begin())
    return nullptr;
  const Insn *Before = G.I - 1;
  const std::optional<Decoded> D = decode(Before->Word);
  if (!D || D->Opcode != Op::RV_AUIPC || Before->Rd != G.I->Rs1)
    return nullptr;
  const auto To = static_cast<uint32_t>(Before->Imm + G.I->Imm);
  const Insn *Target = Code.find(To);
  return To % 4 == 0 && Target != Code.begin() + Code.count() ? Target
                                                              : nullptr;
}

bool isCall(const GuestInsn &G) {
  return (G.Is == Kind::Jump || G.Is == Kind::Indirect) && !isSink(G.I->Rd);
}

/// Follows the code from Head on.
Found follow(VectorUnit Unit, const CodeTable &Code, const Insn *Head) {
  Found All;
  std::deque<const Insn *> Paths = {Head};
  while (!Paths.empty()) {
    const Insn *I = Paths.front();
    Paths.pop_front();
    for (; I != Code.begin() + Code.count() && !All.contains(I); ++I) {
      if (All.size() == MostInstructions)
        return All;
      const std::optional<Decoded> D = decode(I->Word);
      if (!D)
        break;
      GuestInsn G{I, D->Opcode, kindOf(Unit, D->Opcode, I)};
      if (const Insn *To = targetOf(Code, G))
        Paths.push_back(To);
      All.emplace(I, G);
      if (endsPath(G))
        break;
    }
  }
  return All;
}

void markLeaders(const CodeTable &Code, Found &All) {
  const auto Lead = [&](const Insn *I) {
    if (const auto At = All.find(I); At != All.end())
      At->second.Leads = true;
  };
  for (const auto &[I, G] : All)
    if (const Insn *To = targetOf(Code, G)) {
      Lead(To);
      // A way back is a loop of what lies between.
      if (To <= I && !isCall(G))
        for (auto At = All.lower_bound(To); At != All.end() && At->first <= I;
             ++At)
          ++At->second.Loops;
    }
}

/// Whether enough instructions from \p From on are translated in a row, or
/// they go back.
bool isWorthEntering(const Found &All, const Insn *From) {
  unsigned Count = 0;
  for (auto At = All.find(From);
       At != All.end() && At->first == From + Count &&
       At->second.Is != Kind::Other && Count != WorthEntering;
       ++At, ++Count)
    if ((At->second.Is == Kind::Branch || At->second.Is == Kind::Jump) &&
        At->first->Imm <= 0)
      return true;
  return Count == WorthEntering;
}

/// A loop's body counts as much as this many times the code around it.
constexpr uint64_t LoopWeight = 8;
constexpr unsigned DeepestLoop = 6;

} // namespace

Element elementOf(Op O) {
  switch (O) {
#define LOAD(OP, T)                                                            \
  case Op::OP:                                                                 \
    return {sizeof(T), static_cast<T>(-1) < 0};
#define STORE(OP, T) LOAD(OP, T)
#include "core/insns/memory.def"
  default:
    return {};
  }
}

RegisterUses usesOf(const std::vector<GuestInsn> &Region) {
  RegisterUses Result;
  uint64_t Uses[NumRegisters] = {};
  for (const GuestInsn &G : Region) {
    if (G.Is == Kind::Other)
      continue;
    uint64_t Weight = 1;
    for (unsigned L = 0; L != std::min(G.Loops, DeepestLoop); ++L)
      Weight *= LoopWeight;
    const InsnInfo &Info = InsnTable[static_cast<unsigned>(G.Opcode)];
    if (Info.Rs1 != File::None)
      Uses[numberOf(G.I->Rs1)] += Weight;
    if (G.IsInStacks)
      Uses[numberOf(StackPointer)] += Weight;
    if (Info.Rs2 != File::None)
      Uses[numberOf(G.I->Rs2)] += Weight;
    if (Info.Rs3 != File::None)
      Uses[numberOf(G.I->Rs3)] += Weight;
    if (Info.Rd != File::None) {
      Uses[numberOf(G.I->Rd)] += Weight;
      Result.Written[numberOf(G.I->Rd)] = true;
    }
  }
  Uses[XBase] = 0; // a number
  Uses[SinkRegister] = 0;
  for (unsigned R = 0; R != NumRegisters; ++R)
    if (Uses[R])
      Result.MostUsed.push_back(R);
  std::ranges::sort(Result.MostUsed, [&](unsigned A, unsigned B) {
    return std::pair(Uses[B], A) < std::pair(Uses[A], B);
  });
  return Result;
}

std::vector<GuestInsn> findRegion(VectorUnit Unit, const CodeTable &Code,
                                  const Insn *Head) {
  Found All = follow(Unit, Code, Head);
  markLeaders(Code, All);
  // What is called here may be called from elsewhere.
  std::set<const Insn *> Called;
  for (const auto &[I, G] : All)
    if (const Insn *To = targetOf(Code, G); To && isCall(G))
      Called.insert(To);
  for (auto &[I, G] : All) {
    const auto Before = All.find(I - 1);
    const Kind Last = Before == All.end() ? Kind::Integer : Before->second.Is;
    // Code comes back from calls, and from other modes.
    const bool Returns =
        Last == Kind::Jump || Last == Kind::Indirect || Last == Kind::Lanes;
    G.Leads |= Returns;
    const bool Begins = I == Head || (G.Leads && G.Loops != 0) || Returns ||
                        Last == Kind::Other || Called.contains(I);
    if (Begins && G.Is != Kind::Other && isWorthEntering(All, I))
      G.Leads = G.Enters = true;
  }
  std::vector<GuestInsn> Result;
  bool Enters = false;
  for (const auto &[I, G] : All) {
    Result.push_back(G);
    Enters |= G.Enters;
  }
  if (!Enters)
    Result.clear();
  return Result;
}

} // namespace vorion::isasim::translate
