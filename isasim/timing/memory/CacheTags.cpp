#include "timing/memory/CacheTags.h"

#include "timing/policy/Policy.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::isasim {

static uint32_t setsOf(const CacheShape &Shape) {
  return std::max(1U, Shape.Bytes / TimingLineBytes / Shape.Ways);
}

CacheTags::CacheTags(const CacheShape &Shape)
    : Info{Shape.Name, Shape.Number, setsOf(Shape), Shape.Ways, Shape.Hint},
      BlocksOfSet((Info.Ways + WaysOfBlock - 1) / WaysOfBlock),
      OfSets(Info.Sets), Blocks(size_t{Info.Sets} * BlocksOfSet),
      Plugged(pluggedPolicies().Cache ? pluggedPolicies().Cache(Info)
                                      : nullptr) {
  dropLines();
}

size_t CacheTags::victim(uint32_t Set, uint64_t &Spared) {
  const size_t First = firstPlace(Set);
  if (numberAt(First + Info.Ways - 1) == 0) {
    size_t Empty = First;
    while (numberAt(Empty) != 0)
      ++Empty;
    return Empty;
  }
  if (!Plugged)
    return leastRecent(Set, Spared);
  const Replacement::Victim V = Plugged->victim(Set);
  Spared += V.Spares;
  if (V.Way < Info.Ways)
    return First + V.Way;
  notePolicyFault(
      fmt::format("replaces way {} of a set of cache {} {}, expected 0 to {}",
                  V.Way, Info.Name, Info.Number, Info.Ways - 1));
  return First;
}

/// The own policy's victim.
size_t CacheTags::leastRecent(uint32_t Set, uint64_t &Spared) {
  const size_t Oldest = placeWhere(Set, &Block::States, Age, Info.Ways - 1);
  if (!Info.Hint || !(stateAt(Oldest) & Kept))
    return Oldest;
  size_t Plain = None;
  for (size_t P = firstPlace(Set); P != firstPlace(Set) + Info.Ways; ++P)
    if (!(stateAt(P) & Kept) &&
        (Plain == None || (stateAt(P) & Age) > (stateAt(Plain) & Age)))
      Plain = P;
  if (Plain == None)
    return Oldest;
  stateAt(Oldest) &= ~Kept;
  ++Spared;
  return Plain;
}

void CacheTags::tellPlugged(uint32_t Set, size_t Place, const Use &U,
                            bool IsFill) {
  Plugged->use({.Set = Set,
                .Way = static_cast<uint32_t>(Place - firstPlace(Set)),
                .Line = number(Place),
                .IsFill = IsFill,
                .IsWrite = U.Writes,
                .Keep = U.Keep});
}

void CacheTags::clear() {
  dropLines();
  if (Plugged)
    Plugged->clear();
}

void CacheTags::dropLines() {
  for (uint32_t Set = 0; Set != Info.Sets; ++Set)
    for (uint32_t Way = 0; Way != BlocksOfSet * WaysOfBlock; ++Way) {
      const bool Exists = Way < Info.Ways;
      numberAt(firstPlace(Set) + Way) = Exists ? 0 : NoWay;
      stateAt(firstPlace(Set) + Way) = Exists ? Way : Age;
    }
}

} // namespace vorion::isasim
