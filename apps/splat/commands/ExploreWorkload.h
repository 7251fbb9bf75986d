/// What `splat explore` tries machines on: a scene of the command line, or a
/// workload's file.
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

  /// What the folder of the results is named after.
  const std::string &input() const { return File.empty() ? Scene.Path : File; }
};

/// Declares --workload and --small-width, and what a scene of the command line
/// and one of a workload take. \p A must outlive the parsing.
void addWorkloadOptions(CLI::App &App, WorkloadArguments &A);

/// What \p A asks for; results go to \p Folder. There is a scene or a file.
Expected<GivenWorkload> workloadOf(const WorkloadArguments &A,
                                   const std::string &Folder);

} // namespace vorion::splat
