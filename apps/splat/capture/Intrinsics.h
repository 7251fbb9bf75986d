/// Focal lengths and principal points of transforms.json.
#pragma once

#include "io/Cameras.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace vorion::splat {

/// Intrinsics of a camera whose picture size may be unknown.
struct Intrinsics {
  struct Axis {
    std::optional<double> Focal;  ///< pixels
    std::optional<double> Angle;  ///< field of view, radians; if Focal is
                                  ///< absent
    std::optional<double> Centre; ///< pixels
  };
  Axis X, Y;
  bool IsSphere = false; ///< full sphere, without focal length
};

/// The finite number \p Value of \p Key. The error has no location.
Expected<double> finiteNumber(const nlohmann::json &Value,
                              const std::string &Key);

/// Reads for each axis fl_x, camera_angle_x in radians, or x_fov in degrees,
/// and cx (fl_y and so on). Values of \p Frame override those of \p Document.
/// If one axis has no focal length, that of the other is used. The error has no
/// location.
Expected<Intrinsics> readIntrinsics(const nlohmann::json &Frame,
                                    const nlohmann::json &Document,
                                    bool IsSphere);

/// Completes \p C, whose width and height are set. Unknown principal points are
/// set to the centre.
void complete(Camera &C, const Intrinsics &I);

} // namespace vorion::splat
