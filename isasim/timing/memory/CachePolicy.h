/// The data caches' own replacement.
#pragma once

#include "timing/policy/Policy.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace vorion::isasim {

/// The least recently used line leaves; with the hint, the least recently used
/// one without it, and the one that is spared loses its hint, so that lines
/// which no tile came for do not stay for ever.
class Lru final : public Replacement {
public:
  explicit Lru(const CacheInfo &Of)
      : Ways(Of.Ways), Hint(Of.Hint), LastUse(size_t{Of.Sets} * Of.Ways) {}

  /// Set \p Set is looked at soon.
  void prefetch(uint32_t Set) const {
    __builtin_prefetch(LastUse.data() + size_t{Set} * Ways, 1);
  }

  void use(const LineUse &U) override {
    uint64_t &Last = LastUse[size_t{U.Set} * Ways + U.Way];
    const uint64_t Mark = U.Keep ? Kept : 0;
    Last = ++Uses | Mark | (U.IsFill ? 0 : Last & Kept);
  }

  Victim victim(uint32_t Set) override {
    uint64_t *const Of = LastUse.data() + size_t{Set} * Ways;
    // With the hint in the mask, lines that are kept come behind all others. No
    // branch depends on what is found: the host would mispredict it.
    const auto OldestBy = [&](uint64_t Mask) {
      uint32_t Oldest = 0;
      uint64_t Used = std::numeric_limits<uint64_t>::max();
      for (uint32_t W = 0; W != Ways; ++W) {
        const uint64_t Order = Of[W] & Mask;
        Oldest = Order < Used ? W : Oldest;
        Used = std::min(Used, Order);
      }
      return Oldest;
    };
    const uint32_t Oldest = OldestBy(Kept - 1);
    if (!Hint || !(Of[Oldest] & Kept))
      return {Oldest};
    const uint32_t OldestPlain = OldestBy(~uint64_t{0});
    if (Of[OldestPlain] & Kept)
      return {Oldest};
    Of[Oldest] &= ~Kept;
    return {OldestPlain, true};
  }

  void clear() override { std::ranges::fill(LastUse, 0); }

private:
  static constexpr uint64_t Kept = uint64_t{1} << 63; ///< it is spared once

  uint32_t Ways;
  bool Hint;
  std::vector<uint64_t> LastUse; ///< order of the last use, and the mark
  uint64_t Uses = 0;
};

/// Of the data cache \p Of.
class CachePolicy : public Policy<Replacement, Lru> {
public:
  explicit CachePolicy(const CacheInfo &Of)
      : Policy(Lru(Of), Of.Sets && pluggedPolicies().Cache
                            ? pluggedPolicies().Cache(Of)
                            : nullptr),
        Info(Of) {}

  void prefetch(uint32_t Set) const {
    if (isOwn())
      own().prefetch(Set);
  }
  void use(const LineUse &U) {
    ask([&](auto &P) { P.use(U); });
  }
  void clear() {
    ask([](auto &P) { P.clear(); });
  }
  /// A way of \p Set, all of whose ways have lines.
  Replacement::Victim victim(uint32_t Set) {
    const auto V = ask([&](auto &P) { return P.victim(Set); });
    if (isOwn() || V.Way < Info.Ways)
      return V;
    notePolicyFault(fault(V.Way));
    return {0};
  }

private:
  std::string fault(uint32_t Way) const;

  CacheInfo Info;
};

} // namespace vorion::isasim
