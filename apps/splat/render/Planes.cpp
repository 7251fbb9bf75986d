#include "Planes.h"

#include "Layout.h"

namespace vorion::splat {

std::vector<float> geometryPlanes(const Scene &S) {
  const std::size_t N = S.size();
  std::vector<float> Planes(GEOMETRY_PLANES * N);
  for (std::size_t I = 0; I < N; ++I) {
    for (std::size_t K = 0; K < 3; ++K) {
      Planes[(PLANE_MEAN + K) * N + I] = S.Means[3 * I + K];
      Planes[(PLANE_LOG_SCALE + K) * N + I] = S.LogScales[3 * I + K];
    }
    for (std::size_t K = 0; K < 4; ++K)
      Planes[(PLANE_QUATERNION + K) * N + I] = S.Quats[4 * I + K];
    Planes[PLANE_LOGIT * N + I] = S.OpacityLogits[I];
  }
  return Planes;
}

std::vector<float> shPlanes(const Scene &S, int Degree) {
  const std::size_t N = S.size();
  const std::size_t Planes = 3 * shCoefficients(Degree);
  const std::size_t Stride = 3 * S.coefficients();
  std::vector<float> Out(Planes * N);
  for (std::size_t I = 0; I < N; ++I)
    for (std::size_t P = 0; P < Planes; ++P)
      Out[P * N + I] = S.Sh[I * Stride + P];
  return Out;
}

Scene sceneOfPlanes(const std::vector<float> &Geometry,
                    const std::vector<float> &Sh, int Degree) {
  const std::size_t N = Geometry.size() / GEOMETRY_PLANES;
  Scene S = Scene::sized(N, Degree);
  const std::size_t Stride = 3 * S.coefficients();
  for (std::size_t I = 0; I < N; ++I) {
    for (std::size_t K = 0; K < 3; ++K) {
      S.Means[3 * I + K] = Geometry[(PLANE_MEAN + K) * N + I];
      S.LogScales[3 * I + K] = Geometry[(PLANE_LOG_SCALE + K) * N + I];
    }
    for (std::size_t K = 0; K < 4; ++K)
      S.Quats[4 * I + K] = Geometry[(PLANE_QUATERNION + K) * N + I];
    S.OpacityLogits[I] = Geometry[PLANE_LOGIT * N + I];
    for (std::size_t P = 0; P < Stride; ++P)
      S.Sh[I * Stride + P] = Sh[P * N + I];
  }
  return S;
}

} // namespace vorion::splat
