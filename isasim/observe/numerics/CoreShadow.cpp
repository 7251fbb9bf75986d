#include "observe/numerics/CoreShadow.h"

#include "observe/numerics/ShadowMath.h"
#include "vorion/isasim/Machine.h"

#include <cstring>

namespace vorion::isasim {

namespace {

/// Sums below this part of their larger operand are nothing but the shadow's
/// own rounding (2^-52), some operations old.
constexpr double ResidueShare = 0x1p-40;
/// Below it fp32 has no normal numbers.
constexpr double SmallestNormal = 0x1p-126;

} // namespace

/// What a rounded operation gives in the shadow.
struct CoreShadow::Outcome {
  unsigned Operands = 0;
  LaneDoubles In[3]; ///< of the operands
  LaneDoubles Result;
  LaneDoubles Largest; ///< magnitude of a sum's operands, else 0
  LaneFloats InError;  ///< the largest of the operands
};

void CoreShadow::runBegins(const RunStart &R) { begin(R.Shape, R.Program); }

void CoreShadow::begin(const Config &Shape,
                       const std::shared_ptr<const Image> &Program) {
  WarpsPerCore = Shape.WarpsPerCore;
  HighGlobal = globalRanges(Shape)[1];
  Warps.assign(size_t{Shape.cores()} * WarpsPerCore, Warp());
  Memory.begin(Shape.cores());
  Sites.useProgram(Program);
}

void CoreShadow::take(const Step &S, Warp &W, unsigned N, int Register) {
  Operand &To = W.In[N];
  if (Register < 0) { // x0
    To.Words = LaneWords{};
    To.Followed = To.DifferingLanes = 0;
    return;
  }
  const auto R = static_cast<unsigned>(Register);
  To.Words = S.State.Registers[R];
  To.Followed = W.Followed[R];
  if (To.Followed)
    To.Shadow = W.Shadow[R];
  To.DifferingLanes = R < FBase ? W.DifferingLanes[R] : 0;
  if (To.DifferingLanes)
    To.ShadowValues = W.ShadowValues[R];
}

void CoreShadow::setShadow(Warp &W, int Register, uint32_t Lanes,
                           const Values &V) {
  if (Register < 0)
    return;
  const auto R = static_cast<unsigned>(Register);
  const LaneWords Words = wordsOf(Lanes);
  mergeLanes(W.Shadow[R].Value, V.Value, Words);
  mergeLanes(W.Shadow[R].Error, V.Error, Words);
  mergeLanes(W.Shadow[R].From, V.From, Words);
  W.Followed[R] |= Lanes;
}

void CoreShadow::drop(Warp &W, int Register, uint32_t Lanes) {
  if (Register < 0)
    return;
  const auto R = static_cast<unsigned>(Register);
  W.Followed[R] &= ~Lanes;
  if (R < FBase)
    W.DifferingLanes[R] &= ~Lanes;
}

void CoreShadow::fetch(const Step &S) {
  Warp &W = warpOf(S);
  const Decoded &D = S.Insn;
  const InsnInfo &Info = D.info();
  const NumericKind Kind = numericKind(D.Opcode);
  const int A = shadowPlace(Info.Rs1, D.Rs1), B = shadowPlace(Info.Rs2, D.Rs2);
  W.Waits = true;
  switch (Kind) {
  case NumericKind::Other:
  case NumericKind::Load:
  case NumericKind::Store:
    return;
  case NumericKind::Integer:
  case NumericKind::Decide: {
    uint32_t Known = 0;
    for (const int R : {A, B})
      if (R >= 0)
        Known |= W.Followed[static_cast<unsigned>(R)] |
                 W.DifferingLanes[static_cast<unsigned>(R)];
    W.Waits = (Known & S.LaneMask) != 0;
    if (!W.Waits)
      return;
    break;
  }
  default:
    break;
  }
  take(S, W, 0, A);
  take(S, W, 1, B);
  if (Kind == NumericKind::Atomic) // what amocas.w compares with
    take(S, W, 2, shadowPlace(Info.Rd, D.Rd));
  else if (Info.Rs3 != File::None)
    take(S, W, 2, shadowPlace(Info.Rs3, D.Rs3));
  if (Info.Rs2 == File::None)
    W.In[1].Words += static_cast<uint32_t>(D.Imm);
  if (Kind == NumericKind::Decide)
    decide(S, W);
}

void CoreShadow::commit(const Commit &C) {
  Warp &W = warpOf(C);
  const Decoded &D = C.Insn;
  const int Rd = shadowPlace(D.info().Rd, D.Rd);
  switch (numericKind(D.Opcode)) {
  case NumericKind::Float:
  case NumericKind::FromInt:
    return commitFloat(C, W);
  case NumericKind::Sign:
    return commitSign(C, W);
  case NumericKind::MinMax:
    return commitMinMax(C, W);
  case NumericKind::MoveBits:
    drop(W, Rd, C.LaneMask);
    return setShadow(W, Rd, W.In[0].Followed & C.LaneMask, W.In[0].Shadow);
  case NumericKind::Compare:
    return commitCompare(C, W);
  case NumericKind::ToInt:
    return commitToInt(C, W);
  case NumericKind::Integer:
    drop(W, Rd, C.LaneMask);
    if (W.Waits && Rd >= 0)
      commitInteger(C, W);
    return;
  case NumericKind::Shuffle:
    return commitShuffle(C, W);
  case NumericKind::Load:
    return commitLoad(C, W);
  case NumericKind::Store:
    return commitStore(C, W);
  case NumericKind::Atomic:
    return commitAtomic(C, W);
  case NumericKind::Decide:
  case NumericKind::Other:
    return drop(W, Rd, C.LaneMask);
  }
}

/// Adding one of these to what is small rounds it to a whole number: what the
/// shadow would keep of it was not meant to stay.
static uint32_t roundsToWhole(const LaneWords &Addend, const LaneWords &Sum) {
  uint32_t Lanes = 0;
  for (unsigned L = 0; L != MaxLanes; ++L) {
    const uint32_t Word = Addend[L] & ~SignBit;
    const bool IsShift =
        Word == 0x4B400000U /* 1.5 * 2^23 */ || Word == 0x4B000000U /* 2^23 */;
    Lanes |=
        static_cast<uint32_t>(IsShift && (Sum[L] & InfinityBits) == 0x4B000000U)
        << L;
  }
  return Lanes;
}

void CoreShadow::commitFloat(const Commit &C, Warp &W) {
  const OwnRounding Own;
  const InsnInfo &Info = C.Insn.info();
  Outcome Out;
  Out.InError = LaneFloats{};
  const bool FromInt = Info.Rs1 == File::X;
  Out.Operands = Info.Rs3 != File::None ? 3 : Info.Rs2 != File::None ? 2 : 1;
  for (unsigned N = 0; N != Out.Operands; ++N) {
    const Operand &From = W.In[N];
    toDouble(From.Words, Out.In[N]);
    if (FromInt) {
      const bool Signed = C.Insn.Opcode == Op::RV_FCVT_S_W;
      for (unsigned L = 0; L != MaxLanes; ++L) {
        const bool Other = (From.DifferingLanes >> L & 1) != 0;
        const uint32_t Word = Other ? From.ShadowValues[L] : From.Words[L];
        Out.In[N][L] = Signed ? static_cast<double>(static_cast<int32_t>(Word))
                              : static_cast<double>(Word);
        Out.InError[L] = Other ? 1 : 0;
      }
    } else if (From.Followed) {
      const LaneWords Lanes = wordsOf(From.Followed);
      mergeLanes(Out.In[N], From.Shadow.Value, Lanes);
      for (unsigned L = 0; L != MaxLanes; ++L)
        if (Lanes[L] && From.Shadow.Error[L] > Out.InError[L])
          Out.InError[L] = From.Shadow.Error[L];
    }
  }
  if (FromInt) {
    Out.Result = Out.In[0];
    Out.Largest = LaneDoubles{};
  } else {
    floatInDouble(C.Insn.Opcode, {Out.In[0], Out.In[1], Out.In[2]}, Out.Result,
                  Out.Largest);
  }
  judge(C, W, Out);
}

void CoreShadow::judge(const Commit &C, Warp &W, const Outcome &Out) {
  LaneWords Words;
  std::memcpy(&Words, C.Result.data(), sizeof(Words));
  LaneDoubles Is, Error;
  toDouble(Words, Is);
  relativeErrors(Is, Out.Result, Error);

  uint32_t Whole = 0;
  if (C.Insn.info().Rs3 != File::None)
    Whole = roundsToWhole(W.In[2].Words, Words) & ~W.In[2].Followed;
  else if (C.Insn.Opcode == Op::RV_FADD_S || C.Insn.Opcode == Op::RV_FSUB_S)
    Whole = (roundsToWhole(W.In[0].Words, Words) & ~W.In[0].Followed) |
            (roundsToWhole(W.In[1].Words, Words) & ~W.In[1].Followed);

  const uint32_t Number = Sites.number(C.Pc);
  NumericCounts &Counts = Sites.at(Number).Counts;
  Values Result{Out.Result, {}, LaneWords{} + Origin::site(Number).word()};
  uint32_t Special = 0;
  forLanes(C.LaneMask, [&](unsigned L) {
    const uint32_t Exponent = Words[L] & InfinityBits;
    if ((Whole >> L & 1) != 0) {
      Result.Value[L] = Is[L];
      Error[L] = 0;
    }
    Result.Error[L] = static_cast<float>(Error[L]);
    if (Exponent == InfinityBits) {
      Special |= 1U << L;
      return;
    }
    ++Counts.Results;
    if (Error[L] > Limits.Relative || Exponent == 0)
      Special |= 1U << L;
    else
      Counts.add(Error[L]);
  });
  forLanes(Special, [&](unsigned L) { judgeLane(C, W, Out, L, Result); });
  setShadow(W, shadowPlace(File::F, C.Insn.Rd), C.LaneMask, Result);
}

NumericSample CoreShadow::sample(const Commit &C, const Warp &W,
                                 const Outcome &Out, unsigned Lane) const {
  NumericSample S{
      C.Core, C.Warp, Lane, Out.Operands, C.Insn.info().Rs1 == File::X, {}, {},
      {},     0,      0};
  for (unsigned N = 0; N != Out.Operands; ++N) {
    S.Words[N] = W.In[N].Words[Lane];
    S.Shadows[N] = Out.In[N][Lane];
    if (W.In[N].Followed >> Lane & 1)
      S.From[N] = Origin::fromWord(W.In[N].Shadow.From[Lane]);
  }
  S.Result = C.Result[Lane];
  S.Shadow = Out.Result[Lane];
  return S;
}

/// A result that is not finite, not normal, or above the limit.
void CoreShadow::judgeLane(const Commit &C, const Warp &W, const Outcome &Out,
                           unsigned L, Values &Result) {
  const uint32_t Number = Sites.number(C.Pc);
  const uint32_t Word = C.Result[L];
  NumericCounts &Counts = Sites.at(Number).Counts;
  if (!isFinite(Word))
    return judgeNotFinite(C, W, Out, L, Result);
  const double Shadow = Out.Result[L];
  const bool IsZero = (Word & ~SignBit) == 0;
  if ((Word & InfinityBits) == 0 && !IsZero)
    ++Counts.Subnormal;
  if (IsZero && Shadow != 0 && std::fabs(Shadow) < SmallestNormal)
    ++Counts.Flushed;
  const double Error = Result.Error[L];
  if (!std::isfinite(Shadow))
    Result.Value[L] = std::bit_cast<float>(Word);
  if (!(Error > Limits.Relative))
    return Counts.add(Error);
  const double Largest = Out.Largest[L];
  const bool IsResidue =
      Largest > 0 && std::fabs(Shadow) <= ResidueShare * Largest;
  Counts.Residues += IsResidue;
  if (IsResidue || usesResidue(W, Out, L)) {
    Result.From[L] |= Origin::ResidueBit;
    return;
  }
  Counts.add(Error);
  const double Is = std::fabs(std::bit_cast<float>(Word));
  if (Largest > 0 &&
      Largest >= std::ldexp(Is, static_cast<int>(Limits.CancelBits)))
    ++Counts.Cancelled;
  if (Out.InError[L] > Limits.Relative) {
    ++Counts.Inherited;
    Result.From[L] = worstOrigin(C, W, Out, L);
    return;
  }
  ++Counts.Born;
  Site &S = Sites.at(Number);
  if (Error > S.WorstBorn) {
    S.WorstBorn = Error;
    S.Worst = sample(C, W, Out, L);
  }
}

/// The origin of the operand that is off by most.
uint32_t CoreShadow::worstOrigin(const Commit &C, const Warp &W,
                                 const Outcome &Out, unsigned L) const {
  float Worst = 0;
  uint32_t From = Origin::site(Sites.number(C.Pc)).word();
  for (unsigned N = 0; N != Out.Operands; ++N)
    if ((W.In[N].Followed >> L & 1) != 0 && W.In[N].Shadow.Error[L] > Worst) {
      Worst = W.In[N].Shadow.Error[L];
      From = W.In[N].Shadow.From[L];
    }
  return From;
}

/// Whether an operand is off because it is or comes from a residue.
bool CoreShadow::usesResidue(const Warp &W, const Outcome &Out,
                             unsigned L) const {
  for (unsigned N = 0; N != Out.Operands; ++N)
    if ((W.In[N].Followed >> L & 1) != 0 &&
        (W.In[N].Shadow.From[L] & Origin::ResidueBit) != 0)
      return true;
  return false;
}

void CoreShadow::judgeNotFinite(const Commit &C, const Warp &W,
                                const Outcome &Out, unsigned L,
                                Values &Result) {
  const uint32_t Number = Sites.number(C.Pc);
  Result.Error[L] = 1;
  // Where the operands have it from, if one has it.
  const bool ResultIsNan = isNan(C.Result[L]);
  bool Made = true;
  Origin From;
  for (unsigned N = 0; N != Out.Operands && C.Insn.info().Rs1 == File::F; ++N) {
    const uint32_t Word = W.In[N].Words[L];
    if (isFinite(Word) || (ResultIsNan && !isNan(Word)))
      continue;
    Made = false;
    if ((W.In[N].Followed >> L & 1) != 0 && !From.isEvent())
      From = Origin::fromWord(W.In[N].Shadow.From[L]);
  }
  if (Made)
    ++Sites.at(Number).Counts.NotFinite;
  // One that came out of memory as it is begins its chain here.
  if (Made || !From.isEvent())
    From = Origin::event(Sites.event(Number, sample(C, W, Out, L)));
  Result.From[L] = From.word();
}

} // namespace vorion::isasim
