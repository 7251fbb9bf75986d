#include "train/data/ViewOrder.h"

#include "train/data/Philox.h"

#include <numeric>
#include <utility>

namespace vorion::splat {

std::size_t ViewOrder::at(uint64_t Place) {
  const std::size_t Wanted = (Place - 1) / Count;
  if (Wanted != Round) {
    Round = Wanted;
    Order.resize(Count);
    std::iota(Order.begin(), Order.end(), std::size_t{0});
    for (std::size_t Left = Count; Left > 1; --Left) {
      const philox_words W = philox(
          static_cast<uint>(Seed), static_cast<uint>(Seed >> 32),
          static_cast<uint>(Left), static_cast<uint>(Round), 0, STREAM_VIEWS);
      // 32 bits over so few views: even to one in ten million.
      const std::size_t Chosen =
          static_cast<std::size_t>(ulong{W.word[0]} * Left >> 32);
      std::swap(Order[Left - 1], Order[Chosen]);
    }
  }
  return Order[(Place - 1) % Count];
}

} // namespace vorion::splat
