// A pinhole with OpenCV's distortion. K: k1, k2, p1, p2, k3, k4, k5, k6, s1 to
// s4, and then a coefficient of r^8 over the fraction.
#include "reference/lens/LensModel.h"

#include <cmath>
#include <limits>

namespace vorion::reference {
namespace {

struct Equation {
  template <typename T>
  static Place<T> at(const LensCoefficients &K, const Point<T> &P) {
    const T A = P[0] / P[2], B = P[1] / P[2], Q = A * A + B * B;
    const T Radial = (1 + Q * (K[0] + Q * (K[1] + Q * (K[4] + K[12] * Q)))) /
                     (1 + Q * (K[5] + Q * (K[6] + K[7] * Q)));
    return {A * Radial + 2 * K[2] * (A * B) + K[3] * (Q + 2 * (A * A)) +
                Q * (K[8] + K[9] * Q),
            B * Radial + K[2] * (Q + 2 * (B * B)) + 2 * K[3] * (A * B) +
                Q * (K[10] + K[11] * Q)};
  }
};

LensCoefficients radialPart(const LensCoefficients &K) {
  LensCoefficients Radial = K;
  for (const std::size_t Other : {2U, 3U, 8U, 9U, 10U, 11U})
    Radial[Other] = 0;
  return Radial;
}

/// Up to where the radial part grows without a pole.
double limit(const LensCoefficients &K) {
  const auto Grows = [&](double Angle) {
    const double R = std::tan(Angle), Q = R * R;
    return distortedRadius(lenses::OpenCv, K, R).D[0] > 0 &&
           1 + Q * (K[5] + Q * (K[6] + K[7] * Q)) > 0;
  };
  // Up to a slope of 10^4; the right angle itself has none.
  const double End = std::atan(1e4), Angle = firstFailure(End, Grows);
  return Angle < End ? std::tan(Angle)
                     : std::numeric_limits<double>::infinity();
}

} // namespace

const LensModel lenses::OpenCv =
    withEquation<Equation>({.Name = "FULL_OPENCV",
                            .HoldsSlopes = true,
                            .Limit = limit,
                            .Sees = seesInFront,
                            .RadialPart = radialPart});

} // namespace vorion::reference
