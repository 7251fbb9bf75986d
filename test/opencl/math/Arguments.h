/// Arguments for the math functions.
#pragma once

#include "Format.h"
#include "Functions.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <type_traits>
#include <vector>

namespace vorion::test {

/// Where something changes: zeros, the ends of the range, halves, NaN.
template <typename Real> std::vector<Real> specialValues() {
  using Limits = Format<Real>;
  const auto WholeFrom = Real(std::ldexp(1.0, Limits::digits - 1));
  std::vector<Real> Values = {Limits::quiet_NaN()};
  for (const Real Magnitude :
       {Real(0), Limits::denorm_min(), Limits::min() - Limits::denorm_min(),
        Limits::min(), Real(0.5), Real(1), Real(1.5), Real(2), Real(2.5),
        Real(3), Real(M_PI_2), Real(M_PI), Real(WholeFrom - Real(0.5)),
        WholeFrom, Real(WholeFrom + Real(1)), Real(2 * WholeFrom),
        Limits::max(), Limits::infinity()}) {
    Values.push_back(Magnitude);
    Values.push_back(-Magnitude);
  }
  return Values;
}

template <typename Real> class Arguments {
public:
  explicit Arguments(unsigned Seed) : Random(Seed) {}

  Real draw(Range Wanted) {
    using Limits = Format<Real>;
    using Bits =
        std::conditional_t<sizeof(Real) == sizeof(uint64_t), uint64_t,
                           std::conditional_t<sizeof(Real) == sizeof(uint32_t),
                                              uint32_t, uint16_t>>;
    const double Sign = Random() % 2 ? 1 : -1;
    switch (Wanted) {
    case Range::Any:
      return std::bit_cast<Real>(static_cast<Bits>(Random()));
    case Range::Moderate:
      return Real(Sign * std::exp2(38 * uniform() - 30));
    case Range::Unit:
      return Real(Sign * uniform());
    case Range::NearOne:
      return Real(1 + Sign * uniform() * 0x1p-8);
    case Range::Positive:
      return Real(std::exp2((2 * uniform() - 1) * (Limits::max_exponent - 3)));
    case Range::AboveOne:
      return Real(std::exp2(60 * uniform()));
    case Range::SmallInts:
      return Real(Sign * std::ceil(60 * uniform()));
    }
    return 0;
  }

private:
  double uniform() { return static_cast<double>(Random() >> 11) * 0x1p-53; }
  std::mt19937_64 Random;
};

/// \p Count values of x, y and z for \p F. Where x and y may be anything, all
/// pairs of special values come first.
template <typename Real>
std::vector<std::vector<Real>> argumentsOf(const MathFunction &F,
                                           std::size_t Count) {
  std::vector<std::vector<Real>> Columns(3);
  const std::vector<Real> Special = specialValues<Real>();
  Arguments<Real> Random(1);
  for (std::size_t I = 0; I < Count; ++I) {
    Columns[0].push_back(Random.draw(F.X));
    Columns[1].push_back(Random.draw(F.Others));
    Columns[2].push_back(Random.draw(F.Others));
    if (I >= Special.size() * Special.size())
      continue;
    if (F.X == Range::Any)
      Columns[0][I] = Special[I % Special.size()];
    if (F.Others == Range::Any) {
      Columns[1][I] = Special[I / Special.size()];
      Columns[2][I] = Special[(I + I / Special.size()) % Special.size()];
    }
  }
  return Columns;
}

} // namespace vorion::test
