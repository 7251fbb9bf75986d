#include "testing/MpfrOracle.h"

#include "core/RoundingMode.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <mpfr.h>

namespace vorion::isasim::testing {

namespace {

// RISC-V F, "Floating-Point Control and Status Register".
enum Flag : uint32_t { Nx = 1, Uf = 2, Of = 4, Dz = 8, Nv = 16 };

constexpr uint32_t QuietNan = 0x7FC00000;
constexpr uint32_t Inf = 0x7F800000;
constexpr uint32_t Largest = 0x7F7FFFFF;
constexpr uint32_t SignBit = 0x80000000;
/// Exact for sums of any three floats' product and addend: 2^256 down to
/// 2^-298 with 48 bits more.
constexpr mpfr_prec_t Exact = 700;
constexpr int Precision = 24;
constexpr int LowestUnit = -149; ///< exponent of the least subnormal

/// MPFR's numbers live as long as the program: making one costs more than
/// using it.
class Number {
public:
  Number() { mpfr_init2(Value, Exact); }
  ~Number() { mpfr_clear(Value); }
  Number(const Number &) = delete;
  Number &operator=(const Number &) = delete;
  mpfr_ptr get() { return Value; }

private:
  mpfr_t Value;
};

struct Operand {
  explicit Operand(uint32_t BitsIn) : Bits(BitsIn) {}
  uint32_t Bits;
  bool negative() const { return Bits >> 31; }
  bool isNan() const { return (Bits & ~SignBit) > Inf; }
  bool isSignaling() const { return isNan() && !(Bits >> 22 & 1); }
  bool isInf() const { return (Bits & ~SignBit) == Inf; }
  bool isZero() const { return (Bits & ~SignBit) == 0; }
  void load(mpfr_ptr To) const {
    mpfr_set_flt(To, std::bit_cast<float>(Bits), MPFR_RNDN);
  }
};

constexpr uint32_t signed32(bool Negative, uint32_t Magnitude) {
  return Negative ? Magnitude | SignBit : Magnitude;
}

/// To a whole number, in a mode of RISC-V.
void roundToInteger(mpfr_ptr To, mpfr_srcptr From, unsigned Rm) {
  switch (Rm) {
  case Rne:
    mpfr_rint(To, From, MPFR_RNDN); // ties to even
    break;
  case Rtz:
    mpfr_trunc(To, From);
    break;
  case Rdn:
    mpfr_floor(To, From);
    break;
  case Rup:
    mpfr_ceil(To, From);
    break;
  default:
    mpfr_round(To, From); // ties away from zero
  }
}

/// X as a multiple of 2^Unit.
void roundToUnit(mpfr_ptr To, mpfr_srcptr X, long Unit, unsigned Rm) {
  mpfr_mul_2si(To, X, -Unit, MPFR_RNDN); // exact
  roundToInteger(To, To, Rm);
  mpfr_mul_2si(To, To, Unit, MPFR_RNDN);
}

OracleResult overflow(bool Negative, unsigned Rm) {
  const bool ToInf = Rm == Rne || Rm == Rmm || Rm == (Negative ? Rdn : Rup);
  return {signed32(Negative, ToInf ? Inf : Largest), Of | Nx};
}

/// The exact value \p X, not 0, as a float.
OracleResult round(mpfr_srcptr X, unsigned Rm) {
  static Number Result, Unbounded;
  const bool Negative = mpfr_signbit(X);
  const long Unit = mpfr_get_exp(X) - Precision;
  roundToUnit(Result.get(), X, std::max<long>(Unit, LowestUnit), Rm);
  if (mpfr_cmpabs(Result.get(), X) != 0 && Unit < LowestUnit) {
    // Tiny is what is below the normal numbers after rounding as if the
    // exponent had no bounds.
    roundToUnit(Unbounded.get(), X, Unit, Rm);
    const bool Tiny =
        mpfr_cmp_si_2exp(Unbounded.get(), Negative ? -1 : 1, -126) *
            (Negative ? -1 : 1) <
        0;
    return {signed32(Negative, std::bit_cast<uint32_t>(std::abs(
                                   mpfr_get_flt(Result.get(), MPFR_RNDN)))),
            Nx | (Tiny ? Uf : 0U)};
  }
  if (mpfr_get_exp(Result.get()) > 128)
    return overflow(Negative, Rm);
  const bool Inexact = mpfr_cmp(Result.get(), X) != 0;
  return {signed32(Negative, std::bit_cast<uint32_t>(std::abs(
                                 mpfr_get_flt(Result.get(), MPFR_RNDN)))),
          Inexact ? Nx : 0U};
}

/// X if it is not 0, else a zero whose sign is that of both terms, or the
/// mode's if they differ.
OracleResult roundSum(mpfr_srcptr X, bool FirstNegative, bool SecondNegative,
                      unsigned Rm) {
  if (!mpfr_zero_p(X))
    return round(X, Rm);
  const bool Negative =
      FirstNegative == SecondNegative ? FirstNegative : Rm == Rdn;
  return {signed32(Negative, 0), 0};
}

/// A * B + C.
OracleResult fused(Operand A, Operand B, Operand C, unsigned Rm) {
  const bool Signaling = A.isSignaling() || B.isSignaling() || C.isSignaling();
  const bool Undefined = (A.isInf() && B.isZero()) || (A.isZero() && B.isInf());
  if (Signaling || Undefined)
    return {QuietNan, Nv};
  if (A.isNan() || B.isNan() || C.isNan())
    return {QuietNan, 0};
  const bool ProductNegative = A.negative() != B.negative();
  if (A.isInf() || B.isInf()) {
    if (C.isInf() && C.negative() != ProductNegative)
      return {QuietNan, Nv};
    return {signed32(ProductNegative, Inf), 0};
  }
  if (C.isInf())
    return {C.Bits, 0};
  static Number X, Y, Z;
  A.load(X.get());
  B.load(Y.get());
  C.load(Z.get());
  [[maybe_unused]] const int Inexact =
      mpfr_fma(X.get(), X.get(), Y.get(), Z.get(), MPFR_RNDN);
  assert(Inexact == 0);
  return roundSum(X.get(), ProductNegative, C.negative(), Rm);
}

OracleResult add(Operand A, Operand B, unsigned Rm) {
  return fused(A, Operand(0x3F800000), B, Rm);
}

OracleResult multiply(Operand A, Operand B, unsigned Rm) {
  // A zero that the product's sign decides.
  const bool Negative = A.negative() != B.negative();
  return fused(A, B, Operand(signed32(Negative, 0)), Rm);
}

/// What was cut off behind a number of 200 bits is neither nothing nor enough
/// for anything.
void makeSticky(mpfr_ptr X, int Inexact) {
  mpfr_prec_round(X, Exact, MPFR_RNDN);
  if (Inexact)
    mpfr_signbit(X) ? mpfr_nextbelow(X) : mpfr_nextabove(X);
}
constexpr mpfr_prec_t Cut = 200;

OracleResult divide(Operand A, Operand B, unsigned Rm) {
  if (A.isSignaling() || B.isSignaling() || (A.isInf() && B.isInf()) ||
      (A.isZero() && B.isZero()))
    return {QuietNan, Nv};
  if (A.isNan() || B.isNan())
    return {QuietNan, 0};
  const bool Negative = A.negative() != B.negative();
  if (A.isInf())
    return {signed32(Negative, Inf), 0};
  if (B.isZero())
    return {signed32(Negative, Inf), Dz};
  if (A.isZero() || B.isInf())
    return {signed32(Negative, 0), 0};
  static Number X, Y, Q;
  A.load(X.get());
  B.load(Y.get());
  mpfr_set_prec(Q.get(), Cut);
  makeSticky(Q.get(), mpfr_div(Q.get(), X.get(), Y.get(), MPFR_RNDZ));
  return round(Q.get(), Rm);
}

OracleResult squareRoot(Operand A, unsigned Rm) {
  if (A.isSignaling() || (A.negative() && !A.isZero() && !A.isNan()))
    return {QuietNan, Nv};
  if (A.isNan())
    return {QuietNan, 0};
  if (A.isInf() || A.isZero())
    return {A.Bits, 0};
  static Number X, Q;
  A.load(X.get());
  mpfr_set_prec(Q.get(), Cut);
  makeSticky(Q.get(), mpfr_sqrt(Q.get(), X.get(), MPFR_RNDZ));
  return round(Q.get(), Rm);
}

OracleResult toInteger(Operand A, bool Signed, unsigned Rm) {
  const uint32_t Lowest = Signed ? 0x80000000 : 0;
  const uint32_t Highest = Signed ? 0x7FFFFFFF : 0xFFFFFFFF;
  if (A.isNan() || A.isInf())
    return {A.isInf() && A.negative() ? Lowest : Highest, Nv};
  static Number X, Y;
  A.load(X.get());
  roundToInteger(Y.get(), X.get(), Rm);
  const bool Fits = Signed ? mpfr_cmp_si(Y.get(), INT32_MIN) >= 0 &&
                                 mpfr_cmp_si(Y.get(), INT32_MAX) <= 0
                           : mpfr_cmp_si(Y.get(), 0) >= 0 &&
                                 mpfr_cmp_ui(Y.get(), UINT32_MAX) <= 0;
  if (!Fits)
    return {A.negative() ? Lowest : Highest, Nv};
  return {static_cast<uint32_t>(mpfr_get_si(Y.get(), MPFR_RNDN)),
          mpfr_cmp(X.get(), Y.get()) != 0 ? Nx : 0U};
}

OracleResult fromInteger(uint32_t A, bool Signed, unsigned Rm) {
  static Number X;
  if (Signed)
    mpfr_set_si(X.get(), static_cast<int32_t>(A), MPFR_RNDN);
  else
    mpfr_set_ui(X.get(), A, MPFR_RNDN);
  return A == 0 ? OracleResult{0, 0} : round(X.get(), Rm);
}

OracleResult leastOrGreatest(Operand A, Operand B, bool Least) {
  const uint32_t Flags = A.isSignaling() || B.isSignaling() ? Nv : 0U;
  if (A.isNan())
    return {B.isNan() ? QuietNan : B.Bits, Flags};
  if (B.isNan())
    return {A.Bits, Flags};
  static Number X, Y;
  A.load(X.get());
  B.load(Y.get());
  const int Order = mpfr_cmp(X.get(), Y.get());
  const bool FirstIsLess = Order != 0 ? Order < 0 : A.negative();
  return {FirstIsLess == Least ? A.Bits : B.Bits, Flags};
}

OracleResult compare(Op O, Operand A, Operand B) {
  if (A.isNan() || B.isNan()) {
    const bool Raises = O != Op::RV_FEQ_S || A.isSignaling() || B.isSignaling();
    return {0, Raises ? Nv : 0U};
  }
  static Number X, Y;
  A.load(X.get());
  B.load(Y.get());
  const int Order = mpfr_cmp(X.get(), Y.get());
  return {O == Op::RV_FEQ_S   ? Order == 0
          : O == Op::RV_FLT_S ? Order < 0
                              : Order <= 0,
          0};
}

/// RISC-V F, table "Format of result of FCLASS".
uint32_t classOf(Operand A) {
  if (A.isNan())
    return 1U << (A.isSignaling() ? 8 : 9);
  static Number X;
  A.load(X.get());
  unsigned Size = 0; // zero, subnormal, normal, infinite
  if (mpfr_inf_p(X.get()))
    Size = 3;
  else if (!mpfr_zero_p(X.get()))
    Size = mpfr_get_exp(X.get()) <= -126 ? 1 : 2;
  return 1U << (A.negative() ? 3 - Size : 4 + Size);
}

} // namespace

OracleResult oracle(Op O, uint32_t ABits, uint32_t BBits, uint32_t CBits,
                    unsigned Rm) {
  const Operand A(ABits), B(BBits), C(CBits);
  const Operand MinusA(ABits ^ SignBit), MinusB(BBits ^ SignBit),
      MinusC(CBits ^ SignBit);
  switch (O) {
  case Op::RV_FADD_S:
    return add(A, B, Rm);
  case Op::RV_FSUB_S:
    return add(A, MinusB, Rm);
  case Op::RV_FMUL_S:
    return multiply(A, B, Rm);
  case Op::RV_FDIV_S:
    return divide(A, B, Rm);
  case Op::RV_FSQRT_S:
    return squareRoot(A, Rm);
  case Op::RV_FMADD_S:
    return fused(A, B, C, Rm);
  case Op::RV_FMSUB_S:
    return fused(A, B, MinusC, Rm);
  case Op::RV_FNMSUB_S:
    return fused(MinusA, B, C, Rm);
  case Op::RV_FNMADD_S:
    return fused(MinusA, B, MinusC, Rm);
  case Op::RV_FMIN_S:
    return leastOrGreatest(A, B, true);
  case Op::RV_FMAX_S:
    return leastOrGreatest(A, B, false);
  case Op::RV_FEQ_S:
  case Op::RV_FLT_S:
  case Op::RV_FLE_S:
    return compare(O, A, B);
  case Op::RV_FCVT_W_S:
    return toInteger(A, true, Rm);
  case Op::RV_FCVT_WU_S:
    return toInteger(A, false, Rm);
  case Op::RV_FCVT_S_W:
    return fromInteger(ABits, true, Rm);
  case Op::RV_FCVT_S_WU:
    return fromInteger(ABits, false, Rm);
  case Op::RV_FSGNJ_S:
    return {(ABits & ~SignBit) | (BBits & SignBit), 0};
  case Op::RV_FSGNJN_S:
    return {(ABits & ~SignBit) | (~BBits & SignBit), 0};
  case Op::RV_FSGNJX_S:
    return {ABits ^ (BBits & SignBit), 0};
  case Op::RV_FMV_X_W:
  case Op::RV_FMV_W_X:
    return {ABits, 0};
  case Op::RV_FCLASS_S:
    return {classOf(A), 0};
  default:
    assert(false && "not a floating-point instruction");
    return {0, 0};
  }
}

} // namespace vorion::isasim::testing
