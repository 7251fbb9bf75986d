#include "Build.h"

#include "scene/Activation.h"

#include <cmath>

namespace vorion::test {

void add(splat::Scene &S, const Blob &B) {
  for (std::size_t K = 0; K < 3; ++K) {
    S.Means.push_back(B.Mean[K]);
    S.LogScales.push_back(
        B.Scale[K] > 0 ? static_cast<float>(std::log(B.Scale[K])) : -100.0F);
    S.Sh.push_back(static_cast<float>((B.Color[K] - 0.5) / splat::ShC0));
  }
  S.Quats.insert(S.Quats.end(), B.Quat.begin(), B.Quat.end());
  S.OpacityLogits.push_back(splat::opacityLogit(B.Opacity));
}

splat::Camera frontView(int Width, int Height, double Focal) {
  auto C = splat::Camera::ahead(Width, Height, Focal);
  C.Name = "view";
  return C;
}

splat::Camera turnedView(splat::Camera C) {
  // The rotation of the quaternion (0.8, 0.3, -0.4, 0.2), made unit.
  const double N = std::sqrt(0.8 * 0.8 + 0.3 * 0.3 + 0.4 * 0.4 + 0.2 * 0.2);
  const double W = 0.8 / N, X = 0.3 / N, Y = -0.4 / N, Z = 0.2 / N;
  C.Rotation = {
      {{1 - 2 * (Y * Y + Z * Z), 2 * (X * Y - W * Z), 2 * (X * Z + W * Y)},
       {2 * (X * Y + W * Z), 1 - 2 * (X * X + Z * Z), 2 * (Y * Z - W * X)},
       {2 * (X * Z - W * Y), 2 * (Y * Z + W * X), 1 - 2 * (X * X + Y * Y)}}};
  return C;
}

std::array<float, 3> seenAt(const splat::Camera &C, double X, double Y,
                            double Z) {
  std::array<float, 3> P{};
  for (std::size_t I = 0; I < 3; ++I)
    P[I] = static_cast<float>(C.Position[I] + C.Rotation[I][0] * X +
                              C.Rotation[I][1] * Y + C.Rotation[I][2] * Z);
  return P;
}

std::array<float, 4> Numbers::turn() {
  std::array<float, 4> Q{};
  for (float &Part : Q)
    Part = static_cast<float>(uniform(-1, 1));
  return Q;
}

std::array<double, 3> Numbers::color() {
  return {uniform(0, 1), uniform(0, 1), uniform(0, 1)};
}

} // namespace vorion::test
