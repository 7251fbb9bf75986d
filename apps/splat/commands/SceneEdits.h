/// Changes that `splat convert` applies to a scene.
#pragma once

#include "mesh/Mesh.h"
#include "scene/Scene.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

struct SceneEdits {
  std::vector<double> Translate, Rotate; ///< 3 numbers each, or empty
  std::optional<double> Scale;
  std::vector<double> Box;     ///< x0, y0, z0, x1, y1, z1
  std::vector<double> Sphere;  ///< x, y, z, radius
  std::optional<double> Faint; ///< smallest opacity that stays
  std::optional<double> Large; ///< largest standard deviation that stays
  std::optional<int> Degree;
  bool MortonOrder = false;
};

/// Declares the options; \p E must outlive the parsing.
void addEditOptions(CLI::App &App, SceneEdits &E);

/// Gaussians or data that were removed.
struct LeftOut {
  std::string Text;          ///< for the terminal
  std::string Rule;          ///< "faint", "large", "box", "sphere", "harmonics"
  std::size_t Gaussians = 0; ///< 0 for "harmonics"
};

struct SceneChanges {
  std::vector<LeftOut> Left;
  /// Number of Gaussians with another index than before, if reordered.
  std::optional<std::size_t> Reordered;
};

/// Transforms \p S, removes faint and large Gaussians and those outside box
/// and sphere, sets the SH degree, and reorders the rest. An Error if no
/// Gaussian remains.
Expected<SceneChanges> editScene(Scene &S, const SceneEdits &E);

/// Transforms \p M as editScene() transforms a scene, which checks \p E.
Expected<Success> moveMesh(Mesh &M, const SceneEdits &E);

} // namespace vorion::splat
