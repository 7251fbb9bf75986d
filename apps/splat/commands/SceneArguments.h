/// What every subcommand that reads a scene takes.
#pragma once

#include "../io/SceneFile.h"

#include <CLI/CLI.hpp>
#include <string>

namespace vorion::splat {

struct SceneArguments {
  std::string Path;
  std::string Axes; ///< FROM:TO; empty: as the file has them
  ReadOptions Options;
};

/// Declares the scene and the options about reading it; \p A must outlive the
/// parsing.
void addSceneOptions(CLI::App &App, SceneArguments &A);

/// Reads the scene, in the axes that were asked for.
Expected<SceneFile> loadScene(const SceneArguments &A);

} // namespace vorion::splat
