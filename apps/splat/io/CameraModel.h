/// The lens and the shutter of a camera.
#pragma once

#include "io/RollingShutter.h"
#include "lens/Lenses.h"

#include <optional>

namespace vorion::splat {

struct CameraModel {
  const LensModel *Model = &lenses::Pinhole;
  /// In the order of the model's record, padded with 0.
  LensCoefficients K{};
  /// If the camera moves during the exposure.
  std::optional<RollingShutter> Shutter = std::nullopt;

  bool isPinhole() const { return Model->isPinhole(); }
  /// Maps the position (\p X, \p Y) of a pinhole, in front of the camera,
  /// through the lens.
  LensPlace distorted(double X, double Y) const {
    return Model->Distorted(*Model, K, X, Y);
  }
  /// The radius before distortion up to which \c distorted() is one-to-one.
  double reach() const { return Model->Reach(limit()); }
  /// The limit up to which the model is one-to-one.
  double limit() const { return Model->Limit(K); }
  /// The inverse of the radial part at \p Distorted, at most \c limit() and
  /// 1000.
  double undistorted(double Distorted) const {
    return undistortedRadius(*Model, K, Distorted);
  }
  /// The direction of the position (\p X, \p Y); empty if it is outside the
  /// projection.
  std::optional<Direction> direction(double X, double Y) const {
    return Model->Ray(K, X, Y);
  }

  bool operator==(const CameraModel &) const = default;
};

/// A distortion whose coefficients are all 0 is a pinhole.
CameraModel simplified(const CameraModel &M);

} // namespace vorion::splat
