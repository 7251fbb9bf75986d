/// Writing of scenes, and the losses.
#pragma once

#include "scene/Drawing.h"
#include "scene/Scene.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion::splat {

/// The file extensions of writable formats, such as ".spz".
const std::vector<std::string_view> &writtenEndings();

/// Maximum differences of two scenes of the same Gaussians.
struct SceneDifference {
  double Position = 0; ///< along an axis, world units
  double LogScale = 0;
  double Rotation = 0;  ///< of a unit quaternion's component; its sign is free
  double Opacity = 0;   ///< 0 to 1
  double Color = 0;     ///< of constant coefficients
  double Harmonics = 0; ///< of the others
};

/// Its members with their names in reports: "position", "log_scale".
std::vector<std::pair<std::string_view, double>>
byName(const SceneDifference &D);

/// Both must have the same size, degree and order.
SceneDifference differenceOf(const Scene &A, const Scene &B);

/// The contents of a written file, as read back.
struct WrittenScene {
  SceneDifference Lost;     ///< all 0 where the format keeps every bit
  int ShDegree = 0;         ///< of the file
  std::string Hash;         ///< as hashScene() has it (io/Hash.h)
  bool KeepsDrawing = true; ///< whether it says how the scene is drawn
};

class GltfWriter;

/// Writes \p S with the rendering mode \p D in the format of \p Path's
/// extension, or as INRIA's PLY if it is none of writtenEndings(), and reads it
/// back. Writing is atomic; for the folder of a SOG as in writeFilesTogether().
/// Compressed PLYs have the Gaussians in Morton order. \p AddMore adds what
/// else a `.glb` has.
Expected<WrittenScene>
writeScene(const std::string &Path, const Scene &S, const Drawing &D,
           const std::function<void(GltfWriter &)> &AddMore = {});

} // namespace vorion::splat
