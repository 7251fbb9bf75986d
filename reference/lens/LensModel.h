/// A camera model of the reference: its equation, written down once, from which
/// the Jacobian and that one's derivatives come. Each has a file of its own
/// here, which shares nothing with the machine's.
#pragma once

#include "reference/lens/Dual.h"

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <string_view>

namespace vorion::reference {

/// In the order of the model's file; the rest is 0.
using LensCoefficients = std::array<double, 13>;

/// A point in the camera's axes, or its place in units of the focal lengths
/// from the principal point, of any kind of number.
template <typename T> using Point = std::array<T, 3>;
template <typename T> using Place = std::array<T, 2>;

/// \name What a record has where its model says nothing else
/// @{
inline double noLimit(const LensCoefficients & /*K*/) {
  return std::numeric_limits<double>::infinity();
}
inline bool seesAll(double /*Limit*/, const Point<double> & /*P*/) {
  return true;
}
/// In front of the camera, within the radius \p Limit before distortion.
inline bool seesInFront(double Limit, const Point<double> &P) {
  return P[2] > 0 && std::hypot(P[0], P[1]) < Limit * P[2];
}
inline LensCoefficients allRadial(const LensCoefficients &K) { return K; }
template <typename T> Point<T> notHeld(const Point<T> &P, int /*Height*/) {
  return P;
}
/// @}

struct LensModel {
  std::string_view Name; ///< COLMAP's where it has one

  /// \name Properties
  /// @{
  bool ByDistance = false;   ///< depth is the distance from the camera, not z
  bool IsParallel = false;   ///< its rays are parallel
  bool CoversSphere = false; ///< longitudes close at the picture's sides
  /// The Jacobian is held at slopes around those of the picture.
  bool HoldsSlopes = false;
  /// @}

  /// Up to where the model is one to one: a radius before distortion, or an
  /// angle from the axis.
  double (*Limit)(const LensCoefficients &K) = noLimit;
  /// Whether the camera sees \p P.
  bool (*Sees)(double Limit, const Point<double> &P) = seesAll;
  /// The coefficients of the part that depends on the radius alone.
  LensCoefficients (*RadialPart)(const LensCoefficients &K) = allRadial;
  /// What is seen at \p At; null where it is searched for.
  std::optional<glm::dvec3> (*Ray)(const LensCoefficients &K,
                                   const glm::dvec2 &At) = nullptr;

  /// \name The place of a point: without derivatives, with them, with theirs
  /// @{
  Place<double> (*At)(const LensCoefficients &,
                      const Point<double> &) = nullptr;
  Place<Dual<double>> (*AtWithRows)(const LensCoefficients &,
                                    const Point<Dual<double>> &) = nullptr;
  Place<Dual<Dual<double>>> (*AtWithCurvature)(
      const LensCoefficients &, const Point<Dual<Dual<double>>> &) = nullptr;
  /// @}

  /// \name The point at which the Jacobian is taken in a picture so high
  /// @{
  Point<double> (*Held)(const Point<double> &, int Height) = notHeld;
  Point<Dual<double>> (*HeldWithRows)(const Point<Dual<double>> &,
                                      int Height) = notHeld;
  /// @}
};

/// \p M with the place that \p Equation gives as its template `at`.
template <typename Equation> constexpr LensModel withEquation(LensModel M) {
  M.At = Equation::template at<double>;
  M.AtWithRows = Equation::template at<Dual<double>>;
  M.AtWithCurvature = Equation::template at<Dual<Dual<double>>>;
  return M;
}

inline Place<double> placeOf(const LensModel &M, const LensCoefficients &K,
                             const Point<double> &P) {
  return M.At(K, P);
}
inline Place<Dual<double>> placeOf(const LensModel &M,
                                   const LensCoefficients &K,
                                   const Point<Dual<double>> &P) {
  return M.AtWithRows(K, P);
}
inline Place<Dual<Dual<double>>> placeOf(const LensModel &M,
                                         const LensCoefficients &K,
                                         const Point<Dual<Dual<double>>> &P) {
  return M.AtWithCurvature(K, P);
}

/// The first of many equal steps from 0 to \p End after which \p Good is false,
/// halved until it stands still; \p End if there is none.
double firstFailure(double End, const std::function<bool(double)> &Good);

/// Where \p M shows a radius before distortion by its radial part, with the
/// derivative.
Dual<double> distortedRadius(const LensModel &M, const LensCoefficients &K,
                             double Radius);

namespace lenses {

#define VORION_LENS(Name) extern const LensModel Name;
#include "reference/lens/Lenses.def"

std::span<const LensModel *const> all();
} // namespace lenses

/// The one whose name is \p Name, or null.
const LensModel *lensModelNamed(std::string_view Name);

} // namespace vorion::reference
