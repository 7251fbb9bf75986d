/// The simulated time of a kernel with its breakdown, as the device reports it
/// (CL_EVENT_TIME_REPORT_VORION, docs/model.md).
#pragma once

#include "splat/ClockCounts.h"
#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// Of the counts of a unit, those that are reasons of its cycles.
template <typename Count> constexpr auto reasonsOf() {
  std::array<Count, Reasons<Count>.size()> All{};
  for (std::size_t N = 0; N != All.size(); ++N)
    All[N] = static_cast<Count>(N);
  return All;
}

/// The counts of one unit.
template <typename Count> struct UnitCounts {
  std::array<uint64_t, CountNames<Count>.size()> Values{};

  uint64_t operator[](Count C) const {
    return Values[static_cast<std::size_t>(C)];
  }
  bool operator==(const UnitCounts &) const = default;
  UnitCounts &operator+=(const UnitCounts &Other) {
    for (std::size_t I = 0; I != Values.size(); ++I)
      Values[I] += Other.Values[I];
    return *this;
  }
};

/// The cost of launches and copies beside the cycles; 0 if they are part of
/// these.
struct HostTiming {
  unsigned LaunchNs = 0, CopyNs = 0;
  unsigned CopyMbps = 0; ///< megabytes per second
  unsigned DramBurstBytes = 0;
};

/// Areas of a lane's units, um^2, by the numbers of the units (docs/isa.md).
struct LaneAreas {
  std::vector<double> Exponential, Blend;
  std::vector<double> Reciprocal; ///< of a pair of lanes
  double Other = 0;               ///< common to all lanes
};

/// Events of a unit, for external energy models.
struct Activity {
  std::string Unit, Event;
  uint64_t Count = 0;
};

/// The source of the DRAM timing.
struct DramTable {
  std::string File; ///< empty for a built-in table
  std::string Hash;
};

/// The time of one kernel, or of several consecutive kernels.
struct TimeReport {
  uint64_t Cycles = 0;
  unsigned ClockMhz = 1;
  unsigned ClockVersion = 0; ///< times of different versions are not comparable
  std::string Machine;       ///< its name, with changes if there are any
  std::vector<std::string> MachineChanges; ///< KEY=VALUE
  DramTable TableOfDram;
  HostTiming Host;
  LaneAreas Areas;
  std::vector<UnitCounts<CoreCount>> Cores;
  std::vector<UnitCounts<RasterCount>> Rasterizers;
  std::vector<UnitCounts<PixelCount>> PixelUnits;
  /// \name Empty if the time of launches and copies is that of Host
  /// @{
  std::vector<UnitCounts<CommandCount>> CommandProcessors;
  std::vector<UnitCounts<DmaCount>> DmaEngines;
  /// @}
  std::vector<UnitCounts<CacheCount>> L2; ///< slices
  UnitCounts<CacheCount> Llc;
  UnitCounts<LinkCount> Link; ///< all 0 without a link to the L2
  UnitCounts<DramCount> Dram;
  std::vector<Activity> Activities;
  uint64_t StaleLoads = 0;   ///< loads from data caches that missed a write
  uint64_t CommandsLeft = 0; ///< commands that continue in the next run
  uint64_t OutOfOrder = 0;

  /// Adds the report of subsequent kernels on the same machine: counts and
  /// cycles are added; remaining commands are those of the later report.
  TimeReport &operator+=(const TimeReport &Later);
};

/// Adds \p Later, if it is set, to \p Sum, which is initially empty.
void add(std::optional<TimeReport> &Sum,
         const std::optional<TimeReport> &Later);

/// Parses a report of the device. All members must be present and no others, so
/// that reports lose no information.
Expected<TimeReport> parseTimeReport(std::string_view Text);

/// The format in reports, which parseTimeReport() reads.
nlohmann::ordered_json toJson(TimeReport R);

} // namespace vorion::splat
