/// Which lines a cache has: sets and ways, whose lines a policy replaces.
#pragma once

#include "vorion/isasim/Policies.h"
#include "vorion/isasim/Timing.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
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

/// Divides by a number that is known late but is mostly a power of two.
class Modulo {
public:
  explicit Modulo(uint32_t ByIn)
      : By(ByIn), Mask(std::has_single_bit(By) ? By - 1 : 0) {}
  uint32_t operator()(uint32_t N) const { return Mask ? N & Mask : N % By; }

private:
  uint32_t By, Mask;
};

/// Lines are numbered by address. A place is a way of a set.
///
/// The cache's own replacement: the least recently used line leaves; with the
/// hint, the least recently used one without it, and the one that is spared
/// loses its hint, so that lines which no tile came for do not stay for ever.
class CacheTags {
public:
  static constexpr size_t None = std::numeric_limits<size_t>::max();

  explicit CacheTags(const CacheShape &Shape);

  /// Beyond that of every line.
  size_t places() const { return Blocks.size() * WaysOfBlock; }
  /// The set of line \p Number.
  uint32_t setOf(uint32_t Number) const { return OfSets(Number); }
  /// The place of line \p Number, whose set \p Set is, or None.
  size_t find(uint32_t Number, uint32_t Set) const {
    return placeWhere(Set, &Block::Numbers, ~Dirty, Number + 1);
  }
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
    numberAt(Place) |= U.Dirties ? Dirty : 0;
    tell(Set, Place, U, false);
  }
  /// Line \p Number takes \p Place of \p Set, with \p Note.
  void replace(uint32_t Set, size_t Place, uint32_t Number, const Use &U,
               uint32_t Note = 0) {
    numberAt(Place) = (Number + 1) | (U.Dirties ? Dirty : 0);
    stateAt(Place) = (stateAt(Place) & Age) | Note << NoteShift;
    tell(Set, Place, U, true);
  }
  bool isDirty(size_t Place) const { return numberAt(Place) & Dirty; }
  uint32_t number(size_t Place) const { return (numberAt(Place) & ~Dirty) - 1; }
  /// Up to MostNote, of whoever owns this.
  uint32_t note(size_t Place) const {
    return stateAt(Place) >> NoteShift & MostNote;
  }
  static constexpr uint32_t MostNote = 0xFFFF;
  void clear();

private:
  /// Ways of a set. They share a line of the host's cache, which seldom has
  /// that of the next request.
  static constexpr uint32_t WaysOfBlock = 8;
  using Words = std::array<uint32_t, WaysOfBlock>;
  struct alignas(64) Block {
    /// Of the line plus 1, 0 for none, and Dirty beside its 26 bits.
    Words Numbers;
    /// How many ways of the set have been used since, Kept, and the note.
    Words States;
  };
  static constexpr uint32_t Dirty = uint32_t{1} << 31;
  static constexpr uint32_t NoWay = Dirty - 1; ///< behind the set's last one
  static constexpr uint32_t Age = 0x7F;
  static constexpr uint32_t Kept = 0x80; ///< it is spared once
  static constexpr unsigned NoteShift = 8;

  uint32_t &numberAt(size_t Place) {
    return Blocks[Place / WaysOfBlock].Numbers[Place % WaysOfBlock];
  }
  uint32_t numberAt(size_t Place) const {
    return Blocks[Place / WaysOfBlock].Numbers[Place % WaysOfBlock];
  }
  uint32_t &stateAt(size_t Place) {
    return Blocks[Place / WaysOfBlock].States[Place % WaysOfBlock];
  }
  uint32_t stateAt(size_t Place) const {
    return Blocks[Place / WaysOfBlock].States[Place % WaysOfBlock];
  }
  /// Of ways that the host looks at together.
  static constexpr uint32_t WaysOfQuad = 4;
  using Quad = uint32_t __attribute__((vector_size(4 * WaysOfQuad)));
  static Quad load(const uint32_t *From) {
    Quad Q;
    std::memcpy(&Q, From, sizeof(Q));
    return Q;
  }
  Block *firstBlock(uint32_t Set) {
    return Blocks.data() + size_t{Set} * BlocksOfSet;
  }
  const Block *firstBlock(uint32_t Set) const {
    return Blocks.data() + size_t{Set} * BlocksOfSet;
  }
  size_t firstPlace(uint32_t Set) const {
    return size_t{Set} * BlocksOfSet * WaysOfBlock;
  }
  /// The place of the only way of \p Set of which \p Part has \p Value in the
  /// bits of \p Mask, or None. No branch depends on what a way holds, which the
  /// host would mispredict: a sum over all needs no way's answer before the
  /// next one's.
  size_t placeWhere(uint32_t Set, Words Block::*Part, uint32_t Mask,
                    uint32_t Value) const {
    Quad Behind{}, Way = {1, 2, 3, 4};
    for (uint32_t B = 0; B != BlocksOfSet; ++B)
      for (uint32_t W = 0; W != WaysOfBlock; W += WaysOfQuad) {
        const Quad Q = load((firstBlock(Set)[B].*Part).data() + W);
        Behind += std::bit_cast<Quad>((Q & Mask) == Value) & Way;
        Way += WaysOfQuad;
      }
    const uint32_t Sum = Behind[0] + Behind[1] + Behind[2] + Behind[3];
    return Sum ? firstPlace(Set) + Sum - 1 : None;
  }
  void tell(uint32_t Set, size_t Place, const Use &U, bool IsFill) {
    if (Plugged) [[unlikely]]
      return tellPlugged(Set, Place, U, IsFill);
    uint32_t &Own = stateAt(Place);
    // All that were used since are one older than this.
    if (const uint32_t Before = Own & Age) {
      for (uint32_t B = 0; B != BlocksOfSet; ++B)
        for (uint32_t W = 0; W != WaysOfBlock; W += WaysOfQuad) {
          uint32_t *const At = firstBlock(Set)[B].States.data() + W;
          Quad Q = load(At);
          Q -= std::bit_cast<Quad>((Q & Age) < Before);
          std::memcpy(At, &Q, sizeof(Q));
        }
    }
    Own = (Own & ~Age) | (U.Keep ? Kept : 0);
  }
  void tellPlugged(uint32_t Set, size_t Place, const Use &U, bool IsFill);
  void dropLines();
  size_t leastRecent(uint32_t Set, uint64_t &Spared);

  CacheInfo Info;
  uint32_t BlocksOfSet;
  Modulo OfSets;
  std::vector<Block> Blocks;            ///< by set
  std::unique_ptr<Replacement> Plugged; ///< in place of the own one
};

} // namespace vorion::isasim
