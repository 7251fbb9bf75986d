/// The order of training views.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// Each round contains every view once, in random order. The order depends only
/// on the seed and the number of views, so a run that continues from a
/// checkpoint uses the same views as an uninterrupted run.
class ViewOrder {
public:
  ViewOrder(std::size_t ViewCount, uint64_t RandomSeed)
      : Count(ViewCount), Seed(RandomSeed) {}

  /// The view with number \p Place of a run, from 1: with one view per
  /// iteration, that of iteration \p Place.
  std::size_t at(uint64_t Place);

private:
  std::size_t Count;
  uint64_t Seed;
  std::size_t Round = ~std::size_t{0}; ///< the round of \c Order
  std::vector<std::size_t> Order;
};

} // namespace vorion::splat
