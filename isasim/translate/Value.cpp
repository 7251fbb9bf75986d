#include "translate/Value.h"

#include <bit>
#include <cassert>
#include <utility>

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

Emitter *either(const Value &A, const Value &B) { return A.E ? A.E : B.E; }

uint32_t compute(Do What, uint32_t X, uint32_t Y) {
  switch (What) {
  case Do::Add:
    return X + Y;
  case Do::Sub:
    return X - Y;
  case Do::Mul:
    return X * Y;
  case Do::And:
    return X & Y;
  case Do::Or:
    return X | Y;
  case Do::Xor:
    return X ^ Y;
  case Do::ShiftLeft:
    return X << (Y & 31);
  case Do::ShiftRight:
    return X >> (Y & 31);
  default:
    assert(false && "not of numbers");
    return 0;
  }
}

Value binary(Do What, const Value &A, const Value &B) {
  if (A.isNumber() && B.isNumber()) {
    Value R(compute(What, A.X.Bits, B.X.Bits));
    R.E = either(A, B);
    return R;
  }
  return {either(A, B), What, A.settle(), B.settle()};
}

Test test(Relation Of, bool IsSigned, const Value &A, const Value &B) {
  return {either(A, B), Of, IsSigned, A.settle(), B.settle()};
}

bool commutes(Do What) {
  return What == Do::Add || What == Do::Mul || What == Do::And ||
         What == Do::Or || What == Do::Xor;
}

Zmm settled(const Value &V) { return V.E->inZmm(V.settle()); }

Value made(Emitter *E, const Zmm &In) { return {E, Term{In.getIdx()}}; }

} // namespace

void Test::into(const Opmask &K) const {
  const Zmm Left = E->inZmm(X);
  const Opmask To = E->active(K);
  const auto Compare = [&](const Operand &Right) {
    IsSigned ? E->vpcmpd(To, Left, Right, Of) : E->vpcmpud(To, Left, Right, Of);
  };
  if (Y.isNumber())
    Compare(E->constant(Y.Bits));
  else
    Compare(Zmm(Y.Zmm));
}

void Test::into(const Reg32 &Bits) const {
  const Zmm Left = E->inZmm(X);
  if (Y.isNumber())
    E->lanesWhere(Bits, Left, E->constant(Y.Bits), Of, IsSigned, E->isFull());
  else
    E->lanesWhere(Bits, Left, Zmm(Y.Zmm), Of, IsSigned, E->isFull());
}

Term Value::settle() const {
  if (What == Do::Move)
    return X;
  const Zmm To = E->scratch();
  into(To);
  return {To.getIdx()};
}

void Value::into(const Zmm &To) const {
  const bool IsMasked = To.getOpmaskIdx() != 0;
  const Zmm Plain(To.getIdx());
  if (What == Do::Move) {
    if (!X.isNumber()) {
      if (X.Zmm != To.getIdx())
        E->vmovdqa32(To, Zmm(X.Zmm));
    } else if (X.Bits == 0 && !IsMasked)
      E->vpxord(To, To, To);
    else if (X.Bits == 0)
      E->vpxord(To, Plain, Plain);
    else {
      E->vpbroadcastd(To, E->number(X.Bits));
    }
    return;
  }
  if (What == Do::One || What == Do::Keep || What == Do::Choose) {
    If.into(k2);
    const Zmm At = IsMasked ? E->scratch() : Plain;
    if (What == Do::One)
      E->vpbroadcastd(At | k2 | T_z, E->number(1));
    else if (What == Do::Keep)
      E->vmovdqa32(At | k2 | T_z, E->inZmm(Then));
    else {
      const Zmm Otherwise = E->inZmm(Else);
      E->vpblendmd(At | k2, Otherwise, E->inZmm(Then));
    }
    if (IsMasked)
      E->vmovdqa32(To, At);
    return;
  }
  Term A = X, B = Y;
  if (A.isNumber() && commutes(What))
    std::swap(A, B);
  const Zmm Left = E->inZmm(A);
  if (B.isNumber()) {
    const auto Count = static_cast<uint8_t>(B.Bits & 31);
    switch (What) {
    case Do::ShiftLeft:
      return E->vpslld(To, Left, Count);
    case Do::ShiftRight:
      return E->vpsrld(To, Left, Count);
    case Do::ShiftRightSigned:
      return E->vpsrad(To, Left, Count);
    case Do::RotateLeft:
      return E->vprold(To, Left, Count);
    default:
      break;
    }
  }
  const auto Write = [&](const Operand &Right) {
    switch (What) {
    case Do::Add:
      return E->vpaddd(To, Left, Right);
    case Do::Sub:
      return E->vpsubd(To, Left, Right);
    case Do::Mul:
      return E->vpmulld(To, Left, Right);
    case Do::And:
      return E->vpandd(To, Left, Right);
    case Do::AndNot:
      return E->vpandnd(To, Left, Right);
    case Do::Or:
      return E->vpord(To, Left, Right);
    case Do::Xor:
      return E->vpxord(To, Left, Right);
    case Do::ShiftLeft:
      return E->vpsllvd(To, Left, Right);
    case Do::ShiftRight:
      return E->vpsrlvd(To, Left, Right);
    case Do::ShiftRightSigned:
      return E->vpsravd(To, Left, Right);
    case Do::RotateLeft:
      return E->vprolvd(To, Left, Right);
    default:
      break;
    }
  };
  if (B.isNumber())
    Write(E->constant(B.Bits));
  else
    Write(Zmm(B.Zmm));
}

