#include "io/CameraModel.h"

#include "vorion/support/Letters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace vorion::splat {

namespace {

/// Coefficients from the constant one on.
using Polynomial = std::vector<double>;

/// For pictures' every pixel without memory of its own.
double at(std::span<const double> P, double X) {
  double Sum = 0;
  for (std::size_t I = P.size(); I-- > 0;)
    Sum = Sum * X + P[I];
  return Sum;
}

Polynomial derivative(const Polynomial &P) {
  Polynomial D;
  for (std::size_t I = 1; I < P.size(); ++I)
    D.push_back(static_cast<double>(I) * P[I]);
  return D;
}

Polynomial product(const Polynomial &A, const Polynomial &B) {
  Polynomial P(A.size() + B.size() - 1);
  for (std::size_t I = 0; I < A.size(); ++I)
    for (std::size_t J = 0; J < B.size(); ++J)
      P[I + J] += A[I] * B[J];
  return P;
}

/// Between \p Low, where \p Before is true, and \p High: from where on it is
/// false, to the last bit.
template <typename Predicate>
double border(double Low, double High, const Predicate &Before) {
  for (int K = 0; K < 200; ++K) {
    const double Middle = 0.5 * (Low + High);
    (Before(Middle) ? Low : High) = Middle;
  }
  return High;
}

/// Where \p P changes its sign between 0 and \p End, in order: between two
/// neighbouring ones of its derivative there is at most one.
std::vector<double> signChanges(const Polynomial &P, double End) {
  if (P.size() < 2)
    return {};
  std::vector<double> Borders = signChanges(derivative(P), End);
  Borders.push_back(End);
  std::vector<double> Found;
  double From = 0;
  for (const double To : Borders) {
    const double Low = std::exchange(From, To);
    const bool Rises = at(P, Low) < 0;
    if (Rises != (at(P, To) < 0))
      Found.push_back(
          border(Low, To, [&](double X) { return (at(P, X) < 0) == Rises; }));
  }
  return Found;
}

/// The radial part is r times their ratio, of r^2; a fisheye's is the angle
/// times the last one, of the angle's square.
std::array<double, 5> over(const LensCoefficients &K) {
  return {1, K[LensK1], K[LensK2], K[LensK3], K[LensR8]};
}
std::array<double, 4> under(const LensCoefficients &K) {
  return {1, K[LensK4], K[LensK5], K[LensK6]};
}
std::array<double, 5> ofAngle(const LensCoefficients &K) {
  return {1, K[0], K[1], K[2], K[3]};
}

/// How far from the middle a fisheye shows what is at \p Angle from the axis.
double fisheyePlace(const LensCoefficients &K, double Angle) {
  return Angle * at(ofAngle(K), Angle * Angle);
}

/// As one that can be derived and multiplied.
template <std::size_t Count>
Polynomial polynomial(const std::array<double, Count> &C) {
  return {C.begin(), C.end()};
}

/// Of r^2: no slope that a picture can see is beyond.
constexpr double MostSquared = 1e8;

double openCvLimit(const LensCoefficients &K) {
  // d(r N/D)/dr = ((N + 2 q N') D - 2 q N D') / D^2 with q = r^2.
  const Polynomial N = polynomial(over(K)), D = polynomial(under(K));
  const Polynomial TwoQ{0, 2};
  Polynomial Slope = product(N, D);
  const Polynomial Plus = product(product(TwoQ, derivative(N)), D);
  const Polynomial Minus = product(product(TwoQ, N), derivative(D));
  for (std::size_t I = 0; I < Slope.size(); ++I)
    Slope[I] += Plus[I] - Minus[I];
  double Least = std::numeric_limits<double>::infinity();
  for (const Polynomial &P : {Slope, D})
    if (const auto Zeros = signChanges(P, MostSquared); !Zeros.empty())
      Least = std::min(Least, std::sqrt(Zeros.front()));
  return Least;
}

double fisheyeLimit(const LensCoefficients &K) {
  const Polynomial Slope{1, 3 * K[0], 5 * K[1], 7 * K[2], 9 * K[3]};
  const auto Zeros = signChanges(Slope, M_PI * M_PI);
  return Zeros.empty() ? M_PI : std::sqrt(Zeros.front());
}

struct NamedModel {
  std::string_view Name;
  LensModel Model;
};
constexpr NamedModel Models[] = {
    {"pinhole", LensModel::Pinhole},
    {"simple_pinhole", LensModel::Pinhole},
    {"perspective", LensModel::Pinhole},
    {"opencv", LensModel::OpenCv},
    {"full_opencv", LensModel::OpenCv},
    {"simple_radial", LensModel::OpenCv},
    {"radial", LensModel::OpenCv},
    {"opencv_fisheye", LensModel::Fisheye},
    {"simple_radial_fisheye", LensModel::Fisheye},
    {"radial_fisheye", LensModel::Fisheye},
    {"fisheye", LensModel::Fisheye},
    {"orthographic", LensModel::Orthographic},
    {"orthophoto", LensModel::Orthographic},
    {"ortho", LensModel::Orthographic},
    {"equirectangular", LensModel::Equirectangular},
    {"spherical", LensModel::Equirectangular},
};

} // namespace

