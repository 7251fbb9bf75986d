/// How a camera maps directions to the picture (docs/cameras.md): the one place
/// of apps/splat/ that knows lenses, beside the kernels.
#pragma once

#include "io/RollingShutter.h"

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

/// Places of \c CameraModel::K for OpenCV's distortion, in its own order, and
/// then the term that OpenCV does not have: of r^8 above the fraction.
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
  LensS4,
  LensR8,
  LensCoefficientCount
};
/// The largest that is drawn: no product of a few of them is beyond fp32.
inline constexpr double MostLensCoefficient = 1e6;
using LensCoefficients = std::array<double, LensCoefficientCount>;
/// Their names in files, and how many of them a fisheye has: k1 to k4.
inline constexpr std::array<std::string_view, LensCoefficientCount> LensKeys{
    "k1", "k2", "p1", "p2", "k3", "k4", "k5",
    "k6", "s1", "s2", "s3", "s4", "r8"};
inline constexpr std::array<std::string_view, 4> FisheyeKeys{"k1", "k2", "k3",
                                                             "k4"};

struct CameraModel {
  LensModel Model = LensModel::Pinhole;
  /// OpenCV's order (LensCoefficient), or a fisheye's k1 to k4.
  LensCoefficients K{};
  /// Where the camera moves meanwhile.
  std::optional<RollingShutter> Shutter = std::nullopt;

  bool isPinhole() const { return Model == LensModel::Pinhole; }
  /// Where OpenCV's distortion or a fisheye shows what a pinhole shows at
  /// (\p X, \p Y), and a pinhole that place itself. In units of the focal
  /// lengths, from the principal point; of what is in front of the camera.
  std::array<double, 2> distorted(double X, double Y) const;
  /// Up to where \c distorted() is one to one: a radius before distortion.
  double reach() const;

  /// The names of those of K that the model has.
  std::span<const std::string_view> keys() const;
  /// Up to where the model is one to one: OpenCV's radius before distortion,
  /// the radial part alone, where it first turns back or has a pole; a
  /// fisheye's angle, at most pi. Infinity elsewhere.
  double limit() const;
  /// The radius before distortion that the radial part takes to \p Distorted:
  /// at most \c limit() and 1000.
  double undistorted(double Distorted) const;
  /// The direction of length 1, in the camera's axes, whose place is (\p X, \p
  /// Y) in units of the focal lengths; nothing if the lens shows nothing there.
  /// Not of equirectangular cameras, whose units those are not.
  std::optional<std::array<double, 3>> direction(double X, double Y) const;

  bool operator==(const CameraModel &) const = default;

private:
  /// Where the radial part alone shows \p R.
  double radius(double R) const;
};

/// A distortion that bends nothing is a pinhole.
CameraModel simplified(const CameraModel &M);

/// The model that files call \p Name, in any case of letters: COLMAP's,
/// nerfstudio's and gsplat's names of those that are here.
std::optional<LensModel> lensModelNamed(std::string_view Name);
/// Those names, for messages.
std::string_view knownLensModels();

} // namespace vorion::splat
