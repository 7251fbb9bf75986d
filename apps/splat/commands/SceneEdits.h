/// What `splat convert` changes in a scene before it writes it.
#pragma once

#include "scene/Scene.h"
#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

struct SceneEdits {
  std::vector<double> Translate, Rotate; ///< 3 each, or none
  std::optional<double> Scale;
  std::vector<double> Box;    ///< x0, y0, z0, x1, y1, z1
  std::vector<double> Sphere; ///< x, y, z, radius
  std::optional<double> Faint;
  std::optional<int> Degree;
  bool MortonOrder = false;
};

/// Declares the options; \p E must outlive the parsing.
void addEditOptions(CLI::App &App, SceneEdits &E);

/// What was left out.
struct LeftOut {
  std::string Text;          ///< for people
  std::string Rule;          ///< "faint", "box", "sphere", "harmonics"
  std::size_t Gaussians = 0; ///< of harmonics none
};

struct SceneChanges {
  std::vector<LeftOut> Left;
  /// Gaussians in another place than before, where the order was asked for.
  std::optional<std::size_t> Reordered;
};

/// Moves \p S, then leaves out what is too faint and what is not inside, then
/// sets the degree, then orders what is left. An Error if nothing is left.
Expected<SceneChanges> editScene(Scene &S, const SceneEdits &E);

} // namespace vorion::splat
