#include "picture/SceneUnit.h"

#include "io/Mean.h"
#include "scene/LocalFrame.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorion::splat {

double viewingDistance(const std::vector<Camera> &Cameras,
                       std::span<const WorldPoint> Sample) {
  std::vector<double> Distances;
  for (std::size_t I = 0; I < Cameras.size();
       I += 1 + Cameras.size() / MostSampled)
    for (const WorldPoint &P : Sample) {
      const auto &From = Cameras[I].Position;
      Distances.push_back(
          std::hypot(P[0] - From[0], P[1] - From[1], P[2] - From[2]));
    }
  return Distances.empty() ? 0 : medianOf(std::move(Distances));
}

double sceneUnit(const std::vector<Camera> &Cameras,
                 std::span<const WorldPoint> Sample) {
  const double Distance = viewingDistance(Cameras, Sample);
  return Distance > 0 ? std::min(Distance, 1.0) : 1;
}

std::optional<float> nearOfSmallScene(Rules R,
                                      const std::vector<Camera> &Cameras,
                                      std::span<const WorldPoint> Sample) {
  const double Unit = sceneUnit(Cameras, Sample);
  if (Unit == 1)
    return std::nullopt;
  return std::max(static_cast<float>(nearLimit(R) * Unit),
                  std::numeric_limits<float>::min());
}

static void followUnit(const Scene &S, const std::vector<Camera> &Cameras,
                       Rules R, std::optional<float> &Near) {
  if (!Near)
    Near = nearOfSmallScene(R, Cameras, sampleOf(S));
}

void prepareToDraw(Scene &S, const std::vector<Camera> &Cameras, Rules R,
                   std::optional<float> &Near) {
  recentre(S, Cameras);
  followUnit(S, Cameras, R, Near);
}

const Scene &preparedToDraw(const Scene &S, const std::vector<Camera> &Cameras,
                            Rules R, std::optional<float> &Near,
                            std::optional<Scene> &Copy) {
  followUnit(S, Cameras, R, Near);
  if (S.MeanRests.empty())
    return S;
  recentre(Copy.emplace(S), Cameras);
  return *Copy;
}

} // namespace vorion::splat
