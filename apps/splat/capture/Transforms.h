/// Views in transforms.json, as NeRF's synthetic scenes and later tools have
/// them.
#pragma once

#include "capture/Capture.h"
#include "io/Bytes.h"

#include <optional>

namespace vorion::splat {

/// A file of transforms. Poses are camera to world with x right, y up, z back
/// in the file; here x right, y down, z forward.
struct TransformsFile {
  std::vector<CaptureView> Views; ///< in the file's order; \c Picture is empty,
                                  ///< \c Mask as the file names it
  /// Horizontal field of view, radians, where the file gives it in place of
  /// sizes and focal lengths: the pictures decide those (\c setFieldOfView).
  std::optional<double> FieldOfView;
  std::string Points; ///< key ply_file_path, or empty
};

/// Reads keys fl_x, fl_y, cx, cy, w, h (of the file or of a frame) or
/// camera_angle_x, and frames with file_path and transform_matrix; k1 to k4, p1
/// and p2 with camera_model or is_fisheye; mask_path. Refused: camera models
/// that we have no lens for, poses that are no rotation and translation, files
/// without a frame.
Expected<TransformsFile> parseTransforms(const std::string &Where, Bytes File);

/// Completes \p C, whose width and height are the picture's.
void setFieldOfView(Camera &C, double Radians);

/// Reads points of a PLY with float x, y, z and uchar red, green, blue.
Expected<CapturePoints> parsePointCloud(const std::string &Where, Bytes File);

} // namespace vorion::splat
