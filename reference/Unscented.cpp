#include "Unscented.h"

#include "Shutter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace vorion::reference {
namespace {

/// Where \p C shows \p P, in units of the focal lengths, and how far in front
/// of the camera that is at the moment at which it is seen.
template <typename Real>
bool placeOf(const Camera<Real> &C, const Vec3<Real> &P, Vec2<Real> &At,
             double &Ahead) {
  Ahead = P.z;
  if (!C.Shutter)
    return placeThrough(C.Optics, P, At);
  ExposedPoint E;
  if (!expose(C, glm::dvec3(P), Rules::Inria, E))
    return false;
  At = Vec2<Real>(E.Place);
  Ahead = E.P.z;
  return true;
}

/// How far a point may be from the mean's place, in units of the focal lengths.
template <typename Real>
double mostSpread(const Camera<Real> &C, const Options &O) {
  // Parallel rays keep every ellipse one.
  if (C.Optics.Model->IsParallel)
    return std::numeric_limits<double>::infinity();
  return O.PointSpread * std::min(1.0, std::max(C.Width / double(C.Focal.x),
                                                C.Height / double(C.Focal.y)));
}

/// dL/d(point) from dL/d(place in pixels), of a point that the camera sees.
glm::dvec3 backThroughPlace(const Camera<double> &C, const glm::dvec3 &P,
                            const glm::dvec2 &By) {
  if (!C.Shutter)
    return backThrough(C, P, Rules::Inria, By, {glm::dvec3(0), glm::dvec3(0)});
  ExposedPoint E;
  expose(C, P, Rules::Inria, E);
  return By.x * E.Free.X + By.y * E.Free.Y;
}

} // namespace

template <typename Real>
std::optional<SevenPoints<Real>>
sevenPoints(const Vec3<Real> &Mean, const Mat3<Real> &Axes,
            const Camera<Real> &C, const Options &O) {
  SevenPoints<Real> S;
  double Depth = 0;
  if (!placeOf(C, Mean, S.At, Depth))
    return std::nullopt;
  const bool HasPlane =
      !C.Optics.Model->ByDistance && !C.Optics.Model->IsParallel;
  const double Most = mostSpread(C, O);
  Vec2<Real> Sum(0);
  for (std::size_t N = 0; N < 6; ++N) {
    const Vec3<Real> Step = std::sqrt(Real(3)) * Axes[static_cast<int>(N / 2)];
    S.Points[N] = N % 2 == 0 ? Mean + Step : Mean - Step;
    Vec2<Real> There;
    if (!placeOf(C, S.Points[N], There, Depth) ||
        (HasPlane && !inFront(static_cast<Real>(Depth), O)))
      return std::nullopt;
    const Vec2<Real> Way = placeDifference(C.Optics, There, S.At);
    if (!(double(glm::dot(Way, Way)) <= Most * Most))
      return std::nullopt;
    S.Off[N] = C.Focal * Way;
    Sum += S.Off[N];
  }
  S.Shift = Sum / Real(6);
  S.Off[6] = Vec2<Real>(0);
  for (std::size_t N = 0; N < 7; ++N)
    S.Off[N] = (S.Off[N] - S.Shift) * std::sqrt(N < 6 ? Real(1) / 6 : Real(2));
  return S;
}

BySevenPoints backThroughPoints(const SevenPoints<double> &S,
                                const glm::dvec3 &Mean, const Camera<double> &C,
                                const glm::dvec2 &ByMean2d,
                                const glm::dvec3 &ByCovariance) {
  const auto Weighed = [&](const glm::dvec2 &V) {
    return glm::dvec2(ByCovariance[0] * V.x + ByCovariance[1] * V.y,
                      ByCovariance[1] * V.x + ByCovariance[2] * V.y);
  };
  // The steps from the mean's place add up to 6 shifts, so that all but the
  // last one's part of the covariance does not depend on the shift.
  const glm::dvec2 OfShift = 4. * Weighed(S.Shift);
  BySevenPoints By{backThroughPlace(C, Mean, -OfShift), glm::dmat3(0)};
  for (std::size_t N = 0; N < 6; ++N) {
    const glm::dvec2 ByPlace =
        2 / std::sqrt(6.) * Weighed(S.Off[N]) + (ByMean2d + OfShift) / 6.;
    const glm::dvec3 ByPoint = backThroughPlace(C, S.Points[N], ByPlace);
    By.Mean += ByPoint;
    By.Axes[static_cast<int>(N / 2)] +=
        (N % 2 == 0 ? 1 : -1) * std::sqrt(3.) * ByPoint;
  }
  return By;
}

template std::optional<SevenPoints<float>> sevenPoints(const Vec3<float> &,
                                                       const Mat3<float> &,
                                                       const Camera<float> &,
                                                       const Options &);
template std::optional<SevenPoints<double>> sevenPoints(const Vec3<double> &,
                                                        const Mat3<double> &,
                                                        const Camera<double> &,
                                                        const Options &);

} // namespace vorion::reference
