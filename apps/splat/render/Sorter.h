/// Prefix sums and stable radix sorts on the device.
#pragma once

#include "../device/Launcher.h"

namespace vorion::splat {

/// Needs the programs scan and sort to be built. Results depend on the input
/// alone, not on how many work-items share the work.
class Sorter {
public:
  /// Keys and values of \p Count pairs, sorted.
  struct Pairs {
    cl::Buffer Keys, Values;
  };

  explicit Sorter(Launcher &L);

  /// Out[i] = In[0] + ... + In[i-1] for i in [0, Count], saturating; \p Out
  /// has Count + 1 words and is not \p In.
  void scan(const cl::Buffer &In, const cl::Buffer &Out, std::uint32_t Count);

  /// Bits of a key, from First to below End.
  struct KeyBits {
    unsigned First, End;
  };

  /// Sorts \p Count pairs by some bits of their keys, stably. The result
  /// lies in one of \p A and \p B; \p Input is only read, and may be one of
  /// them if it may be overwritten.
  Pairs sort(const Pairs &Input, const Pairs &A, const Pairs &B,
             std::uint32_t Count, KeyBits Bits);

private:
  struct Share {
    std::uint32_t Items, Chunk;
  };
  Share share(std::uint32_t Count, std::uint32_t LeastChunk) const;

  Launcher &L;
  std::uint32_t MostItems;
  cl::Buffer Sums, Histogram, Offsets;
};

} // namespace vorion::splat
