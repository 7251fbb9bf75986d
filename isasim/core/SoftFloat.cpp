#include "core/SoftFloat.h"

#include "core/RoundingMode.h"

#include <bit>

namespace vorion::isasim {

namespace {

using Wide = unsigned __int128;

constexpr uint32_t SignBit = 0x80000000;
constexpr uint32_t Infinity = 0x7F800000;
constexpr uint32_t LargestFinite = 0x7F7FFFFF;
constexpr int MinExponent = -126; ///< of normal numbers
constexpr int FractionBits = 23;
/// Where the leading bit of a significand is put before an addition: enough
/// room above for a carry and below for the product of two significands.
constexpr int AlignedTop = 120;

bool isInf(uint32_t A) { return (A & ~SignBit) == Infinity; }
bool isZero(uint32_t A) { return (A & ~SignBit) == 0; }

/// Significand * 2^Exponent, for a finite A that is not 0.
struct Parts {
  bool Negative;
  int Exponent;
  Wide Significand;
};

Parts unpack(uint32_t A) {
  const uint32_t Biased = A >> FractionBits & 0xFF;
  const uint32_t Fraction = A & ((1U << FractionBits) - 1);
  const bool Normal = Biased != 0;
  return {(A & SignBit) != 0,
          (Normal ? static_cast<int>(Biased) : 1) - 127 - FractionBits,
          Fraction | (Normal ? 1U << FractionBits : 0U)};
}

int topBit(Wide Value) {
  const auto High = static_cast<uint64_t>(Value >> 64);
  return High ? 127 - std::countl_zero(High)
              : 63 - std::countl_zero(static_cast<uint64_t>(Value));
}

/// Value >> Shift with the lost bits ored into the lowest one.
Wide shiftRightJam(Wide Value, int Shift) {
  if (Shift <= 0)
    return Value << -Shift;
  if (Shift > 127)
    return Value != 0;
  return Value >> Shift | ((Value << (128 - Shift)) != 0);
}

/// Whether the magnitude Quotient + Lost/2^Shift is rounded up.
bool roundsUp(uint64_t Quotient, Wide Lost, Wide Half, bool Negative,
              unsigned Rm) {
  switch (Rm) {
  case Rne:
    return Lost > Half || (Lost == Half && (Quotient & 1));
  case Rdn:
    return Negative && Lost != 0;
  case Rup:
    return !Negative && Lost != 0;
  case Rmm:
    return Lost >= Half && Lost != 0;
  default:
    return false;
  }
}

/// P / 2^UlpExponent as a rounded integer. At most one bit of it is beyond the
/// precision that is asked for.
uint64_t roundAt(const Parts &P, int UlpExponent, unsigned Rm, bool &Exact) {
  // Two bits below the unit and a sticky one decide every mode.
  const Wide Scaled =
      shiftRightJam(P.Significand, UlpExponent - P.Exponent - 3);
  const auto Quotient = static_cast<uint64_t>(Scaled >> 3);
  const Wide Lost = Scaled & 7;
  Exact = Lost == 0;
  return Quotient + roundsUp(Quotient, Lost, 4, P.Negative, Rm);
}

uint32_t overflow(bool Negative, unsigned Rm, uint32_t &Flags) {
  Flags |= Overflow | Inexact;
  const bool ToInfinity = Rm == Rne || Rm == Rmm || (Rm == Rdn && Negative) ||
                          (Rm == Rup && !Negative);
  return (Negative ? SignBit : 0) | (ToInfinity ? Infinity : LargestFinite);
}

/// Rounds P, which is not 0. The lowest bit of the significand may be sticky.
uint32_t roundPack(const Parts &P, unsigned Rm, uint32_t &Flags) {
  const int Exponent = P.Exponent + topBit(P.Significand);
  const bool Subnormal = Exponent < MinExponent;
  const int UlpExponent = (Subnormal ? MinExponent : Exponent) - FractionBits;
  bool Exact = true;
  const uint64_t Rounded = roundAt(P, UlpExponent, Rm, Exact);
  // A carry out of the fraction goes on into the exponent field.
  const uint64_t Magnitude =
      Subnormal
          ? Rounded
          : Rounded + (static_cast<uint64_t>(Exponent + 126) << FractionBits);
  if (Magnitude >= Infinity)
    return overflow(P.Negative, Rm, Flags);
  if (!Exact) {
    Flags |= Inexact;
    if (Subnormal) {
      // Tiny unless rounding to full precision, with any exponent, reaches the
      // smallest normal number (IEEE 754-2008, 7.5, "after rounding").
      bool Ignored = true;
      const bool Carries = Exponent == MinExponent - 1 &&
                           roundAt(P, Exponent - FractionBits, Rm, Ignored) >>
                               (FractionBits + 1);
      if (!Carries)
        Flags |= Underflow;
    }
  }
  return (P.Negative ? SignBit : 0) | static_cast<uint32_t>(Magnitude);
}

uint32_t nanResult(uint32_t A, uint32_t B, uint32_t C, uint32_t &Flags) {
  if (isSignalingNan(A) || isSignalingNan(B) || isSignalingNan(C))
    Flags |= Invalid;
  return CanonicalNan;
}

uint32_t invalid(uint32_t &Flags) {
  Flags |= Invalid;
  return CanonicalNan;
}

Parts normalise(Parts P) {
  const int Shift = AlignedTop - topBit(P.Significand);
  P.Significand <<= Shift;
  P.Exponent -= Shift;
  return P;
}

uint32_t addParts(Parts X, Parts Y, unsigned Rm, uint32_t &Flags) {
  X = normalise(X);
  Y = normalise(Y);
  if (X.Exponent < Y.Exponent ||
      (X.Exponent == Y.Exponent && X.Significand < Y.Significand)) {
    const Parts T = X;
    X = Y;
    Y = T;
  }
  const Wide Aligned = shiftRightJam(Y.Significand, X.Exponent - Y.Exponent);
  X.Significand = X.Negative == Y.Negative ? X.Significand + Aligned
                                           : X.Significand - Aligned;
  if (X.Significand == 0)
    return Rm == Rdn ? SignBit : 0;
  return roundPack(X, Rm, Flags);
}

} // namespace

uint32_t softAdd(uint32_t A, uint32_t B, unsigned Rm, uint32_t &Flags) {
  // 1 * A + B: the product is exact and keeps A's sign.
  return softFma(A, 0x3F800000, B, Rm, Flags);
}

uint32_t softMul(uint32_t A, uint32_t B, unsigned Rm, uint32_t &Flags) {
  if (isNan(A) || isNan(B))
    return nanResult(A, B, 0, Flags);
  const uint32_t Sign = (A ^ B) & SignBit;
  if (isInf(A) || isInf(B))
    return isZero(A) || isZero(B) ? invalid(Flags) : Sign | Infinity;
  if (isZero(A) || isZero(B))
    return Sign;
  const Parts X = unpack(A), Y = unpack(B);
  return roundPack(
      {Sign != 0, X.Exponent + Y.Exponent, X.Significand * Y.Significand}, Rm,
      Flags);
}

uint32_t softDiv(uint32_t A, uint32_t B, unsigned Rm, uint32_t &Flags) {
  if (isNan(A) || isNan(B))
    return nanResult(A, B, 0, Flags);
  const uint32_t Sign = (A ^ B) & SignBit;
  if (isInf(A))
    return isInf(B) ? invalid(Flags) : Sign | Infinity;
  if (isInf(B))
    return Sign;
  if (isZero(B)) {
    if (isZero(A))
      return invalid(Flags);
    Flags |= DivideByZero;
    return Sign | Infinity;
  }
  if (isZero(A))
    return Sign;
  const Parts X = unpack(A), Y = unpack(B);
  constexpr int Extra = 64; // a subnormal by a normal still leaves 41 bits
  const Wide Dividend = X.Significand << Extra;
  const Wide Quotient = Dividend / Y.Significand;
  const bool Sticky = Dividend % Y.Significand != 0;
  return roundPack(
      {Sign != 0, X.Exponent - Y.Exponent - Extra, Quotient | Wide{Sticky}}, Rm,
      Flags);
}

uint32_t softSqrt(uint32_t A, unsigned Rm, uint32_t &Flags) {
  if (isNan(A))
    return nanResult(A, 0, 0, Flags);
  if (isZero(A))
    return A;
  if (A & SignBit)
    return invalid(Flags);
  if (isInf(A))
    return A;
  Parts P = unpack(A);
  // An even exponent, and 31 bits of root.
  int Shift = 60 - topBit(P.Significand);
  if ((P.Exponent - Shift) & 1)
    ++Shift;
  const auto Square = static_cast<uint64_t>(P.Significand << Shift);
  uint64_t Root = 0;
  for (uint64_t Bit = uint64_t{1} << 31; Bit; Bit >>= 1)
    if ((Root | Bit) * (Root | Bit) <= Square)
      Root |= Bit;
  const bool Sticky = Root * Root != Square;
  return roundPack(
      {false, (P.Exponent - Shift) / 2 - 1, Wide{Root} << 1 | Wide{Sticky}}, Rm,
      Flags);
}

uint32_t softFma(uint32_t A, uint32_t B, uint32_t C, unsigned Rm,
                 uint32_t &Flags) {
  const bool ZeroTimesInf = (isInf(A) && isZero(B)) || (isZero(A) && isInf(B));
  if (ZeroTimesInf)
    return invalid(Flags);
  if (isNan(A) || isNan(B) || isNan(C))
    return nanResult(A, B, C, Flags);
  const uint32_t Sign = (A ^ B) & SignBit;
  if (isInf(A) || isInf(B))
    return isInf(C) && (C & SignBit) != Sign ? invalid(Flags) : Sign | Infinity;
  if (isInf(C))
    return C;
  if (isZero(A) || isZero(B)) {
    if (!isZero(C))
      return C;
    return Sign == (C & SignBit) ? Sign : Rm == Rdn ? SignBit : 0;
  }
  const Parts X = unpack(A), Y = unpack(B);
  const Parts Product = {Sign != 0, X.Exponent + Y.Exponent,
                         X.Significand * Y.Significand};
  if (isZero(C))
    return roundPack(Product, Rm, Flags);
  return addParts(Product, unpack(C), Rm, Flags);
}

uint32_t softToInt(uint32_t A, bool Signed, unsigned Rm, uint32_t &Flags) {
  const bool Negative = (A & SignBit) != 0 && !isNan(A);
  const uint64_t Largest = Signed ? (Negative ? 0x80000000 : 0x7FFFFFFF)
                                  : (Negative ? 0 : 0xFFFFFFFF);
  const auto Saturated = static_cast<uint32_t>(Largest);
  if (isZero(A))
    return 0;
  const Parts P = unpack(A);
  // 2^33 and beyond, infinities and NaNs.
  if ((A & ~SignBit) >= 0x50000000) {
    Flags |= Invalid;
    return Saturated;
  }
  bool Exact = true;
  const uint64_t Magnitude = roundAt(P, 0, Rm, Exact);
  if (Magnitude > Largest) {
    Flags |= Invalid;
    return Saturated;
  }
  if (!Exact)
    Flags |= Inexact;
  const auto Low = static_cast<uint32_t>(Magnitude);
  return Negative ? 0U - Low : Low;
}

uint32_t softFromInt(uint32_t A, bool Signed, unsigned Rm, uint32_t &Flags) {
  if (A == 0)
    return 0;
  const bool Negative = Signed && (A & SignBit);
  return roundPack({Negative, 0, Negative ? 0U - A : A}, Rm, Flags);
}

} // namespace vorion::isasim
