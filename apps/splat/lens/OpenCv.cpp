// A pinhole with OpenCV's distortion: radial (a ratio of polynomials of r^2),
// tangential and of a thin prism.

#include "lens/Models.h"
#include "vorion/support/Polynomial.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorion::splat {

namespace {

constexpr std::string_view Names[] = {"OPENCV", "FULL_OPENCV", "SIMPLE_RADIAL",
                                      "RADIAL"};
constexpr ColmapLens Colmap[] = {{2, "SIMPLE_RADIAL", 1, 1},
                                 {3, "RADIAL", 1, 2},
                                 {4, "OPENCV", 2, 4},
                                 {6, "FULL_OPENCV", 2, 8}};

/// Places of the coefficients: OpenCV's own order, and then the term that
/// OpenCV does not have, of r^8 above the fraction.
enum : std::size_t { K1, K2, P1, P2, K3, K4, K5, K6, S1, S2, S3, S4, R8 };
constexpr std::string_view Keys[] = {"k1", "k2", "p1", "p2", "k3", "k4", "k5",
                                     "k6", "s1", "s2", "s3", "s4", "r8"};
// OpenCV's k4 is the first under the fraction, others' is of r^8 above it.
constexpr std::span Ambiguous(&Keys[K4], &Keys[R8]);

/// The radial part is r times their ratio, of r^2.
std::array<double, 5> over(const LensCoefficients &K) {
  return {1, K[K1], K[K2], K[K3], K[R8]};
}
std::array<double, 4> under(const LensCoefficients &K) {
  return {1, K[K4], K[K5], K[K6]};
}

/// Of r^2: no slope that a picture can see is beyond.
constexpr double MostSquared = 1e8;

/// Where the radial part first turns back or has a pole.
double limit(const LensCoefficients &K) {
  // d(r N/D)/dr = ((N + 2 q N') D - 2 q N D') / D^2 with q = r^2.
  const auto N = over(K);
  const auto D = under(K);
  const Polynomial TwoQ{0, 2};
  Polynomial Slope = product(N, D);
  const Polynomial Plus = product(product(TwoQ, derivative(N)), D);
  const Polynomial Minus = product(product(TwoQ, N), derivative(D));
  for (std::size_t I = 0; I < Slope.size(); ++I)
    Slope[I] += Plus[I] - Minus[I];
  double Least = std::numeric_limits<double>::infinity();
  for (const Polynomial &P : {Slope, Polynomial(D.begin(), D.end())})
    if (const auto Zeros = signChanges(P, MostSquared); !Zeros.empty())
      Least = std::min(Least, std::sqrt(Zeros.front()));
  return Least;
}

double radius(const LensCoefficients &K, double R) {
  return R * evaluate(over(K), R * R) / evaluate(under(K), R * R);
}

LensPlace distorted(const LensModel &Model, const LensCoefficients &K, double X,
                    double Y) {
  const double Squares = X * X + Y * Y;
  const auto [U, V] = distortedRadially(Model, K, X, Y);
  return {U + 2 * K[P1] * X * Y + K[P2] * (Squares + 2 * X * X) +
              Squares * (K[S1] + Squares * K[S2]),
          V + K[P1] * (Squares + 2 * Y * Y) + 2 * K[P2] * X * Y +
              Squares * (K[S3] + Squares * K[S4])};
}

/// By secants from the radial part's answer on: the rest bends little.
std::optional<Direction> rayAt(const LensCoefficients &K, double X, double Y) {
  const LensModel &Model = lenses::OpenCv;
  const double Distance = std::hypot(X, Y);
  double A = X, B = Y;
  if (Distance > 0) {
    const double Scale = undistortedRadius(Model, K, Distance) / Distance;
    A *= Scale;
    B *= Scale;
  }
  constexpr double Step = 1e-6;
  for (int I = 0; I < 30; ++I) {
    const auto Here = distorted(Model, K, A, B);
    const auto Right = distorted(Model, K, A + Step, B),
               Down = distorted(Model, K, A, B + Step);
    const double Xa = (Right[0] - Here[0]) / Step;
    const double Xb = (Down[0] - Here[0]) / Step;
    const double Ya = (Right[1] - Here[1]) / Step;
    const double Yb = (Down[1] - Here[1]) / Step;
    const double Det = Xa * Yb - Xb * Ya;
    A += (Yb * (X - Here[0]) - Xb * (Y - Here[1])) / Det;
    B += (Xa * (Y - Here[1]) - Ya * (X - Here[0])) / Det;
  }
  const auto Place = distorted(Model, K, A, B);
  if (!(std::hypot(A, B) < limit(K)) ||
      !(std::hypot(Place[0] - X, Place[1] - Y) < 1e-9 * (1 + Distance)))
    return std::nullopt;
  return directionTo(A, B);
}

} // namespace

const LensModel lenses::OpenCv{
    .Name = "FULL_OPENCV",
    .Names = Names,
    .Colmap = Colmap,
    .Keys = Keys,
    .AmbiguousKeys = Ambiguous,
    .KeyOfFourthTerm = Keys[R8],
    .HoldsSlopes = true,
    .IsDistortion = true,
    .EffectName = "opencv",
    .EffectText = "radial, tangential and thin prism distortion",
    .Macro = "USE_OPENCV",
    .Limit = limit,
    .Radius = radius,
    .Distorted = distorted,
    .Ray = rayAt};

} // namespace vorion::splat
