// Captures with COLMAP models.
#pragma once

#include "capture/CaptureFiles.h"

namespace vorion::splat {

/// Adds the views and points of the model at \p F.
Expected<Success> readColmap(const Location &F, const CaptureOptions &Options,
                             Capture &C);

/// Adds only its cameras.
Expected<Success> addColmapCameras(const Location &F, LensOf Of,
                                   CaptureCameras &To);

/// Adds its files, and the files that these name, as far as they can be read.
void addColmapFiles(const Location &F, std::vector<std::filesystem::path> &To);

} // namespace vorion::splat
