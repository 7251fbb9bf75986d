/// What watches the clock without changing it: one interface for what is drawn
/// and written of a run's time. Every function does nothing by default. The
/// clock knows no observer by name.
#pragma once

#include "raster/WorkLog.h"

#include <cstdint>
#include <vector>

namespace vorion::isasim {

/// A stretch of time, in cycles since the machine was made. The clock stands
/// still between runs.
struct CycleSpan {
  uint64_t From = 0, Until = 0;
};

/// Calls come one at a time, on the thread of Machine::run. Those about one
/// unit come in the order of its time; units are as far as the clock has taken
/// them.
class TimeObserver {
public:
  virtual ~TimeObserver() = default;

  /// A rasterizer was busy with a command, or a pixel unit with the rest of
  /// one. May come in a later run than the command's start.
  virtual void tile(const raster::CommandWork &, CycleSpan) {}
  virtual void tileRest(const raster::TailWork &, CycleSpan) {}
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
