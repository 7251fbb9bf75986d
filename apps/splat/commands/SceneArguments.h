/// What every subcommand that reads a scene takes.
#pragma once

#include "scene/SceneFile.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace vorion::splat {

struct SceneArguments {
  std::string Path;
  std::string Axes; ///< FROM:TO; empty: as the file has them
  ReadOptions Options;
};

/// Declares the scene and the options about reading it; \p A must outlive the
/// parsing.
void addSceneOptions(CLI::App &App, SceneArguments &A);

/// Reads the scene, in the axes that were asked for; says on the terminal what
/// was left out.
/// With \p Meanwhile, another thread reads while this one does that. It must
/// print nothing. It may change the environment, which the reader never looks
/// at.
Expected<SceneFile> loadScene(const SceneArguments &A,
                              const std::function<void()> &Meanwhile = {});

/// The options of \p A as words of a command line, without the scene.
std::vector<std::string> wordsOf(const SceneArguments &A);

} // namespace vorion::splat
