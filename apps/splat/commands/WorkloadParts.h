/// A workload in the making, and its scenes.
#pragma once

#include "commands/CameraArguments.h"
#include "commands/SceneArguments.h"
#include "explore/Workload.h"
#include "io/Cameras.h"
#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// Views that tasks read from a file.
struct ViewFile {
  std::string Path;
  std::vector<Camera> Views;
  bool IsSmall = false; ///< of small views
};

/// A workload, and what is to be written before anything is measured.
struct GivenWorkload {
  std::string Folder;   ///< for that and the results
  int SmallWidth = 480; ///< of small views at most, px
  Workload Does;
  std::vector<ViewFile> ViewFiles;
};

/// What a part is called, and how much it counts.
struct PartHead {
  std::string Name; ///< empty for the scene of a command line
  double Weight = 1;
};

/// Adds a scene; \p Where has its views.
Expected<Success> addScene(GivenWorkload &To, const PartHead &Head,
                           const SceneArguments &Scene,
                           const CameraArguments &Cameras,
                           const std::string &Where);

/// Has tasks measured once that are small already. Where all are, there are no
/// small ones: then all machines are judged whole.
void completeWorkload(GivenWorkload &W);

} // namespace vorion::splat
