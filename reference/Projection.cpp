#include "Projection.h"

#include "SphericalHarmonics.h"

#include <algorithm>
#include <cmath>

namespace vorion::reference {
namespace {

template <typename Real> using Vec2 = glm::vec<2, Real>;
template <typename Real> using Vec3 = glm::vec<3, Real>;
template <typename Real> using Mat3 = glm::mat<3, 3, Real>;

/// M v and A B with sums from the left; GLM would do the same, but here the
/// order is a promise.
template <typename Real>
Vec3<Real> multiply(const Mat3<Real> &M, const Vec3<Real> &V) {
  Vec3<Real> R;
  for (int I = 0; I < 3; ++I)
    R[I] = M[0][I] * V[0] + M[1][I] * V[1] + M[2][I] * V[2];
  return R;
}

template <typename Real>
Mat3<Real> multiply(const Mat3<Real> &A, const Mat3<Real> &B) {
  Mat3<Real> R;
  for (int J = 0; J < 3; ++J)
    R[J] = multiply(A, B[J]);
  return R;
}

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

/// The rotation of a unit quaternion (w, x, y, z); none for the zero one.
template <typename Real> Mat3<Real> rotation(const glm::vec<4, Real> &Q) {
  const Real W = Q[0], X = Q[1], Y = Q[2], Z = Q[3];
  // GLM's constructor takes columns.
  return Mat3<Real>(
      1 - 2 * (Y * Y + Z * Z), 2 * (X * Y + W * Z), 2 * (X * Z - W * Y),
      2 * (X * Y - W * Z), 1 - 2 * (X * X + Z * Z), 2 * (Y * Z + W * X),
      2 * (X * Z + W * Y), 2 * (Y * Z - W * X), 1 - 2 * (X * X + Y * Y));
}

/// Bounds of x/z or y/z in the Jacobian: lower, upper. Beyond the frame the
/// affine approximation blows up, so it is taken at the bound.
template <typename Real>
Vec2<Real> slopeLimits(Rules Rule, Real Size, Real Focal, Real Principal) {
  const Real Half = Size / (2 * Focal); // tan(fov / 2)
  if (Rule == Rules::Inria)
    return {Real(-1.3) * Half, Real(1.3) * Half};
  return {-(Principal / Focal + Real(0.3) * Half),
          (Size - Principal) / Focal + Real(0.3) * Half};
}

/// The rows of J A.
template <typename Real> struct Footprint {
  Vec3<Real> X, Y;
};

template <typename Real>
Footprint<Real> footprint(const Mat3<Real> &A, const Vec3<Real> &P,
                          const Camera<Real> &C, Rules Rule) {
  const Vec2<Real> LimX =
      slopeLimits(Rule, Real(C.Width), C.Focal.x, C.Principal.x);
  const Vec2<Real> LimY =
      slopeLimits(Rule, Real(C.Height), C.Focal.y, C.Principal.y);
  const Real Tx = std::clamp(P.x / P.z, LimX[0], LimX[1]) * P.z;
  const Real Ty = std::clamp(P.y / P.z, LimY[0], LimY[1]) * P.z;
  const Real ZZ = P.z * P.z;
  const Real J00 = C.Focal.x / P.z, J02 = -(C.Focal.x * Tx) / ZZ;
  const Real J11 = C.Focal.y / P.z, J12 = -(C.Focal.y * Ty) / ZZ;
  Footprint<Real> F;
  for (int K = 0; K < 3; ++K) {
    F.X[K] = J00 * A[K][0] + J02 * A[K][2];
    F.Y[K] = J11 * A[K][1] + J12 * A[K][2];
  }
  return F;
}

template <typename Real>
Real dotFromLeft(const Vec3<Real> &A, const Vec3<Real> &B) {
  return A[0] * B[0] + A[1] * B[1] + A[2] * B[2];
}

/// The determinant of the covariance before dilation.
template <typename Real> Real sharpDeterminant(const Footprint<Real> &F) {
  const Real M01 = F.X[0] * F.Y[1] - F.X[1] * F.Y[0];
  const Real M02 = F.X[0] * F.Y[2] - F.X[2] * F.Y[0];
  const Real M12 = F.X[1] * F.Y[2] - F.X[2] * F.Y[1];
  return M01 * M01 + M02 * M02 + M12 * M12;
}

/// sqrt(2 ln(255 o)): standard deviations to the ellipse where alpha is 1/255.
/// \p Opacity is at least 1/255.
template <typename Real> Real deviations(Real Opacity) {
  return std::sqrt(2 * std::max(Real(0), std::log(255 * Opacity)));
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
  const Real E = std::min(Real(3.33), deviations(S.Opacity));
  for (int K = 0; K < 2; ++K)
    S.Radius[K] = static_cast<int>(
        std::min(std::ceil(E * std::sqrt(S.Covariance[2 * K])), Real(1 << 30)));
}

template <typename Real>
Vec2<Real> extent(const Splat<Real> &S, Support Reach) {
  const Vec2<Real> Sigma(std::sqrt(S.Covariance[0]),
                         std::sqrt(S.Covariance[2]));
  switch (Reach) {
  case Support::Exact:
    return deviations(S.Opacity) * Sigma;
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
  Vec3<Real> P = multiply(C.Rotation, G.Means[I]) + C.Translation;
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
  const Footprint<Real> F = footprint(multiply(C.Rotation, A), P, C, O.Rule);
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
  // No pixel can reach 1/255: with the exact support there is no box at all.
  if (O.Reach == Support::Exact && !(255 * S.Opacity >= 1))
    return S;
  setRadii(S, O.Rule);
  S.Extent = extent(S, O.Reach);

  const int Coefficients = (G.ShDegree + 1) * (G.ShDegree + 1);
  S.Color = G.Colors.empty()
                ? shColor(&G.Sh[I * static_cast<std::size_t>(Coefficients)],
                          G.ShDegree, G.Means[I] - C.Centre)
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
