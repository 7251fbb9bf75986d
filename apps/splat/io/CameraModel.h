/// How a camera maps directions to the picture (docs/cameras.md).
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace vorion::splat {

enum class LensModel {
  Pinhole,
  OpenCv,  ///< a pinhole with OpenCV's distortion
  Fisheye, ///< OpenCV's, equidistant
  Orthographic,
  Equirectangular ///< the full sphere
};

/// As reports and cameras.json have it: COLMAP's names where it has one.
std::string_view name(LensModel M);

/// Places of \c CameraModel::K for OpenCV's distortion, in its own order.
enum LensCoefficient : std::size_t {
  LensK1,
  LensK2,
  LensP1,
  LensP2,
  LensK3,
  LensK4,
  LensK5,
  LensK6,
  LensS1,
  LensS2,
  LensS3,
  LensS4
};
/// Their names in files, and how many of them a fisheye has: k1 to k4.
inline constexpr std::array<std::string_view, 12> LensKeys{
    "k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4"};
inline constexpr std::array<std::string_view, 4> FisheyeKeys{"k1", "k2", "k3",
                                                             "k4"};

struct CameraModel {
  LensModel Model = LensModel::Pinhole;
  /// OpenCV's order (LensCoefficient), or a fisheye's k1 to k4.
  std::array<double, 12> K{};

  /// The names of those of K that the model has.
  std::span<const std::string_view> keys() const;
  /// Up to where the model is one to one: OpenCV's radius before distortion,
  /// the radial part alone, where it first turns back or has a pole; a
  /// fisheye's angle, at most pi. Infinity elsewhere.
  double limit() const;
  /// The radius before distortion that the radial part takes to \p Distorted:
  /// at most \c limit() and 1000.
  double undistorted(double Distorted) const;

  bool operator==(const CameraModel &) const = default;
};

/// The model that files call \p Name, in any case of letters: COLMAP's,
/// nerfstudio's and gsplat's names of those that are here.
std::optional<LensModel> lensModelNamed(std::string_view Name);
/// Those names, for messages.
std::string_view knownLensModels();

} // namespace vorion::splat
