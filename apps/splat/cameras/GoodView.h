/// A view of a scene that nobody gave cameras for.
#pragma once

#include "cameras/Vector.h"
#include "io/Cameras.h"
#include "scene/Scene.h"

#include <optional>

namespace vorion::splat {

/// Where the detail of a scene is: strays and a far background count little.
struct SceneFocus {
  Vector Centre{};
  double Radius = 1; ///< of a ball that holds most of the detail
  Vector Up{};       ///< a unit vector
};

/// Finds it from the opacities, places and flat sides of \p S, which has at
/// least one Gaussian. Unless \p Up is given, up is near -y, as in trainers'
/// scenes, or near +z: where large flat Gaussians point, as those of floors do,
/// and along which the scene is not high. If most of them lie above the rest,
/// it is the other way round.
SceneFocus focusOf(const Scene &S, std::optional<Vector> Up = std::nullopt);

/// The view, of those around the focus at several heights and distances, from
/// which most of the detail is seen and fills the picture: called "found". All
/// of the focus is beyond the depth \p Nearest: a small scene is seen from
/// farther away, through a longer lens. The same bits for the same scene.
Camera goodView(const Scene &S, const SceneFocus &F, int Width, int Height,
                double Nearest);

} // namespace vorion::splat
