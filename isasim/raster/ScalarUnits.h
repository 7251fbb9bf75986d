/// The lane's units read aloud for one number at a time: what the tests hold
/// the vector code against, bit for bit.
#pragma once

#include "raster/ExpUnits.h"
#include "raster/UnitTables.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace vorion::raster::scalar {

inline float held(float Power) {
  return std::min(std::max(Power, -base2_exp::Largest), 0.0F);
}

/// Mantissa 2^-(Whole + Scale), 0 below 2^-126.
inline float scaled(float Mantissa, int32_t Whole, int Scale) {
  return Whole < base2_exp::SmallestExponent
             ? std::ldexp(Mantissa, -(Whole + Scale))
             : 0.0F;
}

template <int EntryBits> float tableExp(float Power) {
  using namespace table_exp;
  constexpr int FractionBits = Table<EntryBits>::FractionBits;
  const auto Y = static_cast<int32_t>(
      held(Power) * -std::ldexp(base2_exp::Log2E, FractionBits));
  const int32_t Fraction = Y % (1 << FractionBits);
  const int32_t Word = TableOf<EntryBits>.Words[Fraction / (1 << RestBits)];
  const int32_t Drop = Word % (1 << DropBits);
  const int32_t Mantissa =
      Word / (1 << DropBits) -
      Drop * (Fraction % (1 << RestBits)) / (1 << RestBits);
  return scaled(static_cast<float>(Mantissa), Y / (1 << FractionBits),
                FractionBits);
}

template <unsigned Degree> float polynomialExp(float Power) {
  const float Y = held(Power) * -base2_exp::Log2E;
  const float Whole = std::floor(Y);
  const float G = Y - Whole;
  float Sum = 0;
  for (unsigned I = Degree; I != 0; --I)
    Sum = Sum * G + ExpPolynomial<Degree>::Coefficients[I - 1];
  return scaled(Sum * G + 1.0F, static_cast<int32_t>(Whole), 0);
}

/// The unit of number \p Number; one that has no body does not compile.
template <uint32_t Number> float expBody(float Power) = delete;

/// Through a double: right but for ties that no test meets.
template <> inline float expBody<VR_EXP_EXACT>(float Power) {
  return static_cast<float>(std::exp(static_cast<double>(Power)));
}
template <> inline float expBody<VR_EXP_TABLE>(float Power) {
  return tableExp<4>(Power);
}
template <> inline float expBody<VR_EXP_TABLE32>(float Power) {
  return tableExp<5>(Power);
}
template <> inline float expBody<VR_EXP_TABLE64>(float Power) {
  return tableExp<6>(Power);
}
template <> inline float expBody<VR_EXP_POLY2>(float Power) {
  return polynomialExp<2>(Power);
}
template <> inline float expBody<VR_EXP_POLY3>(float Power) {
  return polynomialExp<3>(Power);
}
template <> inline float expBody<VR_EXP_POLY4>(float Power) {
  return polynomialExp<4>(Power);
}
template <uint32_t... Rows>
float exp(uint32_t Row, float Power,
          std::integer_sequence<uint32_t, Rows...> /*All*/) {
  static constexpr float (*Bodies[])(float) = {
      expBody<ExpUnits[Rows].Option>...};
  return Bodies[Row](Power);
}

/// What ExpUnits[\p Row] makes of \p Power <= 0.
inline float exp(uint32_t Row, float Power) {
  return exp(Row, Power, std::make_integer_sequence<uint32_t, ExpUnitCount>());
}

/// \p X as an operand of blend arithmetic \p Option: rounded in doubles to the
/// format's step at its exponent.
inline float operand(uint32_t Option, float X) {
  if (Option == VR_BLEND_FP32 || X == 0 || !std::isfinite(X))
    return Option == VR_BLEND_FP16 && std::isinf(X) ? std::copysign(65504.0F, X)
                                                    : X;
  const bool IsFp16 = Option == VR_BLEND_FP16;
  const int SmallestExponent = IsFp16 ? -14 : -126;
  const int DigitsBehind =
      static_cast<int>(BlendUnits[Option].SignificandBits) - 1;
  const double Step =
      std::ldexp(1.0, std::max(std::ilogb(X), SmallestExponent) - DigitsBehind);
  const double Rounded = std::nearbyint(double{X} / Step) * Step;
  if (IsFp16)
    return static_cast<float>(std::clamp(Rounded, -65504.0, 65504.0));
  return static_cast<float>(Rounded);
}

} // namespace vorion::raster::scalar
