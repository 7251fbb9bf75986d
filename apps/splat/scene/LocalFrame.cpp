#include "scene/LocalFrame.h"

namespace vorion::splat {

std::vector<WorldPoint> sampleOf(const Scene &S) {
  return sampled(S.size(), [&S](std::size_t I) {
    return WorldPoint{S.mean(3 * I), S.mean(3 * I + 1), S.mean(3 * I + 2)};
  });
}

bool needsDoubles(const Scene &S) {
  return (!S.MeanRests.empty() || S.Origin != WorldPoint{}) &&
         pixelsLost({}, sampleOf(S)) > MostPixelsLost;
}

void recentre(Scene &S, const std::vector<Camera> &Cameras) {
  if (S.MeanRests.empty())
    return;
  const WorldPoint Origin = localOrigin(Cameras, sampleOf(S));
  if (Origin != S.Origin)
    S.setOrigin(Origin);
}

} // namespace vorion::splat
