/// How long a kernel took on the machine, and why: what the device reports
/// (CL_EVENT_TIME_REPORT_VORION, docs/model.md).
#pragma once

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

/// \name What is counted for each unit of a kind
/// The names, in the same order, are the keys of reports. Where a unit has
/// reasons for its cycles, these come first and add up to all cycles.
/// @{
template <typename Count>
inline constexpr std::array<std::string_view, 0> CountNames{};

enum class CoreCount {
  Issue,
  Start,
  Fetch,
  Operand,
  Memory,
  Local,
  Unit,
  LsuQueue,
  Branch,
  Divergence,
  Fence,
  RasterFull,
  RasterWait,
  Barrier,
  Ended
};
template <>
inline constexpr std::array CountNames<CoreCount> =
    std::to_array<std::string_view>(
        {"issue", "start", "fetch", "operand", "memory", "local", "unit",
         "lsu_queue", "branch", "divergence", "fence", "raster_full",
         "raster_wait", "barrier", "ended"});

enum class RasterCount {
  Blend,
  Clip,
  Fetch,
  Hazard,
  Begin,
  Flush,
  Drain,
  Idle,
  Commands,
  Gaussians,
  Clipped,
  LaneSlots
};
template <>
inline constexpr std::array CountNames<RasterCount> =
    std::to_array<std::string_view>(
        {"blend", "clip", "fetch", "hazard", "begin", "flush", "drain", "idle",
         "commands", "gaussians", "clipped", "lane_slots"});

enum class PixelCount { Evaluate, Fetch, Load, Store, Idle, Tails, Visits };
template <>
inline constexpr std::array CountNames<PixelCount> =
    std::to_array<std::string_view>(
        {"evaluate", "fetch", "load", "store", "idle", "tails", "visits"});

enum class CacheCount {
  Reads,
  Writes,
  Atomics,
  Hits,
  Merged,
  Writebacks,
  Kept,
  BankCycles,
  MshrCycles
};
template <>
inline constexpr std::array CountNames<CacheCount> =
    std::to_array<std::string_view>({"reads", "writes", "atomics", "hits",
                                     "merged", "writebacks", "kept",
                                     "bank_cycles", "mshr_cycles"});

enum class DramCount {
  ReadBursts,
  WriteBursts,
  RowHits,
  RowMisses,
  RowConflicts,
  Forwarded,
  Activations,
  Drains,
  Refreshes,
  BusPs
};
template <>
inline constexpr std::array CountNames<DramCount> =
    std::to_array<std::string_view>({"read_bursts", "write_bursts", "row_hits",
                                     "row_misses", "row_conflicts", "forwarded",
                                     "activations", "drains", "refreshes",
                                     "bus_ps"});
/// @}

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
