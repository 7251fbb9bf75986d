/// DRAM: channels with banks, rows, a data bus, activation limits, refresh. All
/// times are picoseconds, so that nothing here depends on the chip's clock.
#pragma once

#include "vorion/isasim/Timing.h"

#include <cstdint>
#include <vector>

namespace vorion::isasim {

/// Answers each request at once with the time at which its last byte is there.
/// Requests should come in order of time; one that is a little early is served
/// as if it had come then. Open rows; banks in parallel; on the bus, whoever is
/// ready first goes first, whatever came earlier.
class Dram {
public:
  explicit Dram(const DramTiming &Params);

  /// Reads or writes the line at \p Address from \p Now on.
  uint64_t access(uint64_t Now, uint32_t Address, bool IsWrite);

  const DramTime &time() const { return Counted; }
  void clearCounters() { Counted = {}; }

private:
  /// Which bursts of a channel's data bus are taken: a ring of slots of one
  /// burst each, numbered from the beginning of time.
  class Bus {
  public:
    /// Takes the first \p Length free slots in a row from slot \p First on.
    uint64_t take(uint64_t First, unsigned Length);

  private:
    static constexpr uint64_t Slots = 4096;
    bool isFree(uint64_t Slot);
    uint64_t Taken[Slots] = {}; ///< number of the slot that took it, plus 1
    uint64_t Oldest = 0;        ///< slots before are gone
  };
  struct Bank {
    bool IsOpen = false;
    uint32_t Row = 0;
    uint64_t ActivateAt = 0; ///< earliest next
    uint64_t ColumnAt = 0;
    uint64_t PrechargeAt = 0;
  };
  struct Channel {
    std::vector<Bank> Banks;
    Bus Data;
    uint64_t Activations[4] = {}; ///< the last four, oldest at Next
    unsigned NextActivation = 0;
    uint64_t LastActivation = 0;
    bool AnyActivation = false;
    uint64_t ReadAfterWriteAt = 0;
    uint64_t RefreshEpoch = 0;
  };

  uint64_t afterRefresh(Channel &C, uint64_t Now);
  uint64_t activate(Channel &C, uint64_t Wanted);

  const DramTiming P;
  unsigned BurstsPerLine;
  std::vector<Channel> Channels;
  DramTime Counted;
};

} // namespace vorion::isasim
