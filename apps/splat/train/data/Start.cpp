#include "train/data/Start.h"

#include "cameras/Motion.h"
#include "picture/SceneUnit.h"
#include "scene/Activation.h"
#include "train/data/Neighbours.h"
#include "train/data/Philox.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>

namespace vorion::splat {
namespace {

/// Of the scene's unit. Points that coincide would have no size at all.
constexpr double LeastScale = 3e-4;

void placeRandomly(Scene &S, const RandomCube &Cube, uint64_t Seed) {
  for (std::size_t I = 0; I < S.size(); ++I) {
    const philox_words W =
        philox(static_cast<uint>(Seed), static_cast<uint>(Seed >> 32),
               static_cast<uint>(I), 0, 0, STREAM_START);
    for (std::size_t K = 0; K < 3; ++K)
      S.Means[3 * I + K] =
          static_cast<float>(Cube.Centre[K] - S.Origin[K] +
                             Cube.Reach * (2.0 * philox_unit(W.word[K]) - 1.0));
  }
}

void placeAtPoints(Scene &S, const CapturePoints &P) {
  const std::vector<float> Local = P.local();
  const std::size_t Stride = 3 * S.coefficients();
  for (std::size_t I = 0; I < S.size(); ++I) {
    const std::size_t From = I * P.size() / S.size();
    for (std::size_t K = 0; K < 3; ++K) {
      S.Means[3 * I + K] = Local[3 * From + K];
      S.Sh[Stride * I + K] =
          static_cast<float>((P.Colours[3 * From + K] / 255.0 - 0.5) / ShC0);
    }
  }
}

std::size_t viewsOf(const WorldPoint &Point, const Capture &C) {
  return static_cast<std::size_t>(
      std::ranges::count_if(C.Views, [&](const CaptureView &V) {
        if (V.Optics.Model->CoversSphere)
          return true;
        // Where the point lies in the camera's axes.
        const auto At = relativeTo(V.Pose, Point).worldToCameraTranslation();
        const double X = V.Pose.Fx * At[0] / At[2] + V.Pose.Cx,
                     Y = V.Pose.Fy * At[1] / At[2] + V.Pose.Cy;
        return At[2] > 0 && X > 0 && X < V.Pose.Width && Y > 0 &&
               Y < V.Pose.Height;
      }));
}

} // namespace

std::string RandomCube::centreText() const {
  return Centre == WorldPoint{} ? "the origin"
                                : fmt::format("({:.9g}, {:.9g}, {:.9g})",
                                              Centre[0], Centre[1], Centre[2]);
}

RandomCube randomCube(const Capture &C) {
  RandomCube Cube;
  const std::vector<Camera> Poses = C.poses();
  Cube.SeenBy = viewsOf(Cube.Centre, C);
  if (2 * Cube.SeenBy < C.Views.size()) {
    const auto Common = lookedAt(Poses);
    if (!Common)
      return Cube;
    Cube.Centre = *Common;
    Cube.SeenBy = viewsOf(Cube.Centre, C);
  }
  constexpr double Customary = 4;
  const double Distance =
      viewingDistance(Poses, std::span(&Cube.Centre, 1)) / Customary;
  if (Distance > 0)
    Cube.Reach *= std::exp2(std::round(std::log2(Distance)));
  return Cube;
}

std::vector<WorldPoint> sampleOf(const Capture &C) {
  if (C.Points.size() == 0) {
    const RandomCube Cube = randomCube(C);
    return 2 * Cube.SeenBy < C.Views.size()
               ? std::vector<WorldPoint>()
               : std::vector<WorldPoint>{Cube.Centre};
  }
  return sampled(C.Points.size(),
                 [&C](std::size_t I) { return C.Points.at(I); });
}

Scene startingScene(const Capture &C, const StartOptions &O) {
  const bool Random = C.Points.size() == 0;
  const std::size_t Count =
      std::min(Random ? RandomPoints : C.Points.size(), O.Most);
  const double Unit = sceneUnit(C.poses(), sampleOf(C));
  Scene S = Scene::sized(Count, O.ShDegree);
  S.Origin = C.Points.Origin;
  if (Random)
    placeRandomly(S, randomCube(C), O.Seed);
  else
    placeAtPoints(S, C.Points);
  const std::vector<double> Distances = meanNeighbourDistances(S.Means);
  const float Logit = opacityLogit(O.Opacity);
  for (std::size_t I = 0; I < Count; ++I) {
    const auto Log = static_cast<float>(
        std::log(std::max(Distances[I], LeastScale * Unit) * O.Scale));
    for (std::size_t K = 0; K < 3; ++K)
      S.LogScales[3 * I + K] = Log;
    S.Quats[4 * I] = 1;
    S.OpacityLogits[I] = Logit;
  }
  return S;
}

} // namespace vorion::splat
