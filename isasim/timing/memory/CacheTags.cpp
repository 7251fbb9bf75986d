#include "timing/memory/CacheTags.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

static uint32_t setsOf(const CacheShape &Shape) {
  return std::max(1U, Shape.Bytes / TimingLineBytes / Shape.Ways);
}

CacheTags::CacheTags(const CacheShape &Shape)
    : Ways(Shape.Ways), Sets(setsOf(Shape)), Numbers(size_t{Sets} * Ways),
      Policy({Shape.Name, Shape.Number, Sets, Ways, Shape.Hint}) {}

// The loop over ways has no branch that depends on what it finds, because the
// host's branch predictor would mispredict it.
size_t CacheTags::find(uint32_t Number, uint32_t Set) const {
  // At most one way has the line, so that a sum over all finds it, which needs
  // no way's answer before the next one's.
  const uint32_t *Tag = Numbers.data() + placeOf(Set);
  uint32_t Behind = 0;
  for (uint32_t W = 0; W != Ways; ++W)
    Behind += (Tag[W] & ~Dirty) == Number + 1 ? W + 1 : 0;
  return Behind ? placeOf(Set) + Behind - 1 : None;
}

size_t CacheTags::victim(uint32_t Set, uint64_t &Spared) {
  const size_t First = placeOf(Set);
  if (Numbers[First + Ways - 1] == 0)
    return std::find(Numbers.begin() + static_cast<ptrdiff_t>(First),
                     Numbers.end(), 0U) -
           Numbers.begin();
  const Replacement::Victim V = Policy.victim(Set);
  Spared += V.Spares;
  return First + V.Way;
}

void CacheTags::clear() {
  std::ranges::fill(Numbers, 0);
  Policy.clear();
}

std::string CachePolicy::fault(uint32_t Way) const {
  return fmt::format("replaces way {} of a set of cache {} {}, expected 0 to "
                     "{}",
                     Way, Info.Name, Info.Number, Info.Ways - 1);
}

} // namespace vorion::isasim
