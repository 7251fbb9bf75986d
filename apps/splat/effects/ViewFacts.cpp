#include "effects/ViewFacts.h"

#include "picture/View.h"

#include <algorithm>
#include <array>
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

/// Cosines of the angles between \p Ray and the axes that the quaternion \p Q
/// turns.
std::array<double, 3> cosinesOf(const float *Q,
                                const std::array<double, 3> &Ray) {
  const double W = Q[0], X = Q[1], Y = Q[2], Z = Q[3];
  const double Rows[3][3] = {
      {W * W + X * X - Y * Y - Z * Z, 2 * (X * Y + W * Z), 2 * (X * Z - W * Y)},
      {2 * (X * Y - W * Z), W * W - X * X + Y * Y - Z * Z, 2 * (Y * Z + W * X)},
      {2 * (X * Z + W * Y), 2 * (Y * Z - W * X),
       W * W - X * X - Y * Y + Z * Z}};
  const double Length =
      (W * W + X * X + Y * Y + Z * Z) * std::hypot(Ray[0], Ray[1], Ray[2]);
  std::array<double, 3> Cosines{};
  for (std::size_t N = 0; N < 3; ++N)
    for (std::size_t K = 0; K < 3; ++K)
      Cosines[N] += Rows[N][K] * Ray[K] / Length;
  return Cosines;
}

/// Whether Gaussian \p I, at depth \p Z, is a needle that points at the camera.
/// Its long axis is rounded in fp32, and the picture has that rounding although
/// it has little of the axis. It counts where the rounding is more of the
/// footprint's shorter half axis than \c Least, and more than a record loses of
/// such a footprint (docs/numerics.md).
bool isPointing(const Scene &S, std::size_t I, const splat_view &V, double Z,
                const RenderOptions &O) {
  constexpr double Least = 0x1p-13, AxisRounding = 0x1p-23,
                   RecordRounding = 0x1p-24;
  const bool IsParallel = O.Optics->IsParallel;
  const double Pixels =
      std::max(std::abs(double(V.focal[0])), std::abs(double(V.focal[1]))) /
      (IsParallel ? 1 : Z);
  std::array<double, 3> Squares{};
  for (std::size_t K = 0; K < 3; ++K)
    Squares[K] = std::exp(2 * double(S.LogScales[3 * I + K])) * Pixels * Pixels;
  const double Rounded = AxisRounding * std::sqrt(std::ranges::max(Squares));
  const double Added = double(O.Dilation);
  if (!(Rounded > Least * std::sqrt(Added)))
    return false;
  std::array<double, 3> Ray{V.rotation[6], V.rotation[7], V.rotation[8]};
  if (!IsParallel)
    for (std::size_t K = 0; K < 3; ++K)
      Ray[K] = double(S.Means[3 * I + K]) - V.position[K] - V.position_low[K];
  const auto C = cosinesOf(&S.Quats[4 * I], Ray);
  // Of the covariance across the ray: what its eigenvalues add up to, and their
  // product (Cauchy-Binet).
  double Sum = 0, Product = 0;
  for (std::size_t N = 0; N < 3; ++N) {
    const std::size_t Next = (N + 1) % 3;
    Sum += Squares[N] * (1 - C[N] * C[N]);
    Product += Squares[N] * Squares[Next] * C[3 - N - Next] * C[3 - N - Next];
  }
  const double Larger =
      Sum / 2 + std::sqrt(std::max(0.0, Sum * Sum / 4 - Product));
  const double Smaller = Larger > 0 ? Product / Larger : 0;
  const double Thickness = std::sqrt(Smaller + Added);
  return Rounded > Least * Thickness &&
         Rounded * Thickness > RecordRounding * (Larger + Added);
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

ViewFacts factsOfCamera(const splat_view &V) {
  ViewFacts F;
  F.IsCrop = isCrop(V);
  for (int A = 0; A < 2; ++A) {
    F.FocalLength = std::max(F.FocalLength, std::abs(double(V.focal[A])));
    F.Side = std::max(F.Side, V.size[A]);
  }
  return F;
}

ViewFacts factsOf(const Scene &S, const splat_view &V,
                  const RenderOptions &Options) {
  const double NearLimit = Options.nearLimit();
  const bool ByDistance = Options.byDistance();
  ViewFacts F = factsOfCamera(V);
  F.Reach = reachOf(S, V);
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
    for (int K = 0; K < 3; ++K)
      F.Farthest =
          std::max(F.Farthest, magnitude(double(P[K]) - double(V.position[K])));
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
      F.Pointing += Z > NearLimit && isPointing(S, I, V, Z, Options) ? 1 : 0;
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
  Both.FocalLength = std::max(A.FocalLength, B.FocalLength);
  Both.Side = std::max(A.Side, B.Side);
  Both.Pointing = std::max(A.Pointing, B.Pointing);
  Both.Farthest = std::max(A.Farthest, B.Farthest);
  return Both;
}

} // namespace vorion::splat
