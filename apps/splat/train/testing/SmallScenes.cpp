#include "train/testing/SmallScenes.h"

#include "analyze/ToReference.h"
#include "io/Image.h"
#include "reference/Render.h"

#include <cmath>

namespace vorion::splat {

Scene randomScene(std::mt19937 &Random, uint32_t Count, int ShDegree,
                  const SceneSpread &Spread) {
  std::uniform_real_distribution<float> Unit(-1, 1);
  Scene S = Scene::sized(Count, ShDegree);
  for (float &V : S.Means)
    V = Spread.Means * Unit(Random);
  for (float &V : S.LogScales)
    V = Spread.LogScale + Spread.LogScales * Unit(Random);
  for (float &V : S.Quats)
    V = Unit(Random);
  for (float &V : S.OpacityLogits)
    V = Spread.Logits * Unit(Random);
  for (float &V : S.Sh)
    V = 0.4F * Unit(Random);
  return S;
}

Camera aroundOrigin(Camera C, double Angle, double Down) {
  const double S = std::sin(Angle), K = std::cos(Angle);
  C.Rotation = {{{K, 0, S}, {0, 1, 0}, {-S, 0, K}}};
  C.Position = {-3 * S, Down, -3 * K};
  return C;
}

Photo photographed(const Scene &S, const Camera &C) {
  const auto P =
      reference::render(toReference<double>(S), toReference<double>(C), {});
  Photo Picture{C.Width, C.Height, {}};
  for (const glm::dvec3 &Colour : P.Render)
    for (int K = 0; K < 3; ++K)
      Picture.Rgb.push_back(toByte(static_cast<float>(Colour[K])));
  return Picture;
}

} // namespace vorion::splat
