/// What commands that measure by many runs of `splat render` share.
#pragma once

#include "commands/CameraArguments.h"
#include "commands/SceneArguments.h"
#include "device/DeviceOptions.h"
#include "sweep/Origin.h"

#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The views to draw: all of the file, unless \p C names some. An Error of
/// usage, at \p File, where two of them would be kept as one file.
Expected<std::vector<Camera>>
sweptViews(CameraArguments C, const SceneArguments &S, const std::string &File);

/// What every run is made from: programs, machine and scene.
Expected<Origin> sweptOrigin(const SceneArguments &S,
                             const DeviceOptions &Machine);

/// A line about a run that is done, unless progress is hidden.
void sayOfSweep(std::string_view Line);

} // namespace vorion::splat
