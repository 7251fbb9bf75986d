/// Who owns which part of a device's global memory.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace vorion::runtime {

/// First or last fit over address-ordered free ranges; neighbours coalesce when
/// freed.
/// Every block is aligned to and sized in multiples of \c Alignment. Not
/// thread-safe.
class Allocator {
public:
  static constexpr uint64_t Alignment = 128;

  /// Where to look first.
  enum class End { Low, High };

  Allocator() = default;
  Allocator(uint64_t Base, uint64_t Size) { add(Base, Size); }

  /// Manages [\p Base, \p Base + \p Size), too; both ends are rounded inwards.
  /// It must not touch what is managed already.
  void add(uint64_t Base, uint64_t Size);

  /// The block's address, or nothing if no free range that begins below
  /// \p Below holds \p Size bytes. A size of 0 is one unit of alignment, so
  /// that addresses stay distinct.
  std::optional<uint64_t> allocate(uint64_t Size, End From = End::Low,
                                   uint64_t Below = UINT64_MAX);

  /// False if no block begins at \p Address (never allocated or freed twice).
  bool release(uint64_t Address);

  uint64_t freeBytes() const { return Free; }
  uint64_t largestFree() const;

private:
  using Ranges = std::map<uint64_t, uint64_t>;
  /// Takes the range's first or last \p Want bytes.
  uint64_t take(Ranges::iterator Range, uint64_t Want, End From);

  /// Address to size.
  Ranges FreeRanges, Blocks;
  uint64_t Free = 0;
};

} // namespace vorion::runtime
