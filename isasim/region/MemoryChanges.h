/// Which pages of a machine's memory have changed since one looked last.
#pragma once

#include "mem/Memory.h"
#include "vorion/isasim/Machine.h"
#include "vorion/support/Expected.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vorion::isasim {

/// A sum that damage, or another function of the machine, changes; not one that
/// withstands malice.
class Digest {
public:
  void add(std::span<const std::byte> Bytes);
  void add(uint64_t Word);
  uint64_t value() const { return Sum; }

private:
  uint64_t Sum = 0;
};

class MemoryChanges {
public:
  static constexpr uint64_t PageBytes = 4096;

  /// Of Machine::memory(): its place there, and the page in it.
  struct Page {
    uint32_t Range = 0, Number = 0;
  };

  /// What \p M has now, unless it is 0, counts as changed. \p M must outlive
  /// it. The error is a host without room.
  static Expected<MemoryChanges> of(const Machine &M);

  /// The pages that have changed since the last call, in order.
  std::vector<Page> take();
  /// The same, as a sum over their places and contents.
  uint64_t takeDigest();

  /// What \p P was when take() looked last.
  std::span<const std::byte> bytes(Page P) const;
  /// How many bytes \p P has, 0 if there is no such page.
  size_t bytesOf(Page P) const;
  /// Writes \p Bytes, as many as bytesOf() says, to \p P, which does not count
  /// as changed.
  void put(Page P, std::span<const std::byte> Bytes);

private:
  struct Range {
    std::span<std::byte> Now;
    Mapping Before;
    bool has(uint32_t Page) const {
      return Page < (Now.size() + PageBytes - 1) / PageBytes;
    }
    /// Bytes of page \p Page, which may be the last and shorter.
    size_t sizeOf(uint32_t Page) const;
    std::byte *now(uint32_t Page) const;
    std::byte *before(uint32_t Page) const;
  };
  explicit MemoryChanges(std::vector<Range> RangesIn)
      : Ranges(std::move(RangesIn)) {}

  std::vector<Range> Ranges;
};

} // namespace vorion::isasim