std::string_view name(LensModel M) {
  switch (M) {
  case LensModel::Pinhole:
    return "PINHOLE";
  case LensModel::OpenCv:
    return "FULL_OPENCV";
  case LensModel::Fisheye:
    return "OPENCV_FISHEYE";
  case LensModel::Orthographic:
    return "ORTHOGRAPHIC";
  case LensModel::Equirectangular:
    return "EQUIRECTANGULAR";
  }
  return {};
}

std::span<const std::string_view> CameraModel::keys() const {
  if (Model == LensModel::OpenCv)
    return LensKeys;
  if (Model == LensModel::Fisheye)
    return FisheyeKeys;
  return {};
}

double CameraModel::radius(double R) const {
  if (Model == LensModel::OpenCv)
    return R * at(over(K), R * R) / at(under(K), R * R);
  if (Model == LensModel::Fisheye)
    return fisheyePlace(K, std::atan(R));
  return R;
}

std::array<double, 2> CameraModel::distorted(double X, double Y) const {
  const double Squares = X * X + Y * Y;
  const double R = std::sqrt(Squares);
  const double Scale = R > 0 ? radius(R) / R : 1;
  if (Model != LensModel::OpenCv)
    return {X * Scale, Y * Scale};
  const double P1 = K[LensP1], P2 = K[LensP2];
  return {X * Scale + 2 * P1 * X * Y + P2 * (Squares + 2 * X * X) +
              Squares * (K[LensS1] + Squares * K[LensS2]),
          Y * Scale + P1 * (Squares + 2 * Y * Y) + 2 * P2 * X * Y +
              Squares * (K[LensS3] + Squares * K[LensS4])};
}

double CameraModel::reach() const {
  const double End = limit();
  if (Model != LensModel::Fisheye)
    return End;
  // What is beside the camera and behind it no pinhole shows.
  return End < M_PI / 2 ? std::tan(End)
                        : std::numeric_limits<double>::infinity();
}

double CameraModel::limit() const {
  if (Model == LensModel::OpenCv)
    return openCvLimit(K);
  if (Model == LensModel::Fisheye)
    return fisheyeLimit(K);
  return std::numeric_limits<double>::infinity();
}

double CameraModel::undistorted(double Distorted) const {
  return border(0, std::min(limit(), 1e3),
                [&](double R) { return radius(R) < Distorted; });
}

std::optional<std::array<double, 3>> CameraModel::direction(double X,
                                                            double Y) const {
  const auto Through = [](double A, double B) {
    const double Length = std::hypot(A, B, 1.0);
    return std::array{A / Length, B / Length, 1 / Length};
  };
  const double Distance = std::hypot(X, Y);
  switch (Model) {
  case LensModel::Orthographic:
    return std::array{0.0, 0.0, 1.0};
  case LensModel::Fisheye: {
    // The distorted angle grows up to the limit.
    if (!(Distance < fisheyePlace(K, limit())))
      return std::nullopt;
    const double Angle = border(
        0, limit(), [&](double A) { return fisheyePlace(K, A) < Distance; });
    const double Across = Distance > 0 ? std::sin(Angle) / Distance : 0;
    return std::array{X * Across, Y * Across, std::cos(Angle)};
  }
  case LensModel::OpenCv:
    break;
  default:
    return Through(X, Y);
  }
  // From the radial part's answer on by secants: the rest bends little.
  double A = X, B = Y;
  if (Distance > 0) {
    const double Scale = undistorted(Distance) / Distance;
    A *= Scale;
    B *= Scale;
  }
  constexpr double Step = 1e-6;
  for (int I = 0; I < 30; ++I) {
    const auto Here = distorted(A, B);
    const auto Right = distorted(A + Step, B), Down = distorted(A, B + Step);
    const double Xa = (Right[0] - Here[0]) / Step;
    const double Xb = (Down[0] - Here[0]) / Step;
    const double Ya = (Right[1] - Here[1]) / Step;
    const double Yb = (Down[1] - Here[1]) / Step;
    const double Det = Xa * Yb - Xb * Ya;
    A += (Yb * (X - Here[0]) - Xb * (Y - Here[1])) / Det;
    B += (Xa * (Y - Here[1]) - Ya * (X - Here[0])) / Det;
  }
  const auto Place = distorted(A, B);
  if (!(std::hypot(A, B) < limit()) ||
      !(std::hypot(Place[0] - X, Place[1] - Y) < 1e-9 * (1 + Distance)))
    return std::nullopt;
  return Through(A, B);
}

CameraModel simplified(const CameraModel &M) {
  const bool Bends = M.Model != LensModel::OpenCv ||
                     std::ranges::any_of(M.K, [](double K) { return K != 0; });
  return Bends ? M : CameraModel{LensModel::Pinhole, {}, M.Shutter};
}

std::optional<LensModel> lensModelNamed(std::string_view Name) {
  const std::string Lower = lowerCase(std::string(Name));
  const auto *const Found =
      std::ranges::find(Models, std::string_view(Lower), &NamedModel::Name);
  if (Found == std::ranges::end(Models))
    return std::nullopt;
  return Found->Model;
}

std::string_view knownLensModels() {
  return "PINHOLE, OPENCV, FULL_OPENCV, SIMPLE_RADIAL, RADIAL, OPENCV_FISHEYE, "
         "SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE, ORTHOGRAPHIC or "
         "EQUIRECTANGULAR";
}

} // namespace vorion::splat