Value operator+(const Value &A, const Value &B) {
  return binary(Do::Add, A, B);
}
Value operator-(const Value &A, const Value &B) {
  return binary(Do::Sub, A, B);
}
Value operator*(const Value &A, const Value &B) {
  return binary(Do::Mul, A, B);
}
Value operator&(const Value &A, const Value &B) {
  if (!A.isNumber() && B.What == Do::Xor && B.Y.isNumber() && B.Y.Bits == ~0U)
    return {either(A, B), Do::AndNot, B.X, A.settle()};
  return binary(Do::And, A, B);
}
Value operator|(const Value &A, const Value &B) { return binary(Do::Or, A, B); }
Value operator^(const Value &A, const Value &B) {
  return binary(Do::Xor, A, B);
}
Value operator<<(const Value &A, const Value &B) {
  return binary(Do::ShiftLeft, A, B);
}
Value operator>>(const Value &A, const Value &B) {
  return binary(Do::ShiftRight, A, B);
}
Value operator~(const Value &A) { return A ^ Value(~0U); }
Value operator-(const Value &A) { return Value(0) - A; }
Value operator&(const Value &A, const Mask &B) {
  Value R(B.Of.E, Do::Keep, {}, {});
  R.If = B.Of;
  R.Then = A.settle();
  return R;
}

Test operator==(const Value &A, const Value &B) {
  return test(Relation::Equal, false, A, B);
}
Test operator!=(const Value &A, const Value &B) {
  return test(Relation::NotEqual, false, A, B);
}
Test operator<(const Value &A, const Value &B) {
  return test(Relation::Less, false, A, B);
}
Test operator>=(const Value &A, const Value &B) {
  return test(Relation::NotLess, false, A, B);
}
Test operator<(const Signed &A, const Signed &B) {
  return test(Relation::Less, true, A.Of, B.Of);
}
Test operator>=(const Signed &A, const Signed &B) {
  return test(Relation::NotLess, true, A.Of, B.Of);
}
Signed operator>>(const Signed &A, const Signed &B) {
  return {
      {either(A.Of, B.Of), Do::ShiftRightSigned, A.Of.settle(), B.Of.settle()}};
}
Signed operator>>(const Signed &A, unsigned B) { return A >> Signed{Value(B)}; }

Value one(const Test &A) {
  Value R(A.E, Do::One, {}, {});
  R.If = A;
  return R;
}

Value select(const Mask &If, const Value &Then, const Value &Else) {
  Value R(If.Of.E, Do::Choose, {}, {});
  R.If = If.Of;
  R.Then = Then.settle();
  R.Else = Else.settle();
  return R;
}

Value shiftLeft(const Value &A, const Value &B) { return A << (B & Value(31)); }
Value bit(const Value &B) { return shiftLeft(Value(1), B); }

Value rotateLeft(const Value &A, const Value &B) {
  return {either(A, B), Do::RotateLeft, A.settle(), B.settle()};
}

