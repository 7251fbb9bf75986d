/// Which lines a cache has: sets and ways, whose lines a policy replaces.
#pragma once

#include "timing/memory/CachePolicy.h"
#include "vorion/isasim/Timing.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace vorion::isasim {

/// Sizes of one cache, and which one it is.
struct CacheShape {
  uint32_t Bytes, Ways, Banks, Mshrs, HitCycles;
  bool Hint;
  /// Writes go on to what lies below at once, and a miss of one allocates
  /// nothing. Otherwise they stay until their line is replaced.
  bool WriteThrough = false;
  const char *Name = "l2"; ///< as of CacheInfo
  uint32_t Number = 0;
};

/// Lines are numbered by address. A place is a way of a set.
class CacheTags {
public:
  static constexpr size_t None = std::numeric_limits<size_t>::max();

  explicit CacheTags(const CacheShape &Shape);

  size_t places() const { return Numbers.size(); }
  /// The set of line \p Number.
  uint32_t setOf(uint32_t Number) const { return Number % Sets; }
  /// The first place of \p Set.
  size_t placeOf(uint32_t Set) const { return size_t{Set} * Ways; }
  /// Set \p Set is looked at soon.
  void prefetch(uint32_t Set) const { Policy.prefetch(Set); }
  /// The place of line \p Number, whose set \p Set is, or None.
  size_t find(uint32_t Number, uint32_t Set) const;
  /// The place in \p Set that the next line takes. A line that is spared for
  /// it counts in \p Spared.
  size_t victim(uint32_t Set, uint64_t &Spared);

  /// What is done with a line.
  struct Use {
    bool Writes; ///< or is an atomic
    bool Keep;   ///< as of CacheRequest
    bool Dirties;
  };
  /// The line at \p Place of \p Set is used.
  void use(uint32_t Set, size_t Place, const Use &U) {
    Numbers[Place] |= U.Dirties ? Dirty : 0;
    tell(Set, Place, U, false);
  }
  /// Line \p Number takes \p Place of \p Set.
  void replace(uint32_t Set, size_t Place, uint32_t Number, const Use &U) {
    Numbers[Place] = (Number + 1) | (U.Dirties ? Dirty : 0);
    tell(Set, Place, U, true);
  }
  bool isDirty(size_t Place) const { return Numbers[Place] & Dirty; }
  uint32_t number(size_t Place) const { return (Numbers[Place] & ~Dirty) - 1; }
  void clear();

private:
  /// Beside a number, which has 26 bits.
  static constexpr uint32_t Dirty = uint32_t{1} << 31;

  void tell(uint32_t Set, size_t Place, const Use &U, bool IsFill) {
    Policy.use({.Set = Set,
                .Way = static_cast<uint32_t>(Place - placeOf(Set)),
                .Line = number(Place),
                .IsFill = IsFill,
                .IsWrite = U.Writes,
                .Keep = U.Keep});
  }

  uint32_t Ways, Sets;
  std::vector<uint32_t> Numbers; ///< of the line plus 1, 0 for none
  CachePolicy Policy;
};

} // namespace vorion::isasim
