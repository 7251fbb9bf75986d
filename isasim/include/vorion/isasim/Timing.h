/// The clock, the timing model of a run in cycles (docs/adr/0007-the-clock.md,
/// docs/model.md).
#pragma once

#include "vorion/isasim/ClockCounts.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// Version of the timing model. Incremented by every change of modelled cycles;
/// docs/model.md documents the changes, and test/timing has golden cycles of
/// small runs.
inline constexpr unsigned ClockVersion = 4;

// A structure for each group of TimingParams.def, with its defaults.
struct TimingGroups {
#define GROUP(NAME, MEMBER, WHAT)                                              \
  }                                                                            \
  ;                                                                            \
  struct MEMBER##Timing {                                                      \
    bool operator==(const MEMBER##Timing &) const = default;
#define PARAM(GROUP, OF, NAME, MEMBER, DEFAULT, LOW, HIGH, UNIT, SOURCE)       \
  uint32_t MEMBER = DEFAULT;
#define WORD(GROUP, OF, NAME, MEMBER, DEFAULT, UNIT, SOURCE)                   \
  std::string MEMBER = DEFAULT;
#include "vorion/isasim/TimingParams.def"
};

/// Names of presets of a core (CorePresets.def).
enum class CorePreset : uint8_t { Forwarding, Vortex5Stage, Vortex2025, Count };
std::string_view name(CorePreset P);
CoreTiming numbersOf(CorePreset P);

/// Object "timing" of a configuration. Affects only modelled times.
struct TimingConfig {
  bool Enabled = false;    ///< whether there is a clock at all
  uint32_t ClockMhz = 530; ///< of everything but DRAM and the host's link
  /// The preset from which Core was initialized; single values may differ.
  CorePreset Preset = CorePreset::Forwarding;
#define GROUP(NAME, MEMBER, WHAT) MEMBER##Timing MEMBER;
#include "vorion/isasim/TimingParams.def"
};

/// Bytes of a cache line and of a request to memory.
inline constexpr uint32_t TimingLineBytes = 64;

/// A parameter of TimingParams.def.
struct TimingParam {
  std::string_view Group, Name, Unit, Source;
  std::string_view Default;
  uint32_t Low, High;
  /// Accessor of a numeric value; null for a value that is a name.
  uint32_t &(*Of)(TimingConfig &);
  std::string &(*WordOf)(TimingConfig &);
};
std::span<const TimingParam> timingParams();
/// The parameters and the rasterizer's units as Markdown tables
/// (docs/model.md).
std::string timingMarkdown();

/// Event counts, the input of energy models.
struct Activity {
  std::string_view Unit, Event;
  uint64_t Count;
};

/// The time report of a run. The sum of a unit's cycles by reason is exactly \c
/// Cycles.
struct TimeReport {
  uint64_t Cycles = 0; ///< from the launch until the last core was done
  uint32_t ClockMhz = 0;
  std::string Machine;                     ///< its name (Config.h, nameOf())
  std::vector<std::string> MachineChanges; ///< from the machine of that name
  /// The DRAM timing table: its file name, empty for a built-in one, and the
  /// fnv1a64() of its text.
  std::string DramTableFile, DramTableHash;
  std::vector<CoreTime> Cores;
  std::vector<RasterTime> Rasters;
  std::vector<PixelTime> PixelUnits;
  /// \name If the machine has them (timing.host.dma_engines)
  /// @{
  std::vector<CommandTime> CommandProcessors; ///< one
  std::vector<DmaTime> DmaEngines;
  /// @}
  std::vector<CacheTime> L2;
  CacheTime Llc;
  LinkTime Link; ///< all 0 without a link
  DramTime Dram;
  std::vector<Activity> Activities;
  HostTiming Host; ///< what launches and copies cost beside the run: without
                   ///< DMA engines
  uint32_t DramBurstBytes = 0;
  /// Loads that hit data cache lines that other cores had written since.
  uint64_t StaleLoads = 0;
  /// Tile commands without a wait: they continue in the next run.
  uint64_t CommandsLeft = 0;
  /// Number of times that a trace exceeded its bound, so that the order was
  /// estimated.
  uint64_t OutOfOrder = 0;
};

/// As a JSON object.
std::string toJson(const TimeReport &R);
/// As a table.
std::string toText(const TimeReport &R);

} // namespace vorion::isasim