namespace {

/// The upper halves of the products: of the even lanes, then of the odd ones,
/// which the host's instructions do not multiply.
Value upperHalves(const Value &A, const Value &B, bool AreSigned) {
  Emitter *E = either(A, B);
  const Zmm X = settled(A), Y = settled(B);
  const Zmm Even = E->scratch(), Odd = E->scratch(), Other = E->scratch();
  E->vpsrlq(Odd, X, 32);
  E->vpsrlq(Other, Y, 32);
  if (AreSigned) {
    E->vpmuldq(Even, X, Y);
    E->vpmuldq(Odd, Odd, Other);
  } else {
    E->vpmuludq(Even, X, Y);
    E->vpmuludq(Odd, Odd, Other);
  }
  E->vpsrlq(Even, Even, 32);
  E->mov(eax, 0xAAAA);
  E->kmovw(k2, eax);
  E->vmovdqa32(Even | k2, Odd);
  return made(E, Even);
}

Value quotient(const Value &A, const Value &B, bool AreSigned) {
  Emitter *E = either(A, B);
  const Zmm X = settled(A), Y = settled(B);
  const Zmm To = E->scratch(), Spare = E->scratch(), Other = E->scratch();
  E->quotient(To, X, Y, AreSigned, Spare, Other);
  return made(E, To);
}

Value remainder(const Value &A, const Value &B, bool AreSigned) {
  Emitter *E = either(A, B);
  const Value X = made(E, settled(A)), Y = made(E, settled(B));
  const Zmm Q = settled(quotient(X, Y, AreSigned));
  E->vpmulld(Q, Q, settled(Y));
  return X - made(E, Q);
}

} // namespace

Value mulHigh(const Value &A, const Value &B) {
  return upperHalves(A, B, true);
}
Value mulHighU(const Value &A, const Value &B) {
  return upperHalves(A, B, false);
}
Value mulHighSU(const Value &A, const Value &B) {
  Emitter *E = either(A, B);
  const Value X = made(E, settled(A)), Y = made(E, settled(B));
  const Zmm R = settled(upperHalves(X, Y, false));
  E->vpmovd2m(k2, settled(X));
  E->vpsubd(R | k2, R, settled(Y));
  return made(E, R);
}
Value divS(const Value &A, const Value &B) { return quotient(A, B, true); }
Value divU(const Value &A, const Value &B) { return quotient(A, B, false); }
Value remS(const Value &A, const Value &B) { return remainder(A, B, true); }
Value remU(const Value &A, const Value &B) { return remainder(A, B, false); }

Value countLeading(const Value &A) {
  const Zmm To = A.E->scratch();
  A.E->vplzcntd(To, settled(A));
  return made(A.E, To);
}
Value countTrailing(const Value &A) {
  // As many ones as there are zeros at the end.
  const Value Settled(A.E, A.settle());
  return Value(32) - countLeading(~Settled & (Settled - Value(1)));
}
Value popCount(const Value &A) {
  const Zmm To = A.E->scratch();
  A.E->vpopcntd(To, settled(A));
  return made(A.E, To);
}
Value orBytes(const Value &A) {
  const Zmm To = A.E->scratch(), From = settled(A);
  A.E->markBytes(To, From);
  return made(A.E, To);
}
Value swapBytes(const Value &A) {
  std::array<uint32_t, MaxLanes> Order{};
  for (uint32_t L = 0; L != MaxLanes; ++L)
    Order[L] = 0x00010203U + L % 4 * 0x04040404U;
  const Zmm To = A.E->scratch();
  A.E->vpshufb(To, settled(A), A.E->vectorOf(Order));
  return made(A.E, To);
}

/// With AVX-512 alone (needsWide() of Region.cpp).
Value classify(const Value &A) {
  Emitter *E = A.E;
  const Zmm To = E->scratch(), From = settled(A);
  // The host's classes (vfpclassps), those of finite numbers first, and
  // RISC-V's bits (fclass.s).
  E->vpbroadcastd(To, E->number(1U << 6));
  constexpr unsigned Subnormal = 0x20;
  constexpr std::pair<unsigned, uint32_t> Classes[] = {
      {0x02, 1U << 4}, {0x04, 1U << 3}, {0x08, 1U << 7},
      {0x10, 1U << 0}, {0x80, 1U << 8}, {0x01, 1U << 9}};
  E->vpmovd2m(k3, From);
  E->vpbroadcastd(To | k3, E->number(1U << 1));
  E->vfpclassps(k2, From, Subnormal);
  E->vpbroadcastd(To | k2, E->number(1U << 5));
  E->kandw(k2, k2, k3);
  E->vpbroadcastd(To | k2, E->number(1U << 2));
  for (const auto &[Class, Bit] : Classes) {
    E->vfpclassps(k2, From, static_cast<uint8_t>(Class));
    E->vpbroadcastd(To | k2, E->number(Bit));
  }
  return made(E, To);
}

} // namespace vorion::isasim::translate
