/// What the host may spend on what a guest asks for (docs/guest-limits.md): one
/// place that says how many bytes, and whether the run's time is over. Whoever
/// works for a guest without executing its instructions asks here, at least
/// every few milliseconds.
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace vorion::isasim {

class HostBudget {
public:
  /// Of a core's console text that waits for its line's end. What a call of
  /// the host interface writes is handed on in pieces of as much.
  static constexpr size_t ConsoleBytes = 64 << 10;
  /// \name Records for the clock, of a machine
  /// @{
  /// Of what rasterizers and pixel units have fetched: half for each kind,
  /// divided among the units. A pixel unit may exceed it by one command.
  static constexpr size_t FetchBytes = 512 << 20;
  /// Of what cores have executed, divided among them. A core may exceed it by
  /// what it executes between two points where all cores are parked.
  static constexpr size_t TraceBytes = size_t{1} << 30;
  /// @}

  /// Ends a run that takes longer; 0 for no limit.
  void setWatchdog(double SecondsIn) { Watchdog = SecondsIn; }
  /// Ends the run in progress. From any thread.
  void requestStop() { StopRequested.store(true, std::memory_order_relaxed); }

  void beginRun();
  void endRun() { Running = false; }
  bool isRunning() const { return Running; }
  double secondsSoFar() const;

  /// Whether the present or last run is over its time, or was asked to end.
  /// From any thread.
  bool isOver() const;
  /// Likewise, but of a run in progress: nothing ends early between runs.
  bool mustStop() const { return Running && isOver(); }
  /// Why; empty if it is not over.
  std::string reason() const;

private:
  bool isLate() const { return Watchdog > 0 && secondsSoFar() > Watchdog; }

  double Watchdog = 0;                         ///< seconds
  std::chrono::steady_clock::time_point Begin; ///< of the run
  std::atomic<bool> StopRequested = false;
  std::atomic<bool> Running = false;
};

} // namespace vorion::isasim
