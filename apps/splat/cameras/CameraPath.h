/// Reads camera paths of nerfstudio's viewer.
#pragma once

#include "io/Cameras.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// Whether \p Document is an object with camera_path or keyframes.
bool isCameraPath(const nlohmann::json &Document);

/// The cameras of camera_path, one for each picture of the path: render_width,
/// render_height, and for each camera_to_world (16 numbers in row-major order,
/// x right, y up, z back) and fov (vertical, degrees). A path that was never
/// generated has only keyframes, which are returned instead; their key is
/// matrix, in row-major or column-major order, as numbers or as text.
/// camera_type is perspective (the default), fisheye (its pixels per radian are
/// the focal length of a pinhole with this fov) or equirectangular (without
/// fov). Errors: other camera types, poses other than a rotation and
/// translation.
Expected<std::vector<Camera>> parseCameraPath(const std::string &Where,
                                              const nlohmann::json &Document);

} // namespace vorion::splat
