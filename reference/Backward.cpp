#include "Backward.h"

#include "Footprint.h"
#include "Shutter.h"
#include "SphericalHarmonics.h"
#include "Unscented.h"
#include "Walk.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace vorion::reference {
namespace {

using glm::dmat3;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;

/// A tile's sums, by place in its list of candidates.
struct TileSums {
  std::vector<uint32_t> Gaussians;
  std::vector<SplatSums> Sums;
};

/// Adds what the pixel with contributions \p Seen, front to back, gives to the
/// sums of its tile. \p Behind: dL/d(final transmittance).
void pixelBackward(const std::vector<Candidate<double>> &List,
                   const std::vector<Contribution<double>> &Seen, double LastT,
                   const dvec3 &Gradient, double Behind, Rules Rule,
                   std::vector<SplatSums> &Sums) {
  dvec3 Accumulated(0); // colour of what lies behind
  for (std::size_t I = Seen.size(); I-- > 0;) {
    const Contribution<double> &C = Seen[I];
    const dvec3 &Color = List[C.Entry].Color;
    const double ByAlpha = C.T * glm::dot(Color - Accumulated, Gradient) -
                           LastT / (1 - C.Alpha) * Behind;
    Accumulated = C.Alpha * Color + (1 - C.Alpha) * Accumulated;
    SplatSums &Sum = Sums[C.Entry];
    Sum.Color += C.Alpha * C.T * Gradient;
    if (Rule == Rules::Gsplat && C.Wanted > mostAlpha<double>())
      continue;
    const double S = C.Wanted * ByAlpha;
    const double Dx = -C.Dx, Dy = -C.Dy;
    Sum +=
        {dvec3(0), S, S * dvec2(Dx, Dy), S * dvec3(Dx * Dx, Dx * Dy, Dy * Dy)};
  }
}

/// Half of dL/d(symmetric 2x2 matrix) as its entries xx, xy, yy.
using Symmetric = dvec3;

/// dL/d(covariance) from dL/d(conic), the conic's xy counted once.
Symmetric covarianceGradient(const dvec3 &K, const dvec3 &G) {
  // -K G K with G's off-diagonal halved.
  const double H = 0.5 * G[1];
  const double Xx = K[0] * G[0] + K[1] * H, Xy = K[0] * H + K[1] * G[2];
  const double Yx = K[1] * G[0] + K[2] * H, Yy = K[1] * H + K[2] * G[2];
  return -Symmetric(Xx * K[0] + Xy * K[1], Xx * K[1] + Xy * K[2],
                    Yx * K[1] + Yy * K[2]);
}

/// Derivatives of a symmetric matrix' determinant.
Symmetric adjugate(const dvec3 &M) { return {M[2], -M[1], M[0]}; }

/// dL/d(unit quaternion) along its tangent from dL/d(rotation matrix).
dvec4 quaternionGradient(const dvec4 &Q, const dmat3 &G) {
  const double W = Q[0], X = Q[1], Y = Q[2], Z = Q[3];
  // G[column][row], as GLM has it.
  const dvec4 D(2 * (X * (G[1][2] - G[2][1]) + Y * (G[2][0] - G[0][2]) +
                     Z * (G[0][1] - G[1][0])),
                2 * (Y * (G[0][1] + G[1][0]) + Z * (G[0][2] + G[2][0]) +
                     W * (G[1][2] - G[2][1])) -
                    4 * X * (G[1][1] + G[2][2]),
                2 * (X * (G[0][1] + G[1][0]) + Z * (G[1][2] + G[2][1]) +
                     W * (G[2][0] - G[0][2])) -
                    4 * Y * (G[0][0] + G[2][2]),
                2 * (X * (G[0][2] + G[2][0]) + Y * (G[1][2] + G[2][1]) +
                     W * (G[0][1] - G[1][0])) -
                    4 * Z * (G[0][0] + G[1][1]));
  return D - Q * glm::dot(Q, D);
}

/// The way back from one Gaussian's sums.
class ProjectionBackward {
public:
  ProjectionBackward(const Gaussians<double> &Input, const Camera<double> &View,
                     const Options &Settings, Gradients &Out)
      : Input(Input), View(View), Settings(Settings), Out(Out) {}

