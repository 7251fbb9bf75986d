/// The result of a run of the machine. A fault or hang of the guest is a result
/// and never terminates the host.
#pragma once

#include "vorion/isasim/Counters.h" // generated from intrinsics/Counters.td
#include "vorion/isasim/SourcePlace.h"
#include "vorion/isasim/Timing.h"
#include "vorion/isasim/TrapCause.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::isasim {

enum class Outcome {
  Done,         ///< every warp ended, exit code 0
  GuestFailed,  ///< every warp ended, exit code not 0
  Trap,         ///< a fault; see RunResult::Fault
  Hang,         ///< no warp can ever go on; the report says what each waits for
  LimitReached, ///< Config::MaxInstructions, Machine::setWatchdog
};

/// "load access fault" and so on.
std::string_view describe(TrapCause Cause);
std::string_view describe(Outcome O);

/// Location and reason of a warp's stop.
struct Trap {
  TrapCause Cause = TrapCause::IllegalInstruction;
  uint32_t Pc = 0;
  unsigned Core = 0;
  unsigned Warp = 0;
  uint32_t LaneMask = 0;    ///< active lanes
  unsigned Lane = 0;        ///< the lowest lane that faulted
  uint32_t Address = 0;     ///< accessed address or jump target, else 0
  uint32_t Instruction = 0; ///< the word at Pc, 0 where it cannot be fetched
  std::string Symbol;       ///< "function+0x1c", empty where none covers Pc
  std::vector<SourcePlace> Source; ///< of Pc, innermost first
};

/// A counter by name, for tables.
struct NamedCounter {
  const char *Group; ///< "core" or "raster"
  const char *Name;
  const char *Doc;
  uint64_t Value;
};
struct RunResult;
/// All totals of \p R, in the order of intrinsics/Counters.td.
std::vector<NamedCounter> counters(const RunResult &R);

struct RunResult {
  Outcome End = Outcome::Done;
  /// The value stored to the exit word, 0 if there was no store.
  uint32_t ExitCode = 0;
  Trap Fault; ///< meaningful for Outcome::Trap
  /// For Trap, Hang and LimitReached: a report of several lines, each
  /// terminated by a newline. Empty otherwise.
  std::string Report;

  CoreCounters Total;
  std::vector<CoreCounters> Cores;
  RasterCounters Raster; ///< over all rasterizers and pixel units
  /// The time report; empty without Config::Timing.Enabled.
  std::optional<TimeReport> Time;
  uint64_t SyncPoints = 0;   ///< times all cores were parked
  double HostSeconds = 0;    ///< wall time of the run
  double HostCpuSeconds = 0; ///< processor time of the host in it, all threads
};

/// Outcome, counters and fault as a JSON object.
std::string toJson(const RunResult &R);

} // namespace vorion::isasim
