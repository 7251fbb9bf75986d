#include "Projection.h"

#include "Footprint.h"
#include "SphericalHarmonics.h"

#include <algorithm>
#include <cmath>
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
  const ExactDepth Exact = exactDepth(C, G.Means[I]);
  P.z = static_cast<Real>(Exact.Z);
  // A NaN fails either test.
  const bool InFront =
      O.Rule == Rules::Inria ? P.z > Real(0.2) : P.z >= Real(0.01);
  if (!InFront)
    return S;
  S.Depth = P.z;
  S.DepthSlack = 0x1p-44 * Exact.Magnitude;
  S.Mean = {C.Focal.x * P.x / P.z + C.Principal.x,
            C.Focal.y * P.y / P.z + C.Principal.y};

  Mat3<Real> A = rotation(G.Quats[I]);
  for (int K = 0; K < 3; ++K)
    A[K] *= G.Scales[I][K];
  const Footprint<Real> F =
      footprint(multiply(C.Rotation, A), jacobian(P, C, O.Rule));
  const Real H = static_cast<Real>(O.Dilation);
  const Real Sxx = dotFromLeft(F.X, F.X), Syy = dotFromLeft(F.Y, F.Y);
  const Real Det0 = sharpDeterminant(F);
  const Real Det = Det0 + H * (Sxx + Syy) + H * H;
  // Degenerate, or beyond what the precision can hold.
  if (!(Det > 0) || !std::isfinite(Det) || !std::isfinite(S.Mean.x) ||
      !std::isfinite(S.Mean.y))
    return S;
  S.Covariance = {Sxx + H, dotFromLeft(F.X, F.Y), Syy + H};
  const Real Inverse = 1 / Det;
  S.Conic = {S.Covariance[2] * Inverse, -S.Covariance[1] * Inverse,
             S.Covariance[0] * Inverse};

  if (O.Antialiased) {
    const Real Floor = O.Rule == Rules::Inria ? Real(2.5e-5) : Real(0);
    S.Compensation = std::sqrt(std::max(Floor, Det0 / Det));
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
