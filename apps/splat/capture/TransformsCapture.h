// Captures with poses in transforms.json: those of instant-ngp and nerfstudio,
// and NeRF's synthetic scenes.
#pragma once

#include "capture/CaptureFiles.h"

namespace vorion::splat {

/// The set of views in a transforms file.
enum class ViewSet { All, Train, Test };

/// Adds the views of \p File. Sizes that it does not specify are those of the
/// pictures.
Expected<Success> readTransforms(const std::filesystem::path &File, ViewSet Set,
                                 const CaptureOptions &Options, Capture &C);

/// Adds the cameras of \p File; for a test set also those without a picture.
Expected<Success> addTransformsCameras(const std::filesystem::path &File,
                                       LensOf Of, CaptureCameras &To);

/// Adds \p File, and the files that it names, as far as it can be read.
void addTransformsFiles(const std::filesystem::path &File,
                        std::vector<std::filesystem::path> &To);

} // namespace vorion::splat
