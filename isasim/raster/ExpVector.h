/// The exponential units, 16 lanes at a time. What they are:
/// docs/lane-units.md#exponential-units. Included once per vector level, as
/// Vector.h.
#pragma once

#include "raster/ExpUnits.h"
#include "raster/PluggedExp.h"
#include "raster/RasterTables.h"
#include "raster/Vector.h"

namespace vorion::raster {
namespace {

/// A * B + C, rounded once where the level can do that fast. So intermediate
/// values may depend on the level.
VORION_INLINE Double8 multiplyAdd(Double8 A, Double8 B, Double8 C) {
#ifdef __FMA__
  return __builtin_elementwise_fma(A, B, C);
#else
  return A * B + C;
#endif
}

/// exp(x) in double, -104 <= x <= 0, relative error below 2^-52: near enough
/// for every fp32 x to round to the right float, with and without
/// multiplyAdd()'s single rounding (ExpUnits_test.cpp goes through all of
/// them).
VORION_INLINE Double8 expDouble(Double8 X) {
  constexpr double Log2E = 0x1.71547652b82fep0;
  // ln 2 in two parts, the first with 21 bits so that k * Ln2High is exact.
  constexpr double Ln2High = 0x1.62e42p-1;
  constexpr double Ln2Low = 0x1.fdf473de6af28p-22;
  // Adding it leaves the nearest integer in the low bits of the significand.
  constexpr double RoundToInteger = 0x1.8p52;

  const Double8 Shifted = multiplyAdd(X, Log2E, RoundToInteger);
  const Double8 K = Shifted - RoundToInteger;
  const Double8 R = multiplyAdd(K, -Ln2Low, multiplyAdd(K, -Ln2High, X));

  // (exp(r) - 1 - r) / r^2 interpolated at the ten Chebyshev nodes of |r| <=
  // ln(2)/2: exp(r) to within 2^-55. From the highest power down.
  constexpr double Coefficients[] = {
      0x1.af389ecfc4b9cp-26, 0x1.28917c89a43a7p-22, 0x1.71de0db2f6b19p-19,
      0x1.a019b9149a41cp-16, 0x1.a01a01a7c2efep-13, 0x1.6c16c17889ef1p-10,
      0x1.11111111109b5p-7,  0x1.5555555553d68p-5,  0x1.5555555555556p-3,
      0x1.0000000000001p-1};
  // Powers of r^2 and r^4 side by side: a chain of ten multiply-adds would take
  // longer than all that is around it.
  const auto &C = Coefficients;
  const Double8 R2 = R * R, R4 = R2 * R2;
  const Double8 Low =
      multiplyAdd(R2, multiplyAdd(R, C[6], C[7]), multiplyAdd(R, C[8], C[9]));
  const Double8 Middle =
      multiplyAdd(R2, multiplyAdd(R, C[2], C[3]), multiplyAdd(R, C[4], C[5]));
  const Double8 High = multiplyAdd(R, C[0], C[1]);
  const Double8 Tail = multiplyAdd(R4, multiplyAdd(R4, High, Middle), Low);
  const Double8 E = 1.0 + multiplyAdd(R2, Tail, R);

  // Times 2^K: K sits in Shifted's low bits, modulo 2^12 is enough.
  return __builtin_bit_cast(Double8,
                            __builtin_bit_cast(Long8, E) +
                                (__builtin_bit_cast(Long8, Shifted) << 52));
}

/// The unit of number \p Number; one that has no body does not compile.
template <uint32_t Number> struct ExpBody;

template <> struct ExpBody<VR_EXP_EXACT> {
  /// Below log(threshold) less this, a result is surely under the threshold.
  static constexpr float Margin = 0.01F;
  VORION_INLINE static Float16 evaluate(Float16 Power) {
    // Below -104 the result rounds to 0, as exp(-104) does. Above 0 and NaN
    // are nobody's pixels and only must not disturb.
    Float16 P = Power > -104.0F ? Power : Float16(-104.0F);
    P = P < 0.0F ? P : Float16(0.0F);
    const Float8 Low = __builtin_convertvector(
        expDouble(__builtin_convertvector(P.lo, Double8)), Float8);
    const Float8 High = __builtin_convertvector(
        expDouble(__builtin_convertvector(P.hi, Double8)), Float8);
    return __builtin_shufflevector(Low, High, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10,
                                   11, 12, 13, 14, 15);
  }
};

/// What a unit of limited range may be asked for.
VORION_INLINE Float16 clampPower(Float16 Power) {
  constexpr float Largest = base2_exp::Largest;
  const Float16 P = Power > -Largest ? Power : Float16(-Largest);
  return P < 0.0F ? P : Float16(0.0F);
}

/// \p Mantissa, positive, times 2^-(\p Whole + \p Scale); 0 where that is
/// below 2^-126.
VORION_INLINE Float16 scaleDown(Float16 Mantissa, Int16 Whole, int Scale) {
  const Int16 Bits =
      __builtin_bit_cast(Int16, Mantissa) - ((Whole + Scale) << 23);
  return __builtin_bit_cast(
      Float16, Whole < base2_exp::SmallestExponent ? Bits : Int16(0));
}

template <int EntryBits> struct TableExp {
  static constexpr float Margin = 0.01F;
  VORION_INLINE static Float16 evaluate(Float16 Power) {
    using namespace table_exp;
    using Numbers = Table<EntryBits>;
    const Float16 P = clampPower(Power);
    // -log2(result) in fixed point, truncated.
    constexpr float Slope =
        base2_exp::Log2E * static_cast<float>(1 << Numbers::FractionBits);
    const Int16 Y = __builtin_convertvector(P * -Slope, Int16);
    const Int16 Whole = Y >> Numbers::FractionBits;
    const Int16 Entry = Y >> RestBits & (Numbers::Entries - 1);
    const Int16 Rest = Y & ((1 << RestBits) - 1);
    Int16 Word;
    for (unsigned L = 0; L != LaneCount; ++L)
      Word[L] = TableOf<EntryBits>.Words[Entry[L]];
    const Int16 Drop = Word & ((1 << DropBits) - 1);
    // (1/2, 1] * 2^FractionBits
    const Int16 Mantissa = (Word >> DropBits) - (Drop * Rest >> RestBits);
    return scaleDown(__builtin_convertvector(Mantissa, Float16), Whole,
                     Numbers::FractionBits);
  }
};

template <> struct ExpBody<VR_EXP_TABLE> : TableExp<4> {};
template <> struct ExpBody<VR_EXP_TABLE32> : TableExp<5> {};
template <> struct ExpBody<VR_EXP_TABLE64> : TableExp<6> {};

template <unsigned Degree> struct PolynomialExp {
  static constexpr float Margin = 0.01F;
  VORION_INLINE static Float16 evaluate(Float16 Power) {
    const Float16 Y = clampPower(Power) * -base2_exp::Log2E;
    const Int16 Whole = __builtin_convertvector(Y, Int16);
    const Float16 G = Y - __builtin_convertvector(Whole, Float16);
    constexpr auto &C = ExpPolynomial<Degree>::Coefficients;
    Float16 Sum = C[Degree - 1];
#pragma clang loop unroll(full)
    for (unsigned I = Degree - 1; I != 0; --I)
      Sum = Sum * G + C[I - 1];
    return scaleDown(Sum * G + 1.0F, Whole, 0);
  }
};

template <> struct ExpBody<VR_EXP_POLY2> : PolynomialExp<2> {};
template <> struct ExpBody<VR_EXP_POLY3> : PolynomialExp<3> {};
template <> struct ExpBody<VR_EXP_POLY4> : PolynomialExp<4> {};

/// What a row of the datapaths' tables computes: the units of ExpUnits in their
/// order, and one from outside.
template <uint32_t Row> struct ExpRow : ExpBody<ExpUnits[Row].Option> {};

/// From outside, a lane after the other.
template <> struct ExpRow<PluggedExpRow> {
  /// A result may be e times too large.
  static constexpr float Margin = 1.0F;
  VORION_INLINE static Float16 evaluate(Float16 Power) {
    // What is above 0 or NaN is nobody's pixel.
    Power = Power < 0.0F ? Power : Float16(0.0F);
    Float16 Result;
    for (unsigned L = 0; L != LaneCount; ++L)
      Result[L] = PluggedExp(Power[L]);
    return Result;
  }
};

} // namespace
} // namespace vorion::raster
