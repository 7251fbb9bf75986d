// Captures whose poses are in files of transforms: those of instant-ngp and
// nerfstudio, and NeRF's synthetic ones.
#pragma once

#include "capture/CaptureFiles.h"

namespace vorion::splat {

/// Which set of a capture a file of transforms has.
enum class ViewSet { All, Train, Test };

/// Adds the views of \p File; those without a size get their picture's.
Expected<Success> readTransforms(const std::filesystem::path &File, ViewSet Set,
                                 const CaptureOptions &Options, Capture &C);

/// Adds the cameras of \p File; of a test set those without a picture, too.
Expected<Success> addTransformsCameras(const std::filesystem::path &File,
                                       LensOf Of, CaptureCameras &To);

/// Adds \p File, and what it names as far as it can be read.
void addTransformsFiles(const std::filesystem::path &File,
                        std::vector<std::filesystem::path> &To);

} // namespace vorion::splat
