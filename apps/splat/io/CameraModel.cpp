#include "io/CameraModel.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <vector>

namespace vorion::splat {

namespace {

/// Coefficients from the constant one on.
using Polynomial = std::vector<double>;

double at(const Polynomial &P, double X) {
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
    double Low = From, High = To;
    From = To;
    const bool Rises = at(P, Low) < 0;
    if (Rises == (at(P, High) < 0))
      continue;
    for (int K = 0; K < 200; ++K) {
      const double Middle = 0.5 * (Low + High);
      ((at(P, Middle) < 0) == Rises ? Low : High) = Middle;
    }
    Found.push_back(High);
  }
  return Found;
}

Polynomial over(const std::array<double, 12> &K) {
  return {1, K[LensK1], K[LensK2], K[LensK3]};
}
Polynomial under(const std::array<double, 12> &K) {
  return {1, K[LensK4], K[LensK5], K[LensK6]};
}

/// Of r^2: no slope that a picture can see is beyond.
constexpr double MostSquared = 1e8;

double openCvLimit(const std::array<double, 12> &K) {
  // d(r N/D)/dr = ((N + 2 q N') D - 2 q N D') / D^2 with q = r^2.
  const Polynomial N = over(K), D = under(K), TwoQ{0, 2};
  Polynomial Slope = product(N, D);
  Slope.resize(7);
  const Polynomial Plus = product(product(TwoQ, derivative(N)), D);
  const Polynomial Minus = product(product(TwoQ, N), derivative(D));
  for (std::size_t I = 0; I < 7; ++I)
    Slope[I] += Plus[I] - Minus[I];
  double Least = std::numeric_limits<double>::infinity();
  for (const Polynomial &P : {Slope, D})
    if (const auto Zeros = signChanges(P, MostSquared); !Zeros.empty())
      Least = std::min(Least, std::sqrt(Zeros.front()));
  return Least;
}

double fisheyeLimit(const std::array<double, 12> &K) {
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

double CameraModel::limit() const {
  if (Model == LensModel::OpenCv)
    return openCvLimit(K);
  if (Model == LensModel::Fisheye)
    return fisheyeLimit(K);
  return std::numeric_limits<double>::infinity();
}

double CameraModel::undistorted(double Distorted) const {
  double Low = 0, High = std::min(limit(), 1e3);
  const Polynomial N = over(K), D = under(K);
  for (int I = 0; I < 200; ++I) {
    const double R = 0.5 * (Low + High);
    (R * at(N, R * R) / at(D, R * R) < Distorted ? Low : High) = R;
  }
  return High;
}

std::optional<LensModel> lensModelNamed(std::string_view Name) {
  std::string Lower(Name);
  std::ranges::transform(Lower, Lower.begin(), [](unsigned char C) {
    return static_cast<char>(std::tolower(C));
  });
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
