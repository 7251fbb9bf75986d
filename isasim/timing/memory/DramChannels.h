/// The DRAM below the last-level cache: channels with a controller each. Here
/// cycles of that cache become ticks of the device's clock and come back.
#pragma once

#include "timing/common/Picoseconds.h"
#include "timing/dram/AddressMap.h"
#include "timing/memory/Cache.h"

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// What timing.dram of a configuration means.
struct DramSetup {
  dram::TimingTable Table;
  dram::AddressMap Map;
  dram::ControllerOptions Options;
};
/// An error names the key that is wrong.
Expected<DramSetup> setUpDram(const DramTiming &Params);

/// Whether \p Standard, as a configuration has it, names a file.
bool isTableFile(std::string_view Standard);

class DramChannels final : public MemoryBelow {
public:
  /// A line that has been fetched.
  struct Fill {
    uint32_t Miss; ///< as the cache knows it
    uint64_t At;   ///< cycle at which it is there
  };

  /// \p Params must be what setUpDram() takes; \p Mhz is the clock of the cache
  /// above.
  DramChannels(const DramTiming &Params, uint32_t Mhz);
  DramChannels(const DramChannels &) = delete;
  DramChannels &operator=(const DramChannels &) = delete;

  std::optional<uint64_t> fetch(uint64_t Now, uint32_t Address, bool Keep,
                                uint32_t Miss) override;
  void writeBack(uint64_t Now, uint32_t Address) override;

  /// The next cycle in which something may be decided; Turn::Never if nothing
  /// is under way.
  uint64_t nextEvent() const { return NextEvent; }
  /// Goes on until lines come or to the end of cycle \p Until. Appends what
  /// has been decided, in the order of decisions.
  void advance(uint64_t Until, std::vector<Fill> &Fills);
  /// Channels that nobody asks for anything are refreshed to the end of cycle
  /// \p Until, so that time() has what was due by then. What is asked from now
  /// on comes in later cycles; whether this was called makes no difference to
  /// it.
  void idleUntil(uint64_t Until);

  uint32_t burstBytes() const { return Setup.Table.BurstBytes; }
  /// The file that the table was read from, empty for one that came along.
  const std::string &tableFile() const { return TableFile; }
  const std::string &tableHash() const { return Setup.Table.Hash; }
  /// Notifies \p Observers from now on; null for none.
  void watch(const MemoryWatch *Observers);
  /// Sums over the channels.
  DramTime time() const;
  void clearCounters();

private:
  struct Channel {
    dram::Controller Control;
    uint64_t NextEvent = dram::Never; ///< a tick
    std::vector<dram::Issued> Log;    ///< that nobody has been told of
  };
  void tellCommands();
  void submit(uint64_t Now, uint32_t Address, uint64_t Miss, bool IsWrite);
  /// The first cycle that does not begin before \p Tick, and the last tick
  /// that does not begin after \p Cycle.
  uint64_t cycleOf(uint64_t Ticks) const {
    return quotientUp(Ticks * Tick, PsTimesMhz);
  }
  uint64_t tickOf(uint64_t Cycle) const {
    return ByTick.down(Cycle * PsTimesMhz);
  }

  const DramSetup Setup;
  const std::string TableFile;
  const dram::AddressDecoder Decode;
  const uint64_t Tick; ///< ps times MHz of a tick, as PsTimesMhz of a cycle
  const Divisor ByTick;
  /// Of the controller, in front of its queues and behind the device.
  const uint64_t FrontTicks, BackTicks;
  std::deque<Channel> Channels;
  uint64_t NextEvent;
  uint64_t AdvancedTo = 0; ///< tick that all channels have come to
  uint64_t Submitted = 0;  ///< orders requests of one tick
  std::vector<dram::Reply> Replies;
  const MemoryWatch *Watch = nullptr;
};

} // namespace vorion::isasim
