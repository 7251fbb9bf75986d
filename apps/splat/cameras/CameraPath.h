/// Camera paths as nerfstudio's viewer writes them.
#pragma once

#include "io/Cameras.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// Whether \p Document is an object with camera_path or keyframes.
bool isCameraPath(const nlohmann::json &Document);

/// The cameras of camera_path, one a picture of the path: render_width,
/// render_height, and for each camera_to_world (16 numbers by rows, x right, y
/// up, z back) and fov (vertical, degrees). A path that was never generated has
/// only keyframes, whose key is matrix, by rows or by columns, as numbers or as
/// text; they are given instead. camera_type is
/// perspective (also without the key), fisheye (fov gives its pixels a radian
/// as it gives a pinhole's focal length) or equirectangular (without fov).
/// Refused: other camera types, poses that are no rotation and translation.
Expected<std::vector<Camera>> parseCameraPath(const std::string &Where,
                                              const nlohmann::json &Document);

} // namespace vorion::splat
