/// What follows the unit of length of a scene.
#pragma once

#include "io/LocalFrame.h"
#include "picture/Options.h"
#include "scene/Scene.h"

#include <optional>
#include <span>
#include <vector>

namespace vorion::splat {

/// The distance from which \p Cameras see the scene, in world units: the median
/// from cameras to \p Sample, positions of the scene (LocalFrame.h). 0 if there
/// are none: cameras alone do not tell how far they see.
double viewingDistance(const std::vector<Camera> &Cameras,
                       std::span<const WorldPoint> Sample);

/// The unit of fixed lengths such as the near plane's depth, in world units:
/// the viewing distance of scenes that are seen from less than 1, otherwise,
/// and where it is unknown, 1.
double sceneUnit(const std::vector<Camera> &Cameras,
                 std::span<const WorldPoint> Sample);

/// Depth of the near plane in pictures of a capture, if it is not that of the
/// rules, which is in the scene's unit.
std::optional<float> nearOfSmallScene(Rules R,
                                      const std::vector<Camera> &Cameras,
                                      std::span<const WorldPoint> Sample);

/// Prepares \p S for pictures of \p Cameras: measures it from an origin near it
/// if needed (\c recentre()), and sets \p Near, if empty, to
/// nearOfSmallScene().
void prepareToDraw(Scene &S, const std::vector<Camera> &Cameras, Rules R,
                   std::optional<float> &Near);

/// The same for a scene that stays as it is: the result is \p Copy if it is
/// measured from another origin, otherwise \p S.
const Scene &preparedToDraw(const Scene &S, const std::vector<Camera> &Cameras,
                            Rules R, std::optional<float> &Near,
                            std::optional<Scene> &Copy);
const Scene &preparedToDraw(Scene &&, const std::vector<Camera> &, Rules,
                            std::optional<float> &,
                            std::optional<Scene> &) = delete;

} // namespace vorion::splat
