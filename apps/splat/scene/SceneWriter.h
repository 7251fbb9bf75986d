/// Scenes into files, and what is lost on the way.
#pragma once

#include "scene/Drawing.h"
#include "scene/Scene.h"
#include "vorion/support/Expected.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::splat {

/// The endings of names whose formats can be written, as ".spz".
const std::vector<std::string_view> &writtenEndings();

/// The largest differences of two scenes of the same Gaussians.
struct SceneDifference {
  double Position = 0; ///< along an axis, world units
  double LogScale = 0;
  double Rotation = 0;  ///< of a unit quaternion's component; its sign is free
  double Opacity = 0;   ///< 0 to 1
  double Color = 0;     ///< of constant coefficients
  double Harmonics = 0; ///< of the others
};

/// Its members, by the names that reports have: "position", "log_scale".
std::vector<std::pair<std::string_view, double>>
byName(const SceneDifference &D);

/// Both have the same size and degree, in the same order.
SceneDifference differenceOf(const Scene &A, const Scene &B);

/// What a written file has, as its reader sees it.
struct WrittenScene {
  SceneDifference Lost;     ///< all 0 where the format keeps every bit
  int ShDegree = 0;         ///< of the file
  std::string Hash;         ///< as hashScene() has it (io/Hash.h)
  bool KeepsDrawing = true; ///< whether it says how the scene is drawn
};

/// Writes \p S, which is drawn as \p D says, in the format of \p Path's ending,
/// INRIA's PLY if it is none of writtenEndings(), and reads it back. The whole
/// file appears or none; of a SOG's folder writeFilesTogether() says what may.
/// Compressed PLYs have the Gaussians in Morton order.
Expected<WrittenScene> writeScene(const std::string &Path, const Scene &S,
                                  const Drawing &D);

} // namespace vorion::splat
