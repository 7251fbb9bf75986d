/// Automatic view of a scene without cameras.
#pragma once

#include "io/Cameras.h"
#include "io/Vector.h"
#include "scene/SceneFile.h"

#include <optional>

namespace vorion::splat {

/// The region of a scene with most of its detail. Outliers and a distant
/// background have little weight.
struct SceneFocus {
  Vector Centre{};
  double Radius = 1; ///< of a sphere that contains most of the detail
  Vector Up{};       ///< a unit vector
};

/// Estimates it from opacities, positions and orientations of \p S, which has
/// at least one Gaussian. Unless \p Up is given, up is near \p Near; without
/// that, near -y, as in scenes of trainers, or near +z: the axis of a tall
/// scene, or the normal of large flat Gaussians, such as those of floors, along
/// which the extent of the scene is small. If most of them are above the other
/// Gaussians, the direction is reversed.
SceneFocus focusOf(const Scene &S, std::optional<Vector> Up = std::nullopt,
                   std::optional<Vector> Near = std::nullopt);
/// The same, near the direction that \p F states.
SceneFocus focusOf(const SceneFile &F, std::optional<Vector> Up = std::nullopt);

/// Selects, of views around the focus at several heights and distances, the
/// view in which most of the detail is visible and fills the picture. Its name
/// is "found". A scene without a background is in the picture as a whole. The
/// complete focus is beyond the depth \p Nearest: a small scene
/// is viewed from farther away, with a longer focal length. Deterministic.
Camera goodView(const Scene &S, const SceneFocus &F, int Width, int Height,
                double Nearest);

} // namespace vorion::splat
