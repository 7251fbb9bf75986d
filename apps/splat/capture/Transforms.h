/// Parser of transforms.json, the format of NeRF's synthetic scenes and later
/// tools.
#pragma once

#include "capture/Capture.h"
#include "capture/Intrinsics.h"
#include "io/Bytes.h"

namespace vorion::splat {

/// A view whose camera is incomplete until the size of its picture is known,
/// unless the file specifies it.
struct TransformsView : CaptureView {
  Intrinsics Known;
  bool hasSize() const { return Pose.Width != 0; }
};

/// The content of a transforms.json. Poses in the file are camera to world with
/// x right, y up, z back; here x right, y down, z forward.
struct TransformsFile {
  std::vector<TransformsView> Views; ///< in file order; \c Picture is empty, \c
                                     ///< Mask and \c HeldOut are as in the file
  std::string Points;                ///< value of ply_file_path, or empty
};

/// Reads, for the file and for each frame, w, h and the keys of
/// readIntrinsics() and readLens(); for each frame file_path, transform_matrix
/// and mask_path; and val_filenames and test_filenames. Errors: unsupported
/// camera models, poses other than a rotation and translation, files without a
/// frame.
Expected<TransformsFile> parseTransforms(const std::string &Where, Bytes File);

/// Reads points of a PLY with float x, y, z. Their colours are red, green, blue
/// (or diffuse_red and so on, or r, g, b) as bytes, words, or floats of 0 to 1,
/// those of Gaussians (f_dc_0 and so on), or grey if there are none.
Expected<CapturePoints> parsePointCloud(const std::string &Where, Bytes File);

} // namespace vorion::splat
