/// Parsers of COLMAP's sparse models, text and binary.
#pragma once

#include "capture/Capture.h"
#include "io/Bytes.h"

namespace vorion::splat {

/// The three files of a model, with their names in errors.
struct ColmapFile {
  std::string Where;
  Bytes Content;
};
struct ColmapFiles {
  ColmapFile Cameras, Images, Points;
  /// Whether only poses are needed; \c Points is then ignored.
  bool PosesOnly = false;
};

/// A model. Each view has the intrinsics of its camera; \c Picture is empty.
struct ColmapModel {
  std::vector<CaptureView> Views; ///< in the file's order
  CapturePoints Points;
};

/// Parses cameras.bin, images.bin, points3D.bin. Errors: unsupported camera
/// models (by name), invalid rotations, images of unknown cameras, values that
/// are not finite, files whose length does not match their content, models
/// without an image.
Expected<ColmapModel> parseColmapBinary(const ColmapFiles &Files);

/// The same for cameras.txt, images.txt, points3D.txt; errors name the line.
Expected<ColmapModel> parseColmapText(const ColmapFiles &Files);

} // namespace vorion::splat
