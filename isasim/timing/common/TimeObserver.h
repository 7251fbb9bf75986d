/// What watches the clock without changing it: one interface for what is drawn
/// and written of a run's time. Every function does nothing by default. The
/// clock knows no observer by name.
#pragma once

#include "timing/dram/Controller.h"
#include "vorion/isasim/Timing.h"

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace vorion::raster {
struct CommandWork;
struct TailWork;
} // namespace vorion::raster

namespace vorion::isasim {

/// A stretch of time, in cycles of the chip since the machine was made. The
/// clock stands still between runs.
struct CycleSpan {
  uint64_t From = 0, Until = 0;
};

/// A bank of a cache.
struct BankPlace {
  bool IsLlc = false; ///< of the last-level cache, else of an L2 slice
  unsigned Slice = 0; ///< by cluster
  unsigned Bank = 0;
};

/// What a core spent cycles on.
struct CoreSpent {
  /// No instruction: the core starts, or has ended.
  static constexpr uint32_t NoInstruction =
      std::numeric_limits<uint32_t>::max();
  unsigned Core = 0;
  CoreCycle What = CoreCycle::Issue;
  CycleSpan When;
  /// That issues, or that waits to: its number in the program's code.
  uint32_t Instruction = NoInstruction;
};

/// An instruction that a core has issued.
struct CoreIssued {
  /// Of what memory has not answered yet; loadDone() tells it.
  static constexpr uint64_t Unknown = std::numeric_limits<uint64_t>::max();
  unsigned Core = 0, Warp = 0;
  uint32_t Instruction = 0; ///< as of CoreSpent
  uint64_t Serial = 0;      ///< counts what the core issues in a run
  uint64_t At = 0;
  uint64_t ResultAt = 0; ///< what needs its result can issue
};

/// Calls come one at a time, on the thread of Machine::run. Those about one
/// unit come in the order of its time; units are as far as the clock has taken
/// them. What a unit spends adds up to all cycles of its run.
class TimeObserver {
public:
  virtual ~TimeObserver() = default;

  /// A run, from the launch until the last core was done.
  virtual void timeBegins(uint64_t /*Now*/) {}
  virtual void timeEnds(uint64_t /*Now*/) {}

  virtual void coreSpent(const CoreSpent &) {}
  /// Behind what was spent on it.
  virtual void coreIssued(const CoreIssued &) {}
  /// The access that was issued as number \p Serial has its result.
  virtual void loadDone(unsigned /*Core*/, uint64_t /*Serial*/,
                        uint64_t /*ResultAt*/) {}
  virtual void rasterSpent(unsigned /*Socket*/, RasterCycle, CycleSpan) {}
  virtual void pixelSpent(unsigned /*Cluster*/, PixelCycle, CycleSpan) {}
  virtual void commandSpent(CommandCycle, CycleSpan) {}
  virtual void dmaSpent(unsigned /*Engine*/, DmaCycle, CycleSpan) {}

  /// A rasterizer was busy with a command, or a pixel unit with the rest of
  /// one (raster/WorkLog.h). May come in a later run than the command's start.
  virtual void tile(const raster::CommandWork &, CycleSpan) {}
  virtual void tileRest(const raster::TailWork &, CycleSpan) {}

  /// A direction of the link to the L2 carried a message.
  virtual void linkBusy(bool /*IsToL2*/, CycleSpan) {}
  /// A bank worked on a request, or waited for an MSHR and took no other.
  virtual void bankBusy(BankPlace, CycleSpan) {}
  /// A line went to a DRAM channel's controller.
  virtual void dramRequest(unsigned /*Channel*/, uint32_t /*Address*/,
                           bool /*IsWrite*/) {}
  /// A controller has issued a command. \p Data is when its data took the bus,
  /// if it had any.
  virtual void dramCommand(unsigned /*Channel*/, const dram::Issued &,
                           CycleSpan /*Data*/) {}
};

/// The observers of a clock. Its units have a pointer to this, which is null
/// where nobody watches.
class TimeWatch {
public:
  explicit TimeWatch(std::vector<TimeObserver *> All)
      : Observers(std::move(All)) {}

  /// Calls F on every observer.
  template <typename Function> void tell(Function F) const {
    for (TimeObserver *O : Observers)
      F(*O);
  }

private:
  std::vector<TimeObserver *> Observers;
};

} // namespace vorion::isasim
