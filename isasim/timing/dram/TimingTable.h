/// What a DRAM standard says about time: a row a constraint. A table is a JSON
/// file (standards/), so that a device is described by data alone.
#pragma once

#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim::dram {

/// What a controller sends to a device.
enum class Command : uint8_t {
  Activate,     ///< opens a row of a bank
  Precharge,    ///< closes a bank's row
  PrechargeAll, ///< closes all rows of a rank
  Read,         ///< a burst of the open row
  Write,
  Refresh,     ///< of all banks of a rank, which are closed
  RefreshBank, ///< of one bank, which is closed
  Activate2,   ///< the second half of an activation of two commands
  Count
};
inline constexpr size_t Commands = size_t(Command::Count);
/// As tables and traces call it: "ACT".
std::string_view name(Command C);

/// Between which commands a constraint holds: those to the same ... .
enum class Scope : uint8_t {
  Bank,
  BankGroup,
  Rank,
  Channel,
  OtherRanks, ///< the first to one rank, the second to another
  Count
};
std::string_view name(Scope S);

/// \c To comes at least \c Ticks after the last \c From or, with a window of n,
/// after the n-th last: n + 1 of them never lie within \c Ticks.
struct Constraint {
  Command From, To;
  Scope Within;
  uint32_t Ticks;
  uint32_t Window = 1;
};

/// A checked table. Times are ticks of the device's command clock; a command
/// happens at its last tick, as standards count.
struct TimingTable {
  std::string Standard;
  std::string Hash; ///< fnv1a64() of the text
  uint32_t TickPs = 0;
  uint32_t Ranks = 0, BankGroups = 0, BanksPerGroup = 0;
  uint32_t Rows = 0, RowBytes = 0, BurstBytes = 0;
  uint32_t ReadLatency = 0;  ///< from the command until the first byte
  uint32_t WriteLatency = 0; ///< likewise
  uint32_t BurstTicks = 0;   ///< for which a burst takes the data bus
  /// Between refreshes of a rank, and of one bank after another; the latter is
  /// 0 where the standard has none.
  uint32_t RefreshInterval = 0, BankRefreshInterval = 0;
  /// For which a command takes the command bus.
  std::array<uint32_t, Commands> CommandTicks{};
  /// If an activation is two commands: the second comes at most so many ticks
  /// after the first, from which all other times count. Other commands may
  /// come in between, but for another activation.
  uint32_t SecondActivateWithin = 0;
  /// Whether reads and writes have a command bus of their own.
  bool HasColumnBus = false;
  std::vector<Constraint> Constraints;

  uint32_t banksPerRank() const { return BankGroups * BanksPerGroup; }
  uint32_t banks() const { return Ranks * banksPerRank(); }
  /// Bytes a nanosecond that the data bus carries.
  double peakBandwidth() const;
  /// The strictest constraint of two commands to the same bank, 0 for none.
  uint32_t sameBank(Command From, Command To) const;
};

/// Reads a table and refuses one with a missing or impossible constraint, by
/// its key. \p Where names the text in messages.
Expected<TimingTable> parseTimingTable(std::string_view Text,
                                       const std::string &Where);
Expected<TimingTable> readTimingTable(const std::string &Path);

/// The names of the tables that come with the simulator.
std::span<const std::string_view> standards();
/// What reports call \p Standard, as the configuration has it: its name, or "of
/// a file". Lives as long as reports do.
std::string_view reportName(std::string_view Standard);
/// One of them; an error if there is none of that name.
Expected<TimingTable> standardTable(std::string_view Name);

} // namespace vorion::isasim::dram
