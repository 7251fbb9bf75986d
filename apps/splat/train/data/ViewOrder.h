/// Which view is trained on when.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// Rounds in each of which every view comes once, in random order. A view
/// depends on the seed, the number of views and its place only, so a run
/// that goes on from a checkpoint sees what an unbroken one sees.
class ViewOrder {
public:
  ViewOrder(std::size_t ViewCount, uint64_t RandomSeed)
      : Count(ViewCount), Seed(RandomSeed) {}

  /// The \p Place th view of a run, from 1: with one view an iteration, that of
  /// iteration \p Place.
  std::size_t at(uint64_t Place);

private:
  std::size_t Count;
  uint64_t Seed;
  std::size_t Round = ~std::size_t{0}; ///< that \c Order is of
  std::vector<std::size_t> Order;
};

} // namespace vorion::splat
