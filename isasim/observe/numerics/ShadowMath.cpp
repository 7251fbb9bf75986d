#include "observe/numerics/ShadowMath.h"

#include "core/Effects.h"

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

/// What an operation of each lane's own operands is.
static NumericKind ofOwnOperands(Op O) {
  switch (O) {
  // These stand among the integer operations, since they are ones on bits.
  case Op::RV_FMV_X_W:
  case Op::RV_FMV_W_X:
    return NumericKind::MoveBits;
  case Op::RV_FSGNJ_S:
  case Op::RV_FSGNJN_S:
  case Op::RV_FSGNJX_S:
    return NumericKind::Sign;
  case Op::RV_FCLASS_S:
    return NumericKind::Other;
  default:
    break;
  }
  switch (O) {
#define INT(OP, RESULT) case Op::OP:
#include "core/insns/integer.def"
    return NumericKind::Integer;
#define FLOAT(OP, SOFT, RESULT) case Op::OP:
#define FUSED(OP, SOFT, FACTOR, ADDEND) case Op::OP:
#include "core/insns/float.def"
    return NumericKind::Float;
#define COMPARE(OP, CONDITION, QUIET) case Op::OP:
#include "core/insns/float.def"
    return NumericKind::Compare;
#define MINMAX(OP, IS_MIN) case Op::OP:
#include "core/insns/float.def"
    return NumericKind::MinMax;
#define TOINT(OP, SIGNED, SOFT) case Op::OP:
#include "core/insns/float.def"
    return NumericKind::ToInt;
#define FROMINT(OP, SIGNED, SOFT) case Op::OP:
#include "core/insns/float.def"
    return NumericKind::FromInt;
  default: // lui and auipc
    return NumericKind::Other;
  }
}

static NumericKind kindOf(Op O) {
  switch (effectsOf(O).Class) {
  case EffectClass::LaneWise:
    return ofOwnOperands(O);
  case EffectClass::Shuffle:
    return NumericKind::Shuffle;
  case EffectClass::Vote:
  case EffectClass::Split:
  case EffectClass::Predicate:
  case EffectClass::Branch:
    return NumericKind::Decide;
  case EffectClass::Load:
    return NumericKind::Load;
  case EffectClass::Store:
    return NumericKind::Store;
  case EffectClass::Atomic:
    return NumericKind::Atomic;
  case EffectClass::Join:
  case EffectClass::SetMask:
  case EffectClass::Warps:
  case EffectClass::Fence:
  case EffectClass::Jump:
  case EffectClass::IndirectJump:
  case EffectClass::Trap:
  case EffectClass::CsrRegister:
  case EffectClass::CsrImmediate:
    return NumericKind::Other;
  }
  __builtin_unreachable();
}

static std::array<NumericKind, NumOps> makeKinds() {
  std::array<NumericKind, NumOps> Kinds;
  for (unsigned N = 0; N != NumOps; ++N)
    Kinds[N] = kindOf(static_cast<Op>(N));
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
  default:
    return laneBits((effectsOf(O).ChangesMask ? A & 1U : A) != splat(0));
  }
}

unsigned shuffleSource(Op O, unsigned LaneNumber, uint32_t Control) {
  const auto Lane = static_cast<int>(LaneNumber);
  const int B = Control & 63, Segment = Control >> 12 & 63;
  const int Lo = Lane & Segment;
  switch (O) {
#define SHUFFLE(OP, SOURCE, VALID)                                             \
  case Op::OP:                                                                 \
    return static_cast<unsigned>(SOURCE);
#include "core/insns/shuffle.def"
  default:
    __builtin_unreachable(); // Effects_test: every shuffle is in the list
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
