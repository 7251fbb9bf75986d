/// Lenses that bend straight lines, as OpenCV and COLMAP model them.
#pragma once

#include <array>

namespace vorion::splat {

/// From the place of a ray in a pinhole's picture, x / z and y / z, to the
/// place where the lens shows it. Places are in units of the focal length, from
/// the principal point.
struct Lens {
  enum class Model {
    Pinhole,          ///< shows it where it is
    RadialTangential, ///< OpenCV's: polynomials of r^2, and a tilt
    Fisheye           ///< OpenCV's: a polynomial of the angle to the axis
  };
  Model Kind = Model::Pinhole;
  /// Of r^2, r^4, r^6, r^8, or of the angle's: k1, k2, k3 (and a fisheye's k4).
  std::array<double, 4> Radial{};
  /// Of r^2, r^4, r^6 in the denominator: OpenCV's k4, k5, k6.
  std::array<double, 3> Denominator{};
  std::array<double, 2> Tangential{}; ///< p1, p2

  bool isPinhole() const { return Kind == Model::Pinhole; }
  /// Where the lens shows the ray of (\p X, \p Y).
  std::array<double, 2> distort(double X, double Y) const;
  /// Up to which r, at most \p Most, two rays of one direction from the axis
  /// have different places. Beyond it the polynomial folds back.
  double reach(double Most) const;

  bool operator==(const Lens &) const = default;

private:
  double radius(double R) const;
};

/// A lens that bends nothing is a pinhole.
Lens simplified(const Lens &L);

} // namespace vorion::splat
