#include "observe/numerics/ShadowMath.h"

// The lists of instructions are written for these.
#define VORION_LEVEL shadow
#include "core/Level.h"

#include <array>

namespace vorion::isasim {

namespace shadow {

namespace {

using D = LaneDoubles;
using I64 = int64_t __attribute__((vector_size(8 * MaxLanes)));

VORION_INLINE D pick(I64 Condition, D Then, D Else) {
  return (D)(((I64)Then & Condition) | ((I64)Else & ~Condition));
}
VORION_INLINE D magnitude(D V) {
  return (D)((I64)V & std::numeric_limits<int64_t>::max());
}
VORION_INLINE D larger(D A, D B) {
  A = magnitude(A);
  B = magnitude(B);
  return pick(A > B, A, B);
}
VORION_INLINE D squareRoot(D A) { return __builtin_elementwise_sqrt(A); }
VORION_INLINE D fma(D A, D B, D C) {
  return __builtin_elementwise_fma(A, B, C);
}
VORION_INLINE uint32_t bitsOf(I64 Condition) {
  return __builtin_bit_cast(uint16_t,
                            __builtin_convertvector(Condition, LaneBools));
}

} // namespace

} // namespace shadow

using namespace shadow;

static std::array<NumericKind, NumOps> makeKinds() {
  std::array<NumericKind, NumOps> Kinds{};
  const auto Set = [&](Op O, NumericKind K) {
    Kinds[static_cast<unsigned>(O)] = K;
  };
#define INT(OP, RESULT) Set(Op::OP, NumericKind::Integer);
#include "core/insns/integer.def"
#define FLOAT(OP, SOFT, RESULT) Set(Op::OP, NumericKind::Float);
#define FUSED(OP, SOFT, FACTOR, ADDEND) Set(Op::OP, NumericKind::Float);
#define COMPARE(OP, CONDITION, QUIET) Set(Op::OP, NumericKind::Compare);
#define MINMAX(OP, IS_MIN) Set(Op::OP, NumericKind::MinMax);
#define TOINT(OP, SIGNED, SOFT) Set(Op::OP, NumericKind::ToInt);
#define FROMINT(OP, SIGNED, SOFT) Set(Op::OP, NumericKind::FromInt);
#include "core/insns/float.def"
#define LOAD(OP, T) Set(Op::OP, NumericKind::Load);
#define STORE(OP, T) Set(Op::OP, NumericKind::Store);
#define AMO(OP, KIND) Set(Op::OP, NumericKind::Atomic);
#include "core/insns/memory.def"
#define BRANCH(OP, CONDITION) Set(Op::OP, NumericKind::Decide);
#include "core/insns/branch.def"
  for (const Op O :
       {Op::VX_SPLIT, Op::VX_SPLIT_N, Op::VX_PRED, Op::VX_PRED_N,
        Op::VX_VOTE_ALL, Op::VX_VOTE_ANY, Op::VX_VOTE_UNI, Op::VX_VOTE_BALLOT})
    Set(O, NumericKind::Decide);
  for (const Op O :
       {Op::VX_SHFL_UP, Op::VX_SHFL_DOWN, Op::VX_SHFL_BFLY, Op::VX_SHFL_IDX})
    Set(O, NumericKind::Shuffle);
  // These stand among the integer operations, since they are ones on bits.
  for (const Op O : {Op::RV_FMV_X_W, Op::RV_FMV_W_X})
    Set(O, NumericKind::MoveBits);
  for (const Op O : {Op::RV_FSGNJ_S, Op::RV_FSGNJN_S, Op::RV_FSGNJX_S})
    Set(O, NumericKind::Sign);
  Set(Op::RV_FCLASS_S, NumericKind::Other);
  return Kinds;
}

NumericKind numericKind(Op O) {
  static const std::array<NumericKind, NumOps> Kinds = makeKinds();
  return Kinds[static_cast<unsigned>(O)];
}

void floatInDouble(Op O, const DoubleOperands &In, D &Result, D &Largest) {
  const D &A = In.A, &B = In.B, &C = In.C;
  Largest = D{};
  switch (O) {
#define FLOAT(OP, SOFT, RESULT)                                                \
  case Op::OP:                                                                 \
    Result = RESULT;                                                           \
    if (Op::OP == Op::RV_FADD_S || Op::OP == Op::RV_FSUB_S)                    \
      Largest = larger(A, B);                                                  \
    return;
#define FUSED(OP, SOFT, FACTOR, ADDEND)                                        \
  case Op::OP:                                                                 \
    Result = fma(FACTOR, B, ADDEND);                                           \
    Largest = larger(A * B, C);                                                \
    return;
#include "core/insns/float.def"
  default:
    Result = D{};
  }
}

uint32_t compareInDouble(Op O, const D &A, const D &B) {
  switch (O) {
#define COMPARE(OP, CONDITION, QUIET)                                          \
  case Op::OP:                                                                 \
    return bitsOf(CONDITION);
#include "core/insns/float.def"
  default:
    return 0;
  }
}

void integerResult(Op O, const LaneWords &A, const LaneWords &B, LaneWords &R) {
  switch (O) {
#define INT(OP, RESULT)                                                        \
  case Op::OP:                                                                 \
    R = RESULT;                                                                \
    return;
#include "core/insns/integer.def"
  default:
    R = LaneWords{};
  }
}

uint32_t decidedLanes(Op O, const LaneWords &A, const LaneWords &B) {
  switch (O) {
#define BRANCH(OP, CONDITION)                                                  \
  case Op::OP:                                                                 \
    return laneBits(CONDITION);
#include "core/insns/branch.def"
  case Op::VX_SPLIT:
  case Op::VX_SPLIT_N:
  case Op::VX_PRED:
  case Op::VX_PRED_N:
    return laneBits((A & 1U) != splat(0));
  default:
    return laneBits(A != splat(0));
  }
}

unsigned shuffleSource(Op O, unsigned Lane, uint32_t Control) {
  const uint32_t B = Control & 63, Segment = Control >> 12 & 63;
  switch (O) {
  case Op::VX_SHFL_UP:
    return Lane - B;
  case Op::VX_SHFL_DOWN:
    return Lane + B;
  case Op::VX_SHFL_BFLY:
    return Lane ^ B;
  default:
    return (Lane & Segment) | (B & ~Segment);
  }
}

uint32_t doubleToInt(double V, bool Signed, unsigned Rm) {
  switch (static_cast<RoundingMode>(Rm)) {
  case Rne:
    V = std::nearbyint(V);
    break;
  case Rtz:
    V = std::trunc(V);
    break;
  case Rdn:
    V = std::floor(V);
    break;
  case Rup:
    V = std::ceil(V);
    break;
  case Rmm:
    V = std::round(V);
    break;
  }
  const double Low = Signed ? -0x1p31 : 0, High = Signed ? 0x1p31 : 0x1p32;
  if (!(V < High)) // NaN too
    return static_cast<uint32_t>(static_cast<int64_t>(High - 1));
  return static_cast<uint32_t>(static_cast<int64_t>(V < Low ? Low : V));
}

void toDouble(const LaneWords &FloatBits, D &To) {
  To = __builtin_convertvector(asF(FloatBits), D);
}

LaneWords wordsOf(uint32_t Mask) {
  return asU((splat(Mask) & (1U << iota())) != splat(0));
}

void relativeErrors(const D &Is, const D &Should, D &Error) {
  const D Off = magnitude(Is - Should);
  const D Ratio = Off / magnitude(Should);
  const D AtMost1 = pick(Ratio < 1.0, Ratio, D{} + 1.0); // NaN too
  Error = pick(Off == 0.0, D{}, AtMost1);
}

} // namespace vorion::isasim
