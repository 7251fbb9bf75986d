/// The clock: what a run costs in cycles (docs/adr/0007-the-clock.md,
/// docs/model.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

/// Of the clock as a whole. Every change of what a run takes raises it;
/// docs/model.md says what changed and why, and test/timing holds the cycles of
/// small runs to it.
inline constexpr unsigned ClockVersion = 3;

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

/// Names of sets of numbers for a core (CorePresets.def).
enum class CorePreset : uint8_t { Forwarding, Vortex5Stage, Vortex2025, Count };
std::string_view name(CorePreset P);
CoreTiming numbersOf(CorePreset P);

/// Object "timing" of a configuration. Changes how long things take and
/// nothing else.
struct TimingConfig {
  bool Enabled = false;    ///< whether there is a clock at all
  uint32_t ClockMhz = 530; ///< of everything but DRAM and the host's link
  /// Where the numbers of Core began; single ones may differ by now.
  CorePreset Preset = CorePreset::Forwarding;
#define GROUP(NAME, MEMBER, WHAT) MEMBER##Timing MEMBER;
#include "vorion/isasim/TimingParams.def"
};

/// Bytes of a cache line and of a request to memory.
inline constexpr uint32_t TimingLineBytes = 64;

/// A parameter of TimingParams.def, for whatever is made from the list.
struct TimingParam {
  std::string_view Group, Name, Unit, Source;
  std::string_view Default;
  uint32_t Low, High;
  /// A number, or else a word.
  uint32_t &(*Of)(TimingConfig &);
  std::string &(*WordOf)(TimingConfig &);
};
std::span<const TimingParam> timingParams();
/// The parameters and the rasterizer's units as Markdown tables
/// (docs/model.md).
std::string timingMarkdown();

/// What a cycle of a core went to: it issued an instruction, or waited.
enum class CoreCycle : uint8_t {
  Issue,
  Start,      ///< for reset at the launch
  Fetch,      ///< for the warp's next instruction
  Operand,    ///< for a result of an ALU or SFU
  Memory,     ///< for a value from global memory
  Local,      ///< for a value from local memory
  Unit,       ///< for a unit that was busy
  LsuQueue,   ///< for a place among the accesses in flight
  Branch,     ///< for the front end after a branch
  Divergence, ///< for the front end after what changes the active lanes
  Fence,      ///< for its accesses to be done
  RasterFull, ///< for a place in the rasterizer's queue
  RasterWait, ///< for the rasterizer to finish
  Barrier,    ///< for other cores at a barrier
  Ended,      ///< nothing left to do while others still run
  Count
};
/// What a cycle of a rasterizer went to.
enum class RasterCycle : uint8_t {
  Blend,  ///< lanes were given pixels
  Clip,   ///< a Gaussian that misses the tile was dropped
  Fetch,  ///< waited for a Gaussian's record
  Hazard, ///< waited for a pixel that was still being updated
  Begin,  ///< took a command and cleared or loaded the pixel buffer
  Flush,  ///< waited for the lanes to empty
  Drain,  ///< wrote the tile, or waited for a core to take gradients
  Idle,   ///< had no command
  Count
};
/// What a cycle of a pixel unit went to.
enum class PixelCycle : uint8_t {
  Evaluate, ///< lanes were given a Gaussian
  Fetch,    ///< waited for a Gaussian's record
  Load,     ///< waited for the hand-over's record or pixels
  Store,    ///< emptied the lanes and wrote the last pixels
  Idle,     ///< had no hand-over
  Count
};
std::string_view name(CoreCycle C);
std::string_view name(RasterCycle C);
std::string_view name(PixelCycle C);

struct CoreTime {
  std::array<uint64_t, size_t(CoreCycle::Count)> Cycles{};
};
struct RasterTime {
  std::array<uint64_t, size_t(RasterCycle::Count)> Cycles{};
  uint64_t Commands = 0, Gaussians = 0, Clipped = 0;
  uint64_t LaneSlots = 0; ///< pixels given to lanes
};
struct PixelTime {
  std::array<uint64_t, size_t(PixelCycle::Count)> Cycles{};
  uint64_t Tails = 0;
  uint64_t Visits = 0; ///< Gaussians examined, summed over pixels
};
struct CacheTime {
  uint64_t Reads = 0, Writes = 0, Atomics = 0; ///< requests of a line
  uint64_t Hits = 0;                           ///< of all requests
  uint64_t Merged = 0;     ///< misses of a line already on its way
  uint64_t Writebacks = 0; ///< dirty lines sent down
  uint64_t Kept = 0;       ///< victims that the intersect hint spared
  uint64_t BankCycles = 0; ///< that requests waited for a bank
  uint64_t MshrCycles = 0; ///< that misses waited for an MSHR
};
struct DramTime {
  uint64_t Reads = 0, Writes = 0; ///< bursts
  /// Bursts whose row was open, whose bank was closed, whose bank had another
  /// row open, when they were first taken up.
  uint64_t RowHits = 0, RowMisses = 0, RowConflicts = 0;
  uint64_t Forwarded = 0; ///< lines read from writes that waited
  uint64_t Activations = 0;
  uint64_t Drains = 0; ///< times that writes were begun to be drained
  uint64_t Refreshes = 0;
  uint64_t BusPs = 0; ///< that data buses were in use, summed over channels
};

/// Bytes that went over the link to the L2.
struct LinkTime {
  uint64_t ToL2 = 0, FromL2 = 0;
};

/// Events for other people's energy models; what an event is worth in joules
/// is not said here.
struct Activity {
  std::string_view Unit, Event;
  uint64_t Count;
};

/// What a run took. Sums over a unit's cycles are exactly \c Cycles.
struct TimeReport {
  uint64_t Cycles = 0; ///< from the launch until the last core was done
  uint32_t ClockMhz = 0;
  std::string Machine;                     ///< its name (Config.h, nameOf())
  std::vector<std::string> MachineChanges; ///< from the machine of that name
  /// Of the DRAM: the file's name, empty if it came with the simulator, and
  /// fnv1a64() of what it says.
  std::string DramTableFile, DramTableHash;
  std::vector<CoreTime> Cores;
  std::vector<RasterTime> Rasters;
  std::vector<PixelTime> PixelUnits;
  std::vector<CacheTime> L2;
  CacheTime Llc;
  LinkTime LinkBytes; ///< counted if there is a link
  DramTime Dram;
  std::vector<Activity> Activities;
  HostTiming Host; ///< what launches and copies cost beside the run
  uint32_t DramBurstBytes = 0;
  /// Loads that hit lines of a data cache which others had written since.
  uint64_t StaleLoads = 0;
  /// Tile commands that nobody has waited for: they go on in the next run.
  uint64_t CommandsLeft = 0;
  /// Times that a trace grew beyond its bound, so that order was guessed.
  uint64_t OutOfOrder = 0;
};

/// As a JSON object.
std::string toJson(const TimeReport &R);
/// As a table.
std::string toText(const TimeReport &R);

} // namespace vorion::isasim
