/// Construction of a workload, and its scenes.
#pragma once

#include "commands/CameraArguments.h"
#include "commands/SceneArguments.h"
#include "explore/Workload.h"
#include "io/Cameras.h"
#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// A file of views that tasks read.
struct ViewFile {
  std::string Path;
  std::vector<Camera> Views;
  bool IsSmall = false; ///< whether it has small views
};

/// A workload, and the files to be written before measurements.
struct GivenWorkload {
  std::string Folder;   ///< for these files and the results
  int SmallWidth = 480; ///< maximum width of small views, px
  Workload Does;
  std::vector<ViewFile> ViewFiles;
};

/// Name and weight of a part.
struct PartHead {
  std::string Name; ///< empty for the scene on the command line
  double Weight = 1;
};

/// Adds a scene; \p Where names the source of its views.
Expected<Success> addScene(GivenWorkload &To, const PartHead &Head,
                           const SceneArguments &Scene,
                           const CameraArguments &Cameras,
                           const std::string &Where);

/// Merges small and full-size tasks that are equal. If all are equal, there are
/// no small tasks, and all machines are compared at full size.
void completeWorkload(GivenWorkload &W);

} // namespace vorion::splat