  void one(std::size_t I, const Splat<double> &S) {
    const SplatSums &Sum = Out.Sums[I];
    const dvec3 &K = S.Conic;
    Out.Means2d[I] = {K[0] * Sum.Sd.x + K[1] * Sum.Sd.y,
                      K[1] * Sum.Sd.x + K[2] * Sum.Sd.y};
    Out.Conics[I] = {-0.5 * Sum.Sdd[0], -Sum.Sdd[1], -0.5 * Sum.Sdd[2]};
    Out.Colors[I] = Sum.Color;
    // What is never blended may have an opacity of 0.
    const double ByOpacity = Sum.S == 0 ? 0 : Sum.S / S.Opacity;
    Out.Opacities[I] = ByOpacity * S.Compensation;

    // By the covariance before the dilation, and by the dilation.
    Symmetric V = covarianceGradient(K, Out.Conics[I]), W = V;
    if (Settings.Antialiased) {
      const double Det =
          S.Covariance[0] * S.Covariance[2] - S.Covariance[1] * S.Covariance[1];
      const double Ratio = S.Compensation * S.Compensation;
      if (Ratio > LeastDeterminantRatio) {
        // Of the ratio of the determinants before and after dilation.
        const double ByRatio =
            ByOpacity * Input.Opacities[I] / (2 * S.Compensation * Det);
        const Symmetric ByAfter = -ByRatio * Ratio * adjugate(S.Covariance);
        V += ByRatio * adjugate(S.Covariance - S.Added) + ByAfter;
        W += ByAfter;
      }
    }
    Out.Means[I] = shape(I, V, W);
    if (Input.Colors.empty())
      color(I);
  }

private:
  /// From dL/d(covariance) and dL/d(what dilation adds to it) to scales,
  /// rotation and, through the mean's place in the camera, the mean, which is
  /// returned.
  dvec3 shape(std::size_t I, const Symmetric &V, const Symmetric &W) {
    const dvec3 P = multiply(View.Rotation, Input.Means[I]) + View.Translation;
    const dmat3 Q = rotation(Input.Quats[I]);
    dmat3 A;
    for (int N = 0; N < 3; ++N)
      A[N] = multiply(View.Rotation, Q[N]) * Input.Scales[I][N];
    if (Settings.Through == Spread::Unscented)
      if (const auto Points = sevenPoints(P, A, View, Settings)) {
        const dvec3 ByMean = throughPoints(I, V, P, Q, *Points);
        return View.Shutter ? ByMean + throughDilation(P, W) : ByMean;
      }
    if (View.Shutter)
      return throughShutter(I, V, W, P, Q, A);
    if (!View.Optics.isPinhole())
      return throughLens(I, V, P, Q, A);
    const Jacobian<double> J = jacobian(P, View, Settings.Rule);
    const Footprint<double> F = footprint(A, J);
    const LensRows<double> ByRows =
        toAxes(I, V, F, {{J.XX, 0, J.XZ}, {0, J.YY, J.YZ}}, Q, A);

    const dvec2 &M = Out.Means2d[I];
    const double Z = P.z;
    const dvec3 ByPlace(View.Focal.x / Z * M.x, View.Focal.y / Z * M.y,
                        -(View.Focal.x * P.x * M.x + View.Focal.y * P.y * M.y) /
                            (Z * Z));
    return glm::transpose(View.Rotation) *
           (ByPlace +
            backThroughJacobian(J, Z, View.Focal, Settings.Rule, ByRows));
  }

  dvec3 throughPoints(std::size_t I, const Symmetric &V, const dvec3 &P,
                      const dmat3 &Q, const SevenPoints<double> &Points) {
    const BySevenPoints By =
        backThroughPoints(Points, P, View, Out.Means2d[I], V);
    const dmat3 Back = glm::transpose(View.Rotation);
    dmat3 ByRotation;
    for (int N = 0; N < 3; ++N) {
      const dvec3 InWorld = Back * By.Axes[N];
      Out.Scales[I][N] = glm::dot(Q[N], InWorld);
      ByRotation[N] = InWorld * Input.Scales[I][N];
    }
    Out.Quats[I] = quaternionGradient(Input.Quats[I], ByRotation);
    return Back * By.Mean;
  }

  /// Behind a shutter the mean's place says how the dilation is sheared.
  dvec3 throughDilation(const dvec3 &P, const Symmetric &W) {
    ExposedPoint E;
    expose(View, P, Settings.Rule, E);
    return glm::transpose(View.Rotation) *
           backThroughShutter(View, P, std::nullopt,
                              {{dvec3(0), dvec3(0)}, byShear(W, E.FreeShear)});
  }
  glm::dmat2 byShear(const Symmetric &W, const glm::dmat2 &Shear) const {
    return 2 * Settings.Dilation * glm::dmat2(W[0], W[1], W[1], W[2]) * Shear;
  }

  dvec3 throughShutter(std::size_t I, const Symmetric &V, const Symmetric &W,
                       const dvec3 &P, const dmat3 &Q, const dmat3 &A) {
    ExposedPoint E;
    expose(View, P, Settings.Rule, E);
    const LensRows<double> ByRows =
        toAxes(I, V, footprint(A, E.Rows), E.Rows, Q, A);
    const dvec2 &M = Out.Means2d[I];
    return glm::transpose(View.Rotation) *
           (M.x * E.Free.X + M.y * E.Free.Y +
            backThroughShutter(View, P, Settings.Rule,
                               {ByRows, byShear(W, E.Shear)}));
  }

  dvec3 throughLens(std::size_t I, const Symmetric &V, const dvec3 &P,
                    const dmat3 &Q, const dmat3 &A) {
    const LensRows<double> J = rowsThrough(View, P, Settings.Rule);
    const LensRows<double> ByRows = toAxes(I, V, footprint(A, J), J, Q, A);
    return glm::transpose(View.Rotation) *
           backThrough(View, P, Settings.Rule, Out.Means2d[I], ByRows);
  }

