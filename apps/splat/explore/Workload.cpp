#include "explore/Workload.h"

#include <algorithm>

namespace vorion::splat {

bool Workload::has(Work W) const {
  return std::ranges::any_of(Parts, [W](const Part &P) { return P.Does == W; });
}

} // namespace vorion::splat
