#include "train/optimize/MomentPlanes.h"

namespace vorion::splat {

constexpr const char *What = "Adam's moments";

MomentPlanes::MomentPlanes(Launcher &L, MomentsOn Place,
                           std::vector<float> Values)
    : Where(Place) {
  if (Where == MomentsOn::Host) {
    OnHost = std::move(Values);
    return;
  }
  OnDevice = allocate(L, Values.size());
  L.write(What, OnDevice, Values.data(), 4 * Values.size());
}

cl::Buffer MomentPlanes::allocate(Launcher &L, std::size_t Words) {
  return L.allocate(What, 4 * uint64_t{Words});
}

std::vector<float> MomentPlanes::values(Launcher &L, std::size_t Words) const {
  if (Where == MomentsOn::Host)
    return OnHost;
  std::vector<float> All(Words);
  L.read(What, All.data(), OnDevice, 4 * All.size());
  return All;
}

void MomentPlanes::bring(Launcher &L, const cl::Buffer &To, uint32_t P,
                         uint32_t Count) const {
  L.write(What, To, OnHost.data() + std::size_t{P} * Count,
          4 * uint64_t{Count});
}

void MomentPlanes::take(Launcher &L, const cl::Buffer &From, uint32_t P,
                        uint32_t Count) {
  L.read(What, OnHost.data() + std::size_t{P} * Count, From,
         4 * uint64_t{Count});
}

} // namespace vorion::splat
