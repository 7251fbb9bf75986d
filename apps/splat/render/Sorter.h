/// Prefix sums and stable radix sorts on the device.
#pragma once

#include "device/Launcher.h"

#include <vector>

namespace vorion::splat {

/// Needs the programs scan and sort to be built. Results depend on the input
/// alone, not on how many groups share the work.
class Sorter {
public:
  /// Keys and values of some pairs.
  struct Pairs {
    cl::Buffer Keys, Values;
  };
  /// How \p Count things are shared out: groups of \c Lanes work-items have
  /// stretches of \c Chunk.
  struct Share {
    uint32_t Groups, Lanes, Chunk;
    std::size_t items() const { return std::size_t{Groups} * Lanes; }
  };

  explicit Sorter(Launcher &Launch);

  /// Out[i] = In[0] + ... + In[i-1] for i in [0, Count], saturating; \p Out
  /// has Count + 1 words and is not \p In.
  void scan(const cl::Buffer &In, const cl::Buffer &Out, uint32_t Count);

  /// Bits of a key, from First to below End.
  struct KeyBits {
    unsigned First, End;
  };

  /// Whether the keys of sorted pairs are wanted, too.
  enum class Keys { Sorted, Lost };

  /// Sorts \p Count pairs by some bits of their keys, stably. The result
  /// lies in one of \p A and \p B; \p Input is only read, and may be one of
  /// them if it may be overwritten. Of one pass that loses the keys, \p B needs
  /// none if \p Input is \p A.
  Pairs sort(const Pairs &Input, const Pairs &A, const Pairs &B, uint32_t Count,
             KeyBits Bits, Keys Wanted);

  /// Whether that takes one pass.
  static bool inOnePass(KeyBits Bits);
  /// After such a sort of pairs by the bits from 0 on: where the values of each
  /// key below \p Number begin and end, two words a key. \p Number is not
  /// above what so many bits can say.
  void rangesOfKeys(const cl::Buffer &Ranges, uint32_t Number);

  /// Keys of which some are left out: those with the highest bit.
  struct KeptKeys {
    uint32_t Count;
    uint32_t Kept;        ///< of them
    uint32_t Least, Most; ///< of those
    unsigned FirstBit;    ///< lower ones decide nothing
  };
  /// The numbers of the kept ones by their keys, stably.
  cl::Buffer sortKept(const cl::Buffer &From, const KeptKeys &What);

  /// A group a core, a lane a work-item; stretches of whole lines.
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
