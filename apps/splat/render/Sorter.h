/// Prefix sums and stable radix sorts on the device.
#pragma once

#include "device/Launcher.h"

#include <vector>

namespace vorion::splat {

/// Needs the programs scan and sort. Results depend only on the input, not on
/// the number of groups.
class Sorter {
public:
  /// Keys and values of pairs.
  struct Pairs {
    cl::Buffer Keys, Values;
  };
  /// Distribution of items: each group of \c Lanes work-items processes a range
  /// of \c Chunk items.
  struct Share {
    uint32_t Groups, Lanes, Chunk;
    std::size_t items() const { return std::size_t{Groups} * Lanes; }
  };

  explicit Sorter(Launcher &Launch);

  /// Exclusive prefix sum: Out[i] = In[0] + ... + In[i-1] for i in [0, Count],
  /// saturating. \p Out has Count + 1 words and is not \p In.
  void scan(const cl::Buffer &In, const cl::Buffer &Out, uint32_t Count);

  /// Bits of a key, First to End - 1.
  struct KeyBits {
    unsigned First, End;
  };

  /// Whether the keys of the sorted pairs are kept.
  enum class Keys { Sorted, Lost };

  /// Sorts \p Count pairs stably by \p Bits of their keys. The result is in \p
  /// A or \p B. \p Input may be one of them if it may be overwritten. If the
  /// sort takes one pass and keys are not kept, \p B needs no keys if \p Input
  /// is \p A.
  Pairs sort(const Pairs &Input, const Pairs &A, const Pairs &B, uint32_t Count,
             KeyBits Bits, Keys Wanted);

  /// Whether the sort takes one pass.
  static bool inOnePass(KeyBits Bits);
  /// After a sort by bits from 0 on: begin and end of the values of each key
  /// below \p Number, two words per key. \p Number must not exceed the range of
  /// these bits.
  void rangesOfKeys(const cl::Buffer &Ranges, uint32_t Number);

  /// Keys of which those with the highest bit are dropped.
  struct KeptKeys {
    uint32_t Count;
    uint32_t Kept;        ///< number of kept keys
    uint32_t Least, Most; ///< range of the kept keys
    unsigned FirstBit;    ///< lower bits are ignored
  };
  /// The indices of the kept keys, stably sorted by key.
  cl::Buffer sortKept(const cl::Buffer &From, const KeptKeys &What);

  /// One group per core, one work-item per lane; ranges of complete cache
  /// lines.
  Share share(uint32_t Count) const;

private:
  uint32_t scanItems() const;
  /// A digit of keys.
  struct Digit {
    unsigned Shift, Bits;
    uint32_t count() const { return 1U << Bits; }
  };
  static std::vector<Digit> digits(unsigned Bits, unsigned Room);
  void count(const cl::Buffer &Keys, uint32_t Count, Digit D);
  void sumUp(uint32_t Stretches, Digit D);
  void scatter(const Pairs &From, const Pairs &To, uint32_t Count, Digit D);
  void scatterWords(const cl::Buffer &From, const cl::Buffer &To,
                    uint32_t Count, Digit D);
  void scatterToWords(const Pairs &From, const cl::Buffer &To, uint32_t Count,
                      Digit D, unsigned ValueBits);

  Launcher &Launch;
  uint32_t Groups;
  cl::Buffer Histogram, Totals, Sums;
};

} // namespace vorion::splat
