#include "capture/Lens.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {
namespace {

/// 1 + C[0] S + C[1] S^2 + ...
template <std::size_t Count>
double polynomial(const std::array<double, Count> &C, double S) {
  double Sum = 0;
  for (std::size_t I = Count; I > 0; --I)
    Sum = (Sum + C[I - 1]) * S;
  return 1 + Sum;
}

} // namespace

/// Where the radial part alone shows \p R.
double Lens::radius(double R) const {
  switch (Kind) {
  case Model::Pinhole:
    break;
  case Model::RadialTangential:
    return R * polynomial(Radial, R * R) / polynomial(Denominator, R * R);
  case Model::Fisheye: {
    const double Angle = std::atan(R);
    return Angle * polynomial(Radial, Angle * Angle);
  }
  }
  return R;
}

std::array<double, 2> Lens::distort(double X, double Y) const {
  const double Squares = X * X + Y * Y;
  const double R = std::sqrt(Squares);
  const double Scale = R > 0 ? radius(R) / R : 1;
  const auto [P1, P2] = Tangential;
  return {X * Scale + 2 * P1 * X * Y + P2 * (Squares + 2 * X * X),
          Y * Scale + P1 * (Squares + 2 * Y * Y) + 2 * P2 * X * Y};
}

double Lens::reach(double Most) const {
  constexpr int Steps = 4096;
  double Last = 0;
  for (int I = 1; I <= Steps; ++I) {
    const double Place = radius(Most * I / Steps);
    // What is no number ends it too.
    if (!(Place > Last))
      return Most * (I - 1) / Steps;
    Last = Place;
  }
  return Most;
}

Lens simplified(const Lens &L) {
  const auto AreZero = [](const auto &Values) {
    return std::ranges::all_of(Values, [](double V) { return V == 0; });
  };
  const bool Bends = L.Kind == Lens::Model::Fisheye || !AreZero(L.Radial) ||
                     !AreZero(L.Denominator) || !AreZero(L.Tangential);
  return Bends ? L : Lens();
}

} // namespace vorion::splat
