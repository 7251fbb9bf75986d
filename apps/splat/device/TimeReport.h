/// How long a kernel took on the machine, and why: what the device reports
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

/// The counts of one unit.
template <typename Count> struct UnitCounts {
  std::array<uint64_t, CountNames<Count>.size()> Values{};

  uint64_t operator[](Count C) const {
    return Values[static_cast<std::size_t>(C)];
  }
  UnitCounts &operator+=(const UnitCounts &Other) {
    for (std::size_t I = 0; I != Values.size(); ++I)
      Values[I] += Other.Values[I];
    return *this;
  }
};

/// What launches and copies cost beside a kernel's run.
struct HostTiming {
  unsigned LaunchNs = 0, CopyNs = 0;
  unsigned CopyMbps = 0; ///< megabytes a second
  unsigned DramBurstBytes = 0;
};

/// Of a lane's units, um^2, by the numbers of the units (docs/isa.md).
struct LaneAreas {
  std::vector<double> Exponential, Blend;
  std::vector<double> Reciprocal; ///< of a pair of lanes
  double Other = 0;               ///< what every lane has
};

/// Events of a unit, for other people's energy models.
struct Activity {
  std::string Unit, Event;
  uint64_t Count = 0;
};

/// What the times of the DRAM's commands were taken from.
struct DramTable {
  std::string File; ///< empty for one that came with the simulator
  std::string Hash;
};

/// Of one kernel, or of several one after the other.
struct TimeReport {
  uint64_t Cycles = 0;
  unsigned ClockMhz = 1;
  unsigned ClockVersion = 0; ///< times of different versions do not compare
  std::string Machine;       ///< its name; with changes, if it has any
  std::vector<std::string> MachineChanges; ///< KEY=VALUE
  DramTable TableOfDram;
  HostTiming Host;
  LaneAreas Areas;
  std::vector<UnitCounts<CoreCount>> Cores;
  std::vector<UnitCounts<RasterCount>> Rasterizers;
  std::vector<UnitCounts<PixelCount>> PixelUnits;
  std::vector<UnitCounts<CacheCount>> L2; ///< slices
  UnitCounts<CacheCount> Llc;
  UnitCounts<DramCount> Dram;
  std::vector<Activity> Activities;
  uint64_t StaleLoads = 0;   ///< that missed a write, of data caches
  uint64_t CommandsLeft = 0; ///< that go on in the next run
  uint64_t OutOfOrder = 0;

  /// What comes after this on the same machine: counts and cycles are added,
  /// of what is left the later one counts.
  TimeReport &operator+=(const TimeReport &Later);
};

/// Adds \p Later, where there is one, to \p Sum, which begins as nothing.
void add(std::optional<TimeReport> &Sum,
         const std::optional<TimeReport> &Later);

/// Reads what the device says. Every member must be there and no other, so
/// that nothing is lost on the way into reports.
Expected<TimeReport> parseTimeReport(std::string_view Text);

/// As reports have it: what parseTimeReport() reads.
nlohmann::ordered_json toJson(TimeReport R);

} // namespace vorion::splat
