/// What `splat info` says about the Gaussians of a scene.
#pragma once

#include "scene/Scene.h"

#include <array>

namespace vorion::splat {

/// Least, median, mean and largest, in double.
struct Distribution {
  double Least = 0, Median = 0, Mean = 0, Largest = 0;
};

struct SceneStatistics {
  std::array<double, 3> Low{}, High{}; ///< of the means, by axis
  /// The same without the outermost hundredth on each side: most scenes have
  /// strays far away.
  std::array<double, 3> InnerLow{}, InnerHigh{};
  Distribution Opacity;      ///< activated, 0 to 1
  double Transparent = 0;    ///< share of opacities below 1/255: never blended
  Distribution LargestScale; ///< activated, of each Gaussian's longest axis
  Distribution AxisRatio;    ///< longest to shortest axis
};

/// \p S has at least one Gaussian. The median of an even number is the lower
/// of the two in the middle.
SceneStatistics statisticsOf(const Scene &S);

} // namespace vorion::splat