  /// From dL/d(covariance) to scales and rotation; returns dL/d(rows of the
  /// Jacobian).
  LensRows<double> toAxes(std::size_t I, const Symmetric &V,
                          const Footprint<double> &F, const LensRows<double> &J,
                          const dmat3 &Q, const dmat3 &A) {
    const dvec3 Gx = 2. * (V[0] * F.X + V[1] * F.Y);
    const dvec3 Gy = 2. * (V[1] * F.X + V[2] * F.Y);
    const dmat3 Back = glm::transpose(View.Rotation);
    dmat3 ByRotation;
    LensRows<double> ByRows{dvec3(0), dvec3(0)};
    for (int N = 0; N < 3; ++N) {
      const dvec3 InWorld = Back * (Gx[N] * J.X + Gy[N] * J.Y);
      Out.Scales[I][N] = glm::dot(Q[N], InWorld);
      ByRotation[N] = InWorld * Input.Scales[I][N];
      ByRows.X += Gx[N] * A[N];
      ByRows.Y += Gy[N] * A[N];
    }
    Out.Quats[I] = quaternionGradient(Input.Quats[I], ByRotation);
    return ByRows;
  }

  void color(std::size_t I) {
    const auto Bands = static_cast<std::size_t>(Input.ShDegree) + 1;
    const std::size_t Coefficients = Bands * Bands;
    Out.Means[I] += shBackward(
        &Input.Sh[I * Coefficients], std::min(Input.ShDegree, Settings.ShLimit),
        Input.Means[I] - View.Centre, Out.Colors[I], &Out.Sh[I * Coefficients]);
  }

  const Gaussians<double> &Input;
  const Camera<double> &View;
  const Options &Settings;
  Gradients &Out;
};

} // namespace

SplatSums &SplatSums::operator+=(const SplatSums &Other) {
  Color += Other.Color;
  S += Other.S;
  Sd += Other.Sd;
  Sdd += Other.Sdd;
  return *this;
}

std::vector<SplatSums> blendBackward(const std::vector<Splat<double>> &Splats,
                                     int Width, int Height, const Upstream &U,
                                     const Options &O,
                                     const Surface<double> *Surface) {
  const TileWalk<double> Walk(Splats, Width, Height, O);
  const dvec3 Background(O.Background[0], O.Background[1], O.Background[2]);
  std::vector<TileSums> Tiles(Walk.tiles());
  forEachTile(Walk.tiles(), O.Threads, [&](std::size_t Tile) {
    const auto List = Walk.candidates(Tile);
    TileSums &Own = Tiles[Tile];
    Own.Sums.resize(List.size());
    for (const auto &C : List)
      Own.Gaussians.push_back(static_cast<uint32_t>(C.Index));
    std::vector<Contribution<double>> Seen;
    const Rect Area = Walk.pixels(Tile);
    for (int Y = Area.Y0; Y < Area.Y1; ++Y)
      for (int X = Area.X0; X < Area.X1; ++X) {
        Seen.clear();
        const auto At =
            static_cast<std::size_t>(Y) * static_cast<std::size_t>(Width) +
            static_cast<std::size_t>(X);
        const bool IsCovered = Surface && std::isfinite(Surface->Depths[At]);
        const auto End = Walk.pixel(
            List, X, Y, [&](const auto &C) { Seen.push_back(C); },
            IsCovered ? hidingKeys(*Surface, At, O.DepthBits) : HidingKeys{});
        const double Behind =
            IsCovered ? glm::dot(Surface->Colors[At], U.Render[At])
                      : glm::dot(Background, U.Render[At]) - U.Alpha[At];
        pixelBackward(List, Seen, End.T, U.Render[At], Behind, O.Rule,
                      Own.Sums);
      }
  });
  std::vector<SplatSums> Sums(Splats.size());
  for (const TileSums &T : Tiles)
    for (std::size_t I = 0; I < T.Sums.size(); ++I)
      Sums[T.Gaussians[I]] += T.Sums[I];
  return Sums;
}

Gradients renderBackward(const Gaussians<double> &G, const Camera<double> &C,
                         const Upstream &U, const Options &O,
                         const Surface<double> *Behind) {
  const auto Splats = project(G, C, O);
  Gradients Out;
  Out.Sums = blendBackward(Splats, C.Width, C.Height, U, O, Behind);
  const std::size_t N = G.size();
  // What goes on behind a seam is the same Gaussian.
  for (std::size_t I = N; I < Splats.size(); ++I)
    Out.Sums[I % N] += Out.Sums[I];
  Out.Sums.resize(N);
  Out.Means2d.resize(N, dvec2(0));
  for (auto *V : {&Out.Conics, &Out.Means, &Out.Scales, &Out.Colors})
    V->resize(N, dvec3(0));
  Out.Quats.resize(N, dvec4(0));
  Out.Opacities.resize(N, 0);
  Out.Sh.resize(G.Colors.empty() ? G.Sh.size() : 0, dvec3(0));
  ProjectionBackward Back(G, C, O, Out);
  for (std::size_t I = 0; I < N; ++I)
    if (Splats[I].Visible)
      Back.one(I, Splats[I]);
  return Out;
}

} // namespace vorion::reference
