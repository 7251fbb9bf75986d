#include "io/CameraModel.h"

#include <algorithm>

namespace vorion::splat {

CameraModel simplified(const CameraModel &M) {
  const bool Bends = !M.Model->IsDistortion ||
                     std::ranges::any_of(M.K, [](double K) { return K != 0; });
  return Bends ? M : CameraModel{.Shutter = M.Shutter};
}

} // namespace vorion::splat
