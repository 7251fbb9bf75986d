#include "Projection.h"

#include "Footprint.h"
#include "Shutter.h"
#include "SphericalHarmonics.h"
#include "Unscented.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <type_traits>

namespace vorion::reference {
namespace {

/// z before it is rounded to Real, and the magnitudes of its terms.
struct ExactDepth {
  double Z, Magnitude;
};

template <typename Real>
ExactDepth exactDepth(const Camera<Real> &C, const Vec3<Real> &Mean) {
  ExactDepth D{0, 0};
  for (int K = 0; K < 3; ++K) {
    const double Term = (double(C.Rotation[K][2]) + double(C.DepthAxisLow[K])) *
                        double(Mean[K]);
    D.Z += Term;
    D.Magnitude += std::abs(Term);
  }
  const double Offset = double(C.Translation.z) + double(C.DepthOffsetLow);
  return {D.Z + Offset, D.Magnitude + std::abs(Offset)};
}

/// The distance from the camera, likewise.
template <typename Real>
ExactDepth exactDistance(const Camera<Real> &C, const Vec3<Real> &Mean) {
  double Squares = 0, Magnitude = 0;
  for (int K = 0; K < 3; ++K) {
    const double Centre = double(C.Centre[K]) + double(C.CentreLow[K]);
    const double D = double(Mean[K]) - Centre;
    Squares += D * D;
    Magnitude += std::abs(double(Mean[K])) + std::abs(Centre);
  }
  return {std::sqrt(Squares), Magnitude};
}

/// A Gaussian on the picture before dilation.
template <typename Real> struct Shape {
  Vec2<Real> Mean;       ///< pixels
  Vec3<Real> Covariance; ///< xx, xy, yy
  Real Determinant = 0;  ///< of that, without cancellation
};

template <typename Real> Shape<Real> shapeOf(const Footprint<Real> &F) {
  return {{},
          {dotFromLeft(F.X, F.X), dotFromLeft(F.X, F.Y), dotFromLeft(F.Y, F.Y)},
          sharpDeterminant(F)};
}

template <typename Real>
Shape<Real> shapeOf(const SevenPoints<Real> &S, const Camera<Real> &C) {
  Shape<Real> Sum{C.Focal * S.At + C.Principal + S.Shift, Vec3<Real>(0), 0};
  for (std::size_t N = 0; N < 7; ++N) {
    const auto &A = S.Off[N];
    Sum.Covariance += Vec3<Real>(A.x * A.x, A.x * A.y, A.y * A.y);
    for (std::size_t M = 0; M < N; ++M) {
      const Real Minor = S.Off[M].x * A.y - S.Off[M].y * A.x;
      Sum.Determinant += Minor * Minor;
    }
  }
  return Sum;
}

/// sqrt(2 ln(255 o)): standard deviations to the ellipse where alpha is 1/255.
/// \p Ratio, the opacity over the smallest alpha there, is at least 1.
template <typename Real> Real deviations(Real Ratio) {
  return std::sqrt(2 * std::max(Real(0), std::log(Ratio)));
}

template <typename Real> void setRadii(Splat<Real> &S, Rules Rule) {
  // mid^2 - det as a sum of squares, which cannot cancel in fp32.
  const Real Mid = (S.Covariance[0] + S.Covariance[2]) / 2;
  const Real Half = (S.Covariance[0] - S.Covariance[2]) / 2;
  const Real Spread = Half * Half + S.Covariance[1] * S.Covariance[1];
  const Real Lambda = Mid + std::sqrt(std::max(Real(0.1), Spread));
  S.CircleRadius = 3 * std::sqrt(Lambda);
  if (Rule == Rules::Inria) {
    S.Radius = glm::ivec2(
        static_cast<int>(std::min(std::ceil(S.CircleRadius), Real(1 << 30))));
    return;
  }
  const Real E = std::min(Real(3.33), deviations(255 * S.Opacity));
  for (int K = 0; K < 2; ++K)
    S.Radius[K] = static_cast<int>(
        std::min(std::ceil(E * std::sqrt(S.Covariance[2 * K])), Real(1 << 30)));
}

/// 255 o, or less under a higher cut-off; the kernels' order of operations.
template <typename Real> Real overLeastAlpha(Real Opacity, int Cutoff) {
  return Real(255) / Real(Cutoff) * Opacity;
}

template <typename Real>
Vec2<Real> extent(const Splat<Real> &S, const Options &O) {
  const Vec2<Real> Sigma(std::sqrt(S.Covariance[0]),
                         std::sqrt(S.Covariance[2]));
  switch (O.Reach) {
  case Support::Exact:
    return deviations(overLeastAlpha(S.Opacity, O.AlphaCutoff)) * Sigma;
  case Support::Box3:
    return Real(3) * Sigma;
  case Support::Square3:
  case Support::Official16:
    break;
  }
  return Vec2<Real>(std::ceil(S.CircleRadius));
}

} // namespace

template <typename Real>
Splat<Real> project(const Gaussians<Real> &G, std::size_t I,
                    const Camera<Real> &C, const Options &O) {
  Splat<Real> S;
  const Vec3<Real> FromCamera = (G.Means[I] - C.Centre) - C.CentreLow;
  Vec3<Real> P = multiply(C.Rotation, FromCamera);
  // Cameras of fixtures have a rotation to fp32's precision only, and are
  // meant by R and t.
  if constexpr (std::is_same_v<Real, double>)
    P = multiply(C.Rotation, G.Means[I]) + C.Translation;
  const Lens &L = C.Optics;
  const bool Straight = L.isPinhole() && !C.Shutter;
  const ExactDepth Exact =
      L.byDistance() ? exactDistance(C, G.Means[I]) : exactDepth(C, G.Means[I]);
  S.Depth = static_cast<Real>(Exact.Z);
  if (!L.byDistance())
    P.z = S.Depth;
  // Behind a shutter each mean has a near plane of its own, below. Its order is
  // the pose's, in which nothing behind the camera has a place.
  if (C.Shutter ? !(S.Depth > 0) : !inFront(S.Depth, O))
    return S;
  S.DepthSlack = 0x1p-44 * Exact.Magnitude;
  Mat3<Real> A = rotation(G.Quats[I]);
  for (int K = 0; K < 3; ++K)
    A[K] *= G.Scales[I][K];
  A = multiply(C.Rotation, A);
  Vec2<Real> At;
  LensRows<Real> Rows;
  glm::dmat2 Shear(1), FreeShear(1);
  if (C.Shutter) {
    ExposedPoint E;
    if (!expose(C, glm::dvec3(P), O.Rule, E) ||
        !inFront(L.byDistance() ? glm::length(E.P) : E.P.z, O))
      return S;
    At = Vec2<Real>(E.Place);
    Rows = {Vec3<Real>(E.Rows.X), Vec3<Real>(E.Rows.Y)};
    Shear = E.Shear;
    FreeShear = E.FreeShear;
  } else if (!Straight) {
    if (!placeThrough(L, P, At))
      return S;
    Rows = rowsThrough(C, P, O.Rule);
  }
  std::optional<Shape<Real>> Sharp;
  if (O.Through == Spread::Unscented)
    if (const auto Points = sevenPoints(P, A, C, O))
      Sharp = shapeOf(*Points, C);
  S.ByPoints = Sharp.has_value();
  if (!Sharp) {
    Sharp = shapeOf(Straight ? footprint(A, jacobian(P, C, O.Rule))
                             : footprint(A, Rows));
    Sharp->Mean = Straight ? Vec2<Real>(C.Focal.x * P.x / P.z + C.Principal.x,
                                        C.Focal.y * P.y / P.z + C.Principal.y)
                           : C.Focal * At + C.Principal;
  }
  S.Mean = Sharp->Mean;
  const Real H = static_cast<Real>(O.Dilation);
  const Real Sxx = Sharp->Covariance[0], Syy = Sharp->Covariance[2];
  const Real Det0 = Sharp->Determinant;
  // Points are held nowhere.
  if (S.ByPoints)
    Shear = FreeShear;
  // Round in a picture of one moment. Multiplied by 1 and 0, no bit changes.
  const glm::dmat2 Round = Shear * glm::transpose(Shear);
  const Vec3<Real> Kernel(Round[0].x, Round[0].y, Round[1].y);
  const Real Det = Det0 +
                   H * (Kernel[2] * Sxx + Kernel[0] * Syy -
                        2 * Kernel[1] * Sharp->Covariance[1]) +
                   H * H * static_cast<Real>(glm::determinant(Round));
  // Degenerate, or beyond what the precision can hold.
  if (!(Det > 0) || !std::isfinite(Det) || !std::isfinite(S.Mean.x) ||
      !std::isfinite(S.Mean.y))
    return S;
  S.Added = H * Kernel;
  S.Covariance = Sharp->Covariance + S.Added;
  const Real Inverse = 1 / Det;
  S.Conic = {S.Covariance[2] * Inverse, -S.Covariance[1] * Inverse,
             S.Covariance[0] * Inverse};

  if (O.Antialiased) {
    S.Compensation =
        std::sqrt(std::max(Real(LeastDeterminantRatio), Det0 / Det));
  }
  S.Opacity = G.Opacities[I] * S.Compensation;
  // No pixel can reach the smallest alpha: with the exact support there is no
  // box at all.
  if (O.Reach == Support::Exact &&
      !(overLeastAlpha(S.Opacity, O.AlphaCutoff) >= 1))
    return S;
  setRadii(S, O.Rule);
  S.Extent = extent(S, O);

  const int Coefficients = (G.ShDegree + 1) * (G.ShDegree + 1);
  S.Color = G.Colors.empty()
                ? shColor(&G.Sh[I * static_cast<std::size_t>(Coefficients)],
                          std::min(G.ShDegree, O.ShLimit), FromCamera)
                : G.Colors[I];
  S.Visible = true;
  return S;
}

template <typename Real>
std::vector<Splat<Real>> project(const Gaussians<Real> &G,
                                 const Camera<Real> &C, const Options &O) {
  std::vector<Splat<Real>> Splats;
  Splats.reserve(G.size());
  for (std::size_t I = 0; I < G.size(); ++I)
    Splats.push_back(project(G, I, C, O));
  if (C.Optics.Model->CoversSphere)
    for (const Real Turn : {Real(C.Width), -Real(C.Width)})
      for (std::size_t I = 0; I < G.size(); ++I) {
        Splats.push_back(Splats[I]);
        Splats.back().Mean.x += Turn;
      }
  return Splats;
}

template Splat<float> project(const Gaussians<float> &, std::size_t,
                              const Camera<float> &, const Options &);
template Splat<double> project(const Gaussians<double> &, std::size_t,
                               const Camera<double> &, const Options &);
template std::vector<Splat<float>>
project(const Gaussians<float> &, const Camera<float> &, const Options &);
template std::vector<Splat<double>>
project(const Gaussians<double> &, const Camera<double> &, const Options &);

} // namespace vorion::reference
