/// The workload of `splat explore`: a scene on the command line, or a workload
/// file.
#pragma once

#include "commands/CameraArguments.h"
#include "commands/SceneArguments.h"
#include "commands/WorkloadParts.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <string>

namespace vorion::splat {

struct WorkloadArguments {
  std::string File; ///< empty: the scene
  SceneArguments Scene;
  CameraArguments Cameras;
  int SmallWidth = 480; ///< px

  /// The file after which the folder of the results is named.
  const std::string &input() const { return File.empty() ? Scene.Path : File; }
};

/// Declares --workload and --small-width, and the options of a scene. \p A must
/// outlive the parsing.
void addWorkloadOptions(CLI::App &App, WorkloadArguments &A);

/// The workload of \p A, which has a scene or a file. Results are written to \p
/// Folder.
Expected<GivenWorkload> workloadOf(const WorkloadArguments &A,
                                   const std::string &Folder);

} // namespace vorion::splat
