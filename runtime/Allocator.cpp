#include "Allocator.h"

#include <algorithm>
#include <iterator>

using namespace vorion::runtime;

void Allocator::add(uint64_t Base, uint64_t Size) {
  const uint64_t First = (Base + Alignment - 1) / Alignment * Alignment;
  const uint64_t End = (Base + Size) / Alignment * Alignment;
  if (End > First) {
    Free += End - First;
    FreeRanges[First] = End - First;
  }
}

uint64_t Allocator::take(Ranges::iterator Range, uint64_t Want, End From) {
  const auto [First, Length] = *Range;
  const uint64_t Rest = Length - Want;
  FreeRanges.erase(Range);
  const uint64_t Address = From == End::Low ? First : First + Rest;
  if (Rest)
    FreeRanges[From == End::Low ? First + Want : First] = Rest;
  Blocks[Address] = Want;
  Free -= Want;
  return Address;
}

std::optional<uint64_t> Allocator::allocate(uint64_t Size, End From,
                                            uint64_t Below) {
  // Checked before rounding up, which could wrap.
  if (Size > Free)
    return std::nullopt;
  const uint64_t Want =
      std::max(Alignment, (Size + Alignment - 1) / Alignment * Alignment);
  const auto Holds = [=](const auto &Range) {
    return Range.first < Below && Range.second >= Want;
  };
  if (From == End::Low) {
    const auto Found = std::ranges::find_if(FreeRanges, Holds);
    if (Found != FreeRanges.end())
      return take(Found, Want, From);
  } else {
    const auto Found =
        std::find_if(FreeRanges.rbegin(), FreeRanges.rend(), Holds);
    if (Found != FreeRanges.rend())
      return take(std::prev(Found.base()), Want, From);
  }
  return std::nullopt;
}

bool Allocator::release(uint64_t Address) {
  const auto Block = Blocks.find(Address);
  if (Block == Blocks.end())
    return false;
  uint64_t First = Address;
  uint64_t Length = Block->second;
  Free += Length;
  Blocks.erase(Block);

  auto After = FreeRanges.lower_bound(First);
  if (After != FreeRanges.begin()) {
    const auto Before = std::prev(After);
    if (Before->first + Before->second == First) {
      First = Before->first;
      Length += Before->second;
      FreeRanges.erase(Before);
    }
  }
  if (After != FreeRanges.end() && First + Length == After->first) {
    Length += After->second;
    FreeRanges.erase(After);
  }
  FreeRanges[First] = Length;
  return true;
}

uint64_t Allocator::largestFree() const {
  uint64_t Largest = 0;
  for (const auto &[Address, Length] : FreeRanges)
    Largest = std::max(Largest, Length);
  return Largest;
}
