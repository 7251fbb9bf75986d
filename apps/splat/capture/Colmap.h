/// COLMAP's sparse models, text and binary.
#pragma once

#include "capture/Capture.h"
#include "io/Bytes.h"

namespace vorion::splat {

/// The three files of a model, and the names by which errors call them.
struct ColmapFile {
  std::string Where;
  Bytes Content;
};
struct ColmapFiles {
  ColmapFile Cameras, Images, Points;
  /// Where only poses are wanted, \c Points is not looked at.
  bool PosesOnly = false;
};

/// A model: each view has its camera's intrinsics; pictures are not looked
/// for, and \c Picture is empty.
struct ColmapModel {
  std::vector<CaptureView> Views; ///< in the file's order
  CapturePoints Points;
};

/// Reads cameras.bin, images.bin, points3D.bin. Refused: camera models that
/// we have no lens for (by name), poses that are no rotation, images of unknown
/// cameras, values that are not finite, files that are shorter or longer than
/// they say, models without an image or a point.
Expected<ColmapModel> parseColmapBinary(const ColmapFiles &Files);

/// The same for cameras.txt, images.txt, points3D.txt; errors name the line.
Expected<ColmapModel> parseColmapText(const ColmapFiles &Files);

} // namespace vorion::splat
