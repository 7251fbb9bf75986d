#include "effects/ViewFacts.h"

#include "picture/View.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorion::splat {

namespace {

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Of the kernels' camera coordinates, a few fp32 roundings of terms as large
/// as their inputs: 8 units in the last place.
constexpr double CoordinateError = 8.0 / (1 << 24);
/// Of their depth, two floats rounded once (kernels/camera_depth.cl).
constexpr double DepthError = 1e-9;
constexpr double DepthRounding = 1.0 / (1 << 24);

struct Axis {
  double X, Y, Z, Offset;
  double operator()(const float *P) const {
    return X * P[0] + Y * P[1] + Z * P[2] + Offset;
  }
};

/// Row \p Row of the view's rotation, from the camera's centre.
Axis axisOf(const splat_view &V, int Row) {
  Axis A{V.rotation[3 * Row], V.rotation[3 * Row + 1], V.rotation[3 * Row + 2],
         0};
  for (int K = 0; K < 3; ++K)
    A.Offset -= double(V.rotation[3 * Row + K]) *
                (double(V.position[K]) + V.position_low[K]);
  return A;
}

/// Infinity for a NaN, so that it exceeds every bound.
double magnitude(double V) { return std::isnan(V) ? Infinity : std::abs(V); }

/// What rounding the depth and the quotient may move a comparison of x with
/// Limit * Z, with as much again.
double rounding(double Limit, double Z) {
  return 4 * DepthRounding * (1 + std::abs(Limit)) * std::abs(Z);
}

double distanceOf(const splat_view &V, const float *P) {
  double Squares = 0;
  for (int K = 0; K < 3; ++K) {
    const double D = double(P[K]) - V.position[K] - V.position_low[K];
    Squares += D * D;
  }
  return std::sqrt(Squares);
}

/// Whether a pinhole shows in \p V what is \p Across its axis at depth \p Z.
bool isShown(const splat_view &V, const double *Across, double Z) {
  for (int A = 0; A < 2; ++A) {
    const double At = double(V.focal[A]) * Across[A] / Z + double(V.center[A]);
    if (std::isfinite(V.ratio_high[A]) && !(At >= 0 && At <= V.size[A]))
      return false;
  }
  return true;
}

double reachOf(const Scene &S, const splat_view &V) {
  double Reach = 0;
  for (const float M : S.Means)
    Reach = std::max(Reach, magnitude(M));
  for (const float P : V.position)
    Reach = std::max(Reach, magnitude(P));
  return Reach;
}

void noteLogits(const Scene &S, ViewFacts &F) {
  F.LeastLogit = std::numeric_limits<float>::infinity();
  F.MostLogit = -F.LeastLogit;
  bool Nan = false;
  for (const float L : S.OpacityLogits) {
    F.LeastLogit = std::min(F.LeastLogit, L);
    F.MostLogit = std::max(F.MostLogit, L);
    Nan |= std::isnan(L);
  }
  if (Nan) {
    F.MostLogit = std::numeric_limits<float>::infinity();
    F.LeastLogit = -F.MostLogit;
  }
}

/// The first Gaussian with a coefficient of \p Band that is not zero: a NaN is
/// not, -0 is.
std::size_t bandWitness(const Scene &S, int Band) {
  if (Band > S.ShDegree)
    return ViewFacts::NoWitness;
  const std::size_t Stride = 3 * S.coefficients();
  const std::size_t First = 3 * shCoefficients(Band - 1);
  const std::size_t Last = 3 * shCoefficients(Band);
  for (std::size_t I = 0; I < S.size(); ++I) {
    const float *Row = &S.Sh[I * Stride];
    if (!std::all_of(Row + First, Row + Last, [](float V) { return V == 0; }))
      return I;
  }
  return ViewFacts::NoWitness;
}

} // namespace

ViewFacts factsOf(const Scene &S, const splat_view &V, double NearLimit,
                  bool ByDistance) {
  ViewFacts F;
  F.Reach = reachOf(S, V);
  F.IsCrop = isCrop(V);
  noteLogits(S, F);
  for (int Band = 1; Band <= MaxShDegree; ++Band)
    F.BandWitness[static_cast<std::size_t>(Band - 1)] = bandWitness(S, Band);

  const Axis Depth{double(V.depth_axis[0]) + V.depth_axis_low[0],
                   double(V.depth_axis[1]) + V.depth_axis_low[1],
                   double(V.depth_axis[2]) + V.depth_axis_low[2],
                   double(V.depth_offset[0]) + V.depth_offset[1]};
  const Axis Across[2] = {axisOf(V, 0), axisOf(V, 1)};
  const double Error = 4 * F.Reach * CoordinateError;
  F.NearestDepth = Infinity;
  for (std::size_t I = 0; I < S.size(); ++I) {
    const float *P = &S.Means[3 * I];
    const double Z = ByDistance ? distanceOf(V, P) : Depth(P);
    F.NearestDepth = std::min(F.NearestDepth, Z);
    bool Inside = true;
    const double Beside[2] = {Across[0](P), Across[1](P)};
    for (int A = 0; A < 2; ++A) {
      const double At = Beside[A];
      const double Low = V.ratio_low[A], High = V.ratio_high[A];
      Inside = Inside && At > Low * Z + Error + rounding(Low, Z) &&
               At < High * Z - Error - rounding(High, Z);
    }
    if (Z >= NearLimit / 2)
      F.BeyondField += Inside ? 0 : 1;
    if (Z > 0 && isShown(V, Beside, Z)) {
      ++F.InView;
      F.BeforeNear += Z > NearLimit ? 0 : 1;
    }
  }
  F.DepthSlack =
      2 * DepthRounding * std::abs(F.NearestDepth) + DepthError * F.Reach;
  if (F.Reach == Infinity) {
    F.NearestDepth = -Infinity;
    F.BeyondField = S.size();
  }
  return F;
}

ViewFacts combined(const ViewFacts &A, const ViewFacts &B) {
  const double NearestA = A.NearestDepth - A.DepthSlack;
  const double NearestB = B.NearestDepth - B.DepthSlack;
  // A NaN decides, as it does alone.
  ViewFacts Both = std::isnan(NearestA) || NearestA <= NearestB ? A : B;
  const ViewFacts &Nearer = double(A.BeforeNear) * double(B.InView) <
                                    double(B.BeforeNear) * double(A.InView)
                                ? B
                                : A;
  Both.InView = Nearer.InView;
  Both.BeforeNear = Nearer.BeforeNear;
  Both.BeyondField = std::max(A.BeyondField, B.BeyondField);
  Both.Reach = std::max(A.Reach, B.Reach);
  Both.IsCrop = A.IsCrop || B.IsCrop;
  return Both;
}

} // namespace vorion::splat
