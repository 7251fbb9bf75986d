/// Options of all subcommands that draw a mesh.
#pragma once

#include "commands/SceneArguments.h"
#include "mesh/Mesh.h"
#include "scene/SceneFile.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

struct MeshArguments {
  std::string File; ///< empty for none
  /// Direction in which a light shines, of length 1.
  std::optional<std::array<float, 3>> Light;
};

/// Declares --mesh and --light; \p A must outlive the parsing.
void addMeshOptions(CLI::App &App, MeshArguments &A);
void addLightOption(CLI::App &App, std::optional<std::array<float, 3>> &Light);

/// The error of --light where there is no mesh.
Error lightWithoutMesh();

/// Reads a mesh, and prints what is left out.
Expected<Mesh> loadMesh(const std::string &Path);

/// The options of \p A as command-line arguments.
std::vector<std::string> wordsOf(const MeshArguments &A);

/// \name Meshes to draw, in the world; null without any
/// @{
/// Of --mesh.
Expected<std::shared_ptr<const Mesh>> loadAddedMesh(const MeshArguments &A);
/// Beside the Gaussians in the scene's file, in their axes.
Expected<std::shared_ptr<const Mesh>> loadOwnMesh(const SceneArguments &A,
                                                  const SceneFile &Scene);
/// @}

} // namespace vorion::splat
