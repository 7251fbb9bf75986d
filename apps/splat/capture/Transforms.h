/// Views in transforms.json, as NeRF's synthetic scenes and later tools have
/// them.
#pragma once

#include "capture/Capture.h"
#include "capture/Intrinsics.h"
#include "io/Bytes.h"

namespace vorion::splat {

/// A view whose camera is not complete before its picture's size is known,
/// unless the file has it.
struct TransformsView : CaptureView {
  Intrinsics Known;
  bool hasSize() const { return Pose.Width != 0; }
};

/// A file of transforms. Poses are camera to world with x right, y up, z back
/// in the file; here x right, y down, z forward.
struct TransformsFile {
  std::vector<TransformsView> Views; ///< in the file's order; \c Picture is
                                     ///< empty, \c Mask as the file names it,
                                     ///< \c HeldOut as its lists say
  std::string Points;                ///< key ply_file_path, or empty
};

/// Reads w, h and what readIntrinsics() and readLens() do, of the file or of a
/// frame, and frames with file_path and transform_matrix; mask_path;
/// val_filenames and test_filenames. Refused: camera models that we have no
/// lens for, poses that are no rotation and translation, files without a frame.
Expected<TransformsFile> parseTransforms(const std::string &Where, Bytes File);

/// Reads points of a PLY with float x, y, z and uchar red, green, blue.
Expected<CapturePoints> parsePointCloud(const std::string &Where, Bytes File);

} // namespace vorion::splat
