/// Statistics of the Gaussians of a scene for `splat info`.
#pragma once

#include "scene/Scene.h"

#include <array>

namespace vorion::splat {

/// Minimum, median, mean and maximum, in double.
struct Distribution {
  double Least = 0, Median = 0, Mean = 0, Largest = 0;
};

struct SceneStatistics {
  std::array<double, 3> Low{}, High{}; ///< of the means, by axis
  /// The same without the outermost hundredth on each side, because most scenes
  /// have distant outliers.
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
