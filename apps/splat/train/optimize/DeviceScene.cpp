#include "train/optimize/DeviceScene.h"

#include "render/Planes.h"

#include <numeric>

namespace vorion::splat {

PlanePair DeviceScene::allocate(Launcher &L, uint32_t Gaussians) const {
  return {L.allocate("Gaussians' geometry",
                     uint64_t{4} * GEOMETRY_PLANES * Gaussians),
          L.allocate("Gaussians' colours",
                     uint64_t{4} * colourPlanes() * Gaussians)};
}

DeviceScene DeviceScene::upload(Launcher &L, const Scene &S, MomentsOn Where) {
  DeviceScene D;
  D.Count = static_cast<uint32_t>(S.size());
  D.ShDegree = S.ShDegree;
  std::vector<float> Geometry = geometryPlanes(S);
  std::vector<float> Sh = shPlanes(S, S.ShDegree);
  D.Parameters = D.allocate(L, D.Count);
  L.write("Gaussians' geometry", D.Parameters.Geometry, Geometry.data(),
          4 * Geometry.size());
  L.write("Gaussians' colours", D.Parameters.Sh, Sh.data(), 4 * Sh.size());
  Geometry.assign(Geometry.size(), 0);
  Sh.assign(Sh.size(), 0);
  D.First = {{L, Where, Geometry}, {L, Where, Sh}};
  D.Second = {{L, Where, std::move(Geometry)}, {L, Where, std::move(Sh)}};
  std::vector<uint32_t> Numbers(D.Count);
  std::iota(Numbers.begin(), Numbers.end(), 0U);
  D.uploadIdentities(L, Numbers);
  return D;
}

void DeviceScene::uploadIdentities(Launcher &L,
                                   const std::vector<uint32_t> &From) {
  Identities = L.allocate("Gaussians' identities", 4 * From.size());
  L.write("Gaussians' identities", Identities, From.data(), 4 * From.size());
}

std::vector<uint32_t> DeviceScene::downloadIdentities(Launcher &L) const {
  std::vector<uint32_t> To(Count);
  L.read("Gaussians' identities", To.data(), Identities, 4 * To.size());
  return To;
}

Scene DeviceScene::download(Launcher &L) const {
  std::vector<float> Geometry(std::size_t{GEOMETRY_PLANES} * Count);
  std::vector<float> Sh(std::size_t{colourPlanes()} * Count);
  L.read("Gaussians' geometry", Geometry.data(), Parameters.Geometry,
         4 * Geometry.size());
  L.read("Gaussians' colours", Sh.data(), Parameters.Sh, 4 * Sh.size());
  return sceneOfPlanes(Geometry, Sh, ShDegree);
}

uint64_t mostInTraining(uint64_t Bytes, int ShDegree, MomentsOn Where) {
  // While a moment is copied, there are the old and the new parameters, the old
  // and the new moment, and the other moment. Without moments there are the old
  // and the new parameters, or parameters and gradients, and two planes.
  const std::size_t Pairs = Where == MomentsOn::Device ? 5 : 2;
  // Notes, fates and sorting, and what the renderer keeps of each: measured
  // with 50,000 and 100,000 Gaussians of degree 0 and 3.
  constexpr std::size_t Beside = 264;
  const std::size_t Planes = GEOMETRY_PLANES + 3 * shCoefficients(ShDegree);
  return Bytes / (4 * Pairs * Planes + Beside);
}

} // namespace vorion::splat
