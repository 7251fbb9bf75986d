#include "train/data/Start.h"

#include "scene/Activation.h"
#include "train/data/Neighbours.h"
#include "train/data/Philox.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat {
namespace {

/// Points that coincide would have no size at all.
constexpr double LeastScale = 3e-4;

void placeRandomly(Scene &S, uint64_t Seed) {
  for (std::size_t I = 0; I < S.size(); ++I) {
    const philox_words W =
        philox(static_cast<uint>(Seed), static_cast<uint>(Seed >> 32),
               static_cast<uint>(I), 0, 0, STREAM_START);
    for (std::size_t K = 0; K < 3; ++K)
      S.Means[3 * I + K] = static_cast<float>(
          RandomReach * (2.0 * philox_unit(W.word[K]) - 1.0));
  }
}

void placeAtPoints(Scene &S, const CapturePoints &P) {
  const std::size_t Stride = 3 * S.coefficients();
  for (std::size_t I = 0; I < S.size(); ++I) {
    const std::size_t From = I * P.size() / S.size();
    for (std::size_t K = 0; K < 3; ++K) {
      S.Means[3 * I + K] = P.Positions[3 * From + K];
      S.Sh[Stride * I + K] =
          static_cast<float>((P.Colours[3 * From + K] / 255.0 - 0.5) / ShC0);
    }
  }
}

} // namespace

std::size_t viewsOfRandomPoints(const Capture &C) {
  return static_cast<std::size_t>(
      std::ranges::count_if(C.Views, [](const CaptureView &V) {
        if (V.Optics.Model->CoversSphere)
          return true;
        // Where the origin lies in the camera's axes.
        const auto At = V.Pose.worldToCameraTranslation();
        const double X = V.Pose.Fx * At[0] / At[2] + V.Pose.Cx,
                     Y = V.Pose.Fy * At[1] / At[2] + V.Pose.Cy;
        return At[2] > 0 && X > 0 && X < V.Pose.Width && Y > 0 &&
               Y < V.Pose.Height;
      }));
}

Scene startingScene(const Capture &C, const StartOptions &O) {
  const bool Random = C.Points.size() == 0;
  const std::size_t Count =
      std::min(Random ? RandomPoints : C.Points.size(), O.Most);
  Scene S = Scene::sized(Count, O.ShDegree);
  if (Random)
    placeRandomly(S, O.Seed);
  else
    placeAtPoints(S, C.Points);
  const std::vector<double> Distances = meanNeighbourDistances(S.Means);
  const float Logit = opacityLogit(O.Opacity);
  for (std::size_t I = 0; I < Count; ++I) {
    const auto Log = static_cast<float>(
        std::log(std::max(Distances[I], LeastScale) * O.Scale));
    for (std::size_t K = 0; K < 3; ++K)
      S.LogScales[3 * I + K] = Log;
    S.Quats[4 * I] = 1;
    S.OpacityLogits[I] = Logit;
  }
  return S;
}

} // namespace vorion::splat
