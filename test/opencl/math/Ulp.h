/// Errors of results in units of the last place.
#pragma once

#include "Format.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mpfr.h>

namespace vorion::test {

/// A number with so many bits that its own rounding is no part of an error.
class Number {
public:
  Number() { mpfr_init2(Value, 160); }
  template <typename Real> explicit Number(Real X) : Number() {
    mpfr_set_d(Value, static_cast<double>(X), MPFR_RNDN);
  }
  ~Number() { mpfr_clear(Value); }
  Number(const Number &) = delete;
  Number &operator=(const Number &) = delete;
  mpfr_ptr get() { return Value; }

private:
  mpfr_t Value;
};

/// Distance of \p Result from \p Exact in units of the last place of Real at
/// Exact. A subnormal's unit is the least one. Infinity counts as the number
/// behind the largest one.
template <typename Real> double ulpError(Real Result, mpfr_ptr Exact) {
  using Limits = Format<Real>;
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  const auto Got = static_cast<double>(Result);
  if (mpfr_nan_p(Exact) || std::isnan(Got))
    return mpfr_nan_p(Exact) && std::isnan(Got) ? 0 : Infinity;
  if (mpfr_zero_p(Exact) && Got == 0)
    return std::signbit(Got) == bool(mpfr_signbit(Exact)) ? 0 : Infinity;
  Number Value(Got), Behind;
  mpfr_set_ui_2exp(Behind.get(), 1, Limits::max_exponent, MPFR_RNDN);
  if (std::isinf(Got))
    mpfr_copysign(Value.get(), Behind.get(), Value.get(), MPFR_RNDN);
  if (mpfr_cmpabs(Exact, Behind.get()) > 0)
    mpfr_copysign(Exact, Behind.get(), Exact, MPFR_RNDN);
  long Exponent = Limits::min_exponent;
  if (!mpfr_zero_p(Exact))
    Exponent = std::clamp<long>(mpfr_get_exp(Exact), Limits::min_exponent,
                                Limits::max_exponent);
  mpfr_sub(Value.get(), Value.get(), Exact, MPFR_RNDN);
  mpfr_mul_2si(Value.get(), Value.get(), Limits::digits - Exponent, MPFR_RNDN);
  return std::fabs(mpfr_get_d(Value.get(), MPFR_RNDN));
}

} // namespace vorion::test
