// What the numeric sanitizer does with everything that does not round: moves,
// selections, memory, and decisions.
#include "observe/numerics/CoreShadow.h"

namespace vorion::isasim {

namespace {

/// Results that are one of the operands, or an operand with another sign or
/// exponent, as the tricks of libraries have them.
bool movesBits(Op O) {
  switch (O) {
  case Op::RV_ADD:
  case Op::RV_ADDI:
  case Op::RV_SUB:
  case Op::RV_XOR:
  case Op::RV_XORI:
  case Op::RV_OR:
  case Op::RV_ORI:
  case Op::RV_AND:
  case Op::RV_ANDI:
  case Op::RV_ANDN:
  case Op::RV_ORN:
  case Op::RV_CZERO_EQZ:
  case Op::RV_CZERO_NEZ:
  case Op::RV_MIN:
  case Op::RV_MINU:
  case Op::RV_MAX:
  case Op::RV_MAXU:
  case Op::RV_BCLRI:
  case Op::RV_BSETI:
  case Op::RV_BINVI:
    return true;
  default:
    return false;
  }
}

int exponentOf(uint32_t Word) { return static_cast<int>(Word >> 23 & 0xFF); }

/// Whether \p To is the float \p From with another sign or exponent; \p Value
/// is then changed alike.
bool changeLike(uint32_t From, uint32_t To, double &Value) {
  if (From == To)
    return true;
  const int Before = exponentOf(From), After = exponentOf(To);
  constexpr uint32_t Fraction = 0x7FFFFF;
  const bool IsNormal =
      Before != 0 && Before != 0xFF && After != 0 && After != 0xFF;
  const uint32_t Changed = From ^ To;
  if ((Changed & Fraction) != 0 || (Before != After && !IsNormal) ||
      // Both at once is no trick that is known.
      (Before != After && (Changed & SignBit) != 0))
    return false;
  Value = std::ldexp(Changed & SignBit ? -Value : Value, After - Before);
  return true;
}

/// Within the core's local memory, where a warp has a part of it.
uint32_t addressOf(const Step &S, unsigned Lane) {
  const uint32_t Address = S.Access->Addresses[Lane];
  return Address < VX_LOCAL_BASE ? Address : Address + S.State.LocalOffset;
}

} // namespace

void CoreShadow::reach(const Operand &From, unsigned L) {
  if ((From.Followed >> L & 1) != 0 && From.Shadow.Error[L] > Limits.Relative &&
      (From.Shadow.From[L] & Origin::ResidueBit) == 0)
    Sites.reach(Origin::fromWord(From.Shadow.From[L]));
}

void CoreShadow::setShadowValues(const Commit &C, Warp &W,
                                 const LaneWords &ShadowValues,
                                 bool IsDecision) {
  const int Rd = shadowPlace(File::X, C.Insn.Rd);
  uint32_t Lanes = 0;
  forLanes(C.LaneMask, [&](unsigned L) {
    Lanes |= static_cast<uint32_t>(Rd >= 0 && ShadowValues[L] != C.Result[L])
             << L;
  });
  if (Lanes == 0)
    return;
  if (IsDecision) {
    Sites.at(Sites.number(C.Pc)).Counts.Decisions +=
        static_cast<unsigned>(std::popcount(Lanes));
    forLanes(Lanes, [&](unsigned L) {
      for (const Operand *From : {&W.In[0], &W.In[1]})
        reach(*From, L);
    });
  }
  const auto R = static_cast<unsigned>(Rd);
  mergeLanes(W.ShadowValues[R], ShadowValues, wordsOf(Lanes));
  W.DifferingLanes[R] |= Lanes;
}

void CoreShadow::decide(const Step &S, Warp &W) {
  const Operand &A = W.In[0], &B = W.In[1];
  if (((A.DifferingLanes | B.DifferingLanes) & S.LaneMask) == 0)
    return;
  // The branch behind a split decides the same once more, for the warp.
  const bool IsBranch = S.Insn.info().Fmt == Format::B;
  if (IsBranch && W.SplitEnd == S.Pc)
    return;
  if (!IsBranch)
    W.SplitEnd = S.Pc + 4;
  LaneWords OtherA = A.Words, OtherB = B.Words;
  mergeLanes(OtherA, A.ShadowValues, wordsOf(A.DifferingLanes));
  mergeLanes(OtherB, B.ShadowValues, wordsOf(B.DifferingLanes));
  const uint32_t Flipped = (decidedLanes(S.Insn.Opcode, A.Words, B.Words) ^
                            decidedLanes(S.Insn.Opcode, OtherA, OtherB)) &
                           S.LaneMask;
  Sites.at(Sites.number(S.Pc)).Counts.Branches +=
      static_cast<unsigned>(std::popcount(Flipped));
}

void CoreShadow::commitSign(const Commit &C, Warp &W) {
  const Operand &A = W.In[0], &B = W.In[1];
  const int Rd = shadowPlace(File::F, C.Insn.Rd);
  drop(W, Rd, C.LaneMask);
  const uint32_t Lanes = A.Followed & C.LaneMask;
  if (Lanes == 0)
    return;
  if (C.Insn.Opcode == Op::RV_FSGNJ_S && C.Insn.Rs1 == C.Insn.Rs2)
    return setShadow(W, Rd, Lanes, A.Shadow); // fmv.s
  Values V = A.Shadow;
  forLanes(Lanes, [&](unsigned L) {
    const double Own = A.Shadow.Value[L];
    const double Other = (B.Followed >> L & 1) != 0
                             ? B.Shadow.Value[L]
                             : std::bit_cast<float>(B.Words[L]);
    const bool Negative =
        C.Insn.Opcode == Op::RV_FSGNJX_S
            ? std::signbit(Own) != std::signbit(Other)
            : std::signbit(Other) != (C.Insn.Opcode == Op::RV_FSGNJN_S);
    V.Value[L] = std::copysign(Own, Negative ? -1.0 : 1.0);
  });
  setShadow(W, Rd, Lanes, V);
}

void CoreShadow::commitMinMax(const Commit &C, Warp &W) {
  const Operand &A = W.In[0], &B = W.In[1];
  const int Rd = shadowPlace(File::F, C.Insn.Rd);
  drop(W, Rd, C.LaneMask);
  const uint32_t Lanes = (A.Followed | B.Followed) & C.LaneMask;
  if (Lanes == 0)
    return;
  const OwnRounding Own;
  Values V{};
  uint32_t Known = 0;
  forLanes(Lanes, [&](unsigned L) {
    const auto Of = [L](const Operand &From) {
      return (From.Followed >> L & 1) != 0
                 ? From.Shadow.Value[L]
                 : std::bit_cast<float>(From.Words[L]);
    };
    const double X = Of(A), Y = Of(B);
    const double Best =
        C.Insn.Opcode == Op::RV_FMIN_S ? std::fmin(X, Y) : std::fmax(X, Y);
    const Operand &Chosen = Best == X ? A : B;
    const double Error = relativeError(std::bit_cast<float>(C.Result[L]), Best);
    // What is exact has no shadow.
    if ((Chosen.Followed >> L & 1) == 0 && Error == 0)
      return;
    V.Value[L] = Best;
    V.From[L] = (Chosen.Followed >> L & 1) != 0
                    ? Chosen.Shadow.From[L]
                    : Origin::site(Sites.number(C.Pc)).word();
    V.Error[L] = static_cast<float>(Error);
    Known |= 1U << L;
  });
  setShadow(W, Rd, Known, V);
}

void CoreShadow::commitCompare(const Commit &C, Warp &W) {
  const Operand &A = W.In[0], &B = W.In[1];
  drop(W, shadowPlace(File::X, C.Insn.Rd), C.LaneMask);
  if (((A.Followed | B.Followed) & C.LaneMask) == 0)
    return;
  const OwnRounding Own;
  LaneDoubles X, Y;
  toDouble(A.Words, X);
  toDouble(B.Words, Y);
  mergeLanes(X, A.Shadow.Value, wordsOf(A.Followed));
  mergeLanes(Y, B.Shadow.Value, wordsOf(B.Followed));
  setShadowValues(C, W, wordsOf(compareInDouble(C.Insn.Opcode, X, Y)) & 1U,
                  true);
}

void CoreShadow::commitToInt(const Commit &C, Warp &W) {
  const Operand &A = W.In[0];
  drop(W, shadowPlace(File::X, C.Insn.Rd), C.LaneMask);
  if (C.Result.empty() || (A.Followed & C.LaneMask) == 0)
    return;
  const OwnRounding Own;
  LaneWords ShadowValues{};
  const unsigned Rm = C.Insn.Rm == DynamicRm ? C.State.Frm : C.Insn.Rm;
  forLanes(C.LaneMask, [&](unsigned L) {
    ShadowValues[L] = (A.Followed >> L & 1) != 0
                          ? doubleToInt(A.Shadow.Value[L],
                                        C.Insn.Opcode == Op::RV_FCVT_W_S, Rm)
                          : C.Result[L];
  });
  setShadowValues(C, W, ShadowValues, true);
}

/// Needs that an operand is followed or differs in an active lane.
void CoreShadow::commitInteger(const Commit &C, Warp &W) {
  const Operand &A = W.In[0], &B = W.In[1];
  const int Rd = shadowPlace(File::X, C.Insn.Rd);
  if (((A.DifferingLanes | B.DifferingLanes) & C.LaneMask) != 0) {
    LaneWords OtherA = A.Words, OtherB = B.Words, ShadowValues;
    mergeLanes(OtherA, A.ShadowValues, wordsOf(A.DifferingLanes));
    mergeLanes(OtherB, B.ShadowValues, wordsOf(B.DifferingLanes));
    integerResult(C.Insn.Opcode, OtherA, OtherB, ShadowValues);
    setShadowValues(C, W, ShadowValues,
                    C.Insn.Opcode == Op::RV_CZERO_EQZ ||
                        C.Insn.Opcode == Op::RV_CZERO_NEZ);
  }
  if (!movesBits(C.Insn.Opcode))
    return;
  Values V{};
  uint32_t Lanes = 0;
  forLanes((A.Followed | B.Followed) & C.LaneMask, [&](unsigned L) {
    for (const Operand *From : {&A, &B}) {
      if ((From->Followed >> L & 1) == 0)
        continue;
      double Value = From->Shadow.Value[L];
      if (!changeLike(From->Words[L], C.Result[L], Value))
        continue;
      V.Value[L] = Value;
      V.Error[L] = From->Shadow.Error[L];
      V.From[L] = From->Shadow.From[L];
      Lanes |= 1U << L;
      return;
    }
  });
  setShadow(W, Rd, Lanes, V);
}

void CoreShadow::commitShuffle(const Commit &C, Warp &W) {
  const Operand &A = W.In[0], &Control = W.In[1];
  const int Rd = shadowPlace(File::X, C.Insn.Rd);
  drop(W, Rd, C.LaneMask);
  if (C.Result.empty() || A.Followed == 0)
    return;
  Values V{};
  uint32_t Lanes = 0;
  forLanes(C.LaneMask, [&](unsigned L) {
    unsigned From = shuffleSource(C.Insn.Opcode, L, Control.Words[L]);
    // Outside of the segment a lane keeps its own.
    if (From >= MaxLanes || (C.LaneMask >> From & 1) == 0 ||
        A.Words[From] != C.Result[L])
      From = L;
    if ((A.Followed >> From & 1) == 0)
      return;
    V.Value[L] = A.Shadow.Value[From];
    V.Error[L] = A.Shadow.Error[From];
    V.From[L] = A.Shadow.From[From];
    Lanes |= 1U << L;
  });
  setShadow(W, Rd, Lanes, V);
}

bool CoreShadow::loadLane(const Commit &C, unsigned L, uint32_t Address,
                          Values &To) {
  const ShadowMemory::Word *Found = Memory.find(C.Core, Address, C.Result[L]);
  if (!Found)
    return false;
  To.Value[L] = Found->Value;
  To.From[L] = Found->From;
  To.Error[L] = static_cast<float>(
      relativeError(std::bit_cast<float>(C.Result[L]), Found->Value));
  return true;
}

void CoreShadow::commitLoad(const Commit &C, Warp &W) {
  const int Rd = shadowPlace(C.Insn.info().Rd, C.Insn.Rd);
  drop(W, Rd, C.LaneMask);
  if (Rd < 0 || C.Access->Bytes != 4)
    return;
  const OwnRounding Own;
  Values V{};
  uint32_t Lanes = 0;
  forLanes(C.LaneMask, [&](unsigned L) {
    Lanes |= static_cast<uint32_t>(loadLane(C, L, addressOf(C, L), V)) << L;
  });
  if (Lanes)
    setShadow(W, Rd, Lanes, V);
}

void CoreShadow::storeLane(const Commit &C, unsigned L, const Operand &From) {
  if ((From.Followed >> L & 1) != 0)
    Memory.set(C.Core, addressOf(C, L),
               {From.Shadow.Value[L], From.Words[L], From.Shadow.From[L]});
  else
    Memory.drop(C.Core, addressOf(C, L), C.Access->Bytes);
}

void CoreShadow::commitStore(const Commit &C, Warp &W) {
  // Stores leave the registers as they are.
  Operand &From = W.In[0];
  take(C, W, 0, shadowPlace(C.Insn.info().Rs2, C.Insn.Rs2));
  if (C.Access->Bytes != 4)
    From.Followed = 0;
  forLanes(C.LaneMask, [&](unsigned L) {
    storeLane(C, L, From);
    // The image, stacks and local memory are the program's own.
    const uint32_t Address = addressOf(C, L);
    if (Address < VX_IMAGE_BASE || Address - HighGlobal.Base < HighGlobal.Bytes)
      reach(From, L);
  });
}

void CoreShadow::commitAtomic(const Commit &C, Warp &W) {
  const Operand &Value = W.In[1], &Compare = W.In[2];
  const int Rd = shadowPlace(File::X, C.Insn.Rd);
  drop(W, Rd, C.LaneMask);
  if (C.Insn.info().Pairs) { // 64 bits are no fp32 value
    if (Rd >= 0)
      drop(W, Rd + 1, C.LaneMask);
    return forLanes(C.LaneMask, [&](unsigned L) {
      Memory.drop(C.Core, addressOf(C, L), C.Access->Bytes);
    });
  }
  const OwnRounding Own;
  Values V{};
  uint32_t Lanes = 0;
  const Op O = C.Insn.Opcode;
  // In lane order, as it executes.
  forLanes(C.LaneMask, [&](unsigned L) {
    const uint32_t Address = addressOf(C, L);
    if (Rd >= 0)
      Lanes |= static_cast<uint32_t>(loadLane(C, L, Address, V)) << L;
    if (O == Op::RV_AMOCAS_W && (Rd < 0 || C.Result[L] != Compare.Words[L]))
      return Rd < 0 ? Memory.drop(C.Core, Address, 4) : void();
    if (O == Op::RV_AMOSWAP_W || O == Op::RV_AMOCAS_W)
      storeLane(C, L, Value);
    else
      Memory.drop(C.Core, Address, 4);
  });
  if (Lanes)
    setShadow(W, Rd, Lanes, V);
}

} // namespace vorion::isasim
