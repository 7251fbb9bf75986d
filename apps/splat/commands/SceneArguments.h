/// Options of all subcommands that read a scene.
#pragma once

#include "scene/Axes.h"
#include "scene/SceneFile.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace vorion::splat {

struct SceneArguments {
  std::string Path;
  std::string Axes; ///< FROM:TO; empty: those of the file
  ReadOptions Options;
  bool KeepsMeshes = false; ///< no warning that meshes beside it are ignored
};

/// Declares the scene and its options; \p A must outlive the parsing.
void addSceneOptions(CLI::App &App, SceneArguments &A);

/// Reads the scene in the requested axes, and prints what was skipped. If \p
/// Meanwhile is given, another thread reads the scene while this thread
/// executes \p Meanwhile. \p Meanwhile must not print. It may change the
/// environment, which the reader does not use.
Expected<SceneFile> loadScene(const SceneArguments &A,
                              const std::function<void()> &Meanwhile = {});

/// The change of \p A, none if there is none.
Expected<AxesChange> axesChangeOf(const SceneArguments &A);

/// The options of \p A as command-line arguments, without the scene.
std::vector<std::string> wordsOf(const SceneArguments &A);

} // namespace vorion::splat
