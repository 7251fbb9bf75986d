/// The simulated device: cores, rasterizers, memory. A device can be loaded and
/// run any number of times; memory keeps its contents between runs. Not
/// thread-safe: one call at a time (a run uses internal host threads).
#pragma once

#include "vorion/isasim/Config.h"
#include "vorion/isasim/HostCommand.h"
#include "vorion/isasim/Image.h"
#include "vorion/isasim/Result.h"
#include "vorion/support/Expected.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace vorion::isasim {

class Observer;
class TimeObserver;

/// Mode of the timing model in a run.
enum class Clocking {
  Off,    ///< the run takes no time, and leaves the clock's caches as they were
  WarmUp, ///< it goes on, but nobody is told: no RunResult::Time, no observer
  On,
};

class Machine {
public:
  /// Creates a machine. Errors: those of validate(), or the host has not enough
  /// address space for its memory.
  static Expected<std::unique_ptr<Machine>> create(const Config &C);
  ~Machine();
  Machine(const Machine &) = delete;
  Machine &operator=(const Machine &) = delete;

  const Config &config() const;

  /// Loads \p Program and replaces the previous image: read-only and
  /// initialised data are written, .bss is zeroed. Loading the same image again
  /// resets its data.
  void load(std::shared_ptr<const Image> Program);
  /// The loaded image, or nullptr.
  const std::shared_ptr<const Image> &image() const;

  /// Host pointer to [Address, Address + Bytes) in global memory, or nullptr if
  /// the range is not completely global memory. Valid for the lifetime of the
  /// machine. During a run, only memory that the program does not access may be
  /// used.
  std::byte *hostPointer(uint32_t Address, uint64_t Bytes);
  /// Copies from or to global memory, the image or the stacks; false if the
  /// range is not mapped or crosses the border of a region.
  bool read(uint32_t Address, std::span<std::byte> To) const;
  bool write(uint32_t Address, std::span<const std::byte> From);
  bool fill(uint32_t Address, uint64_t Bytes, std::byte Value);

  /// Resets all cores and runs the loaded image from its entry point with
  /// mscratch = \p LaunchBlock (0 for none) until all warps have ended or the
  /// run fails. Local memory starts zeroed; rasterizers keep their CSRs from
  /// one run to the next, and are reset by a run that traps, hangs or reaches
  /// its limit. Without an image the result is a fetch fault.
  RunResult run(uint32_t LaunchBlock = 0);

  /// Callback for console output of the program: complete lines in core order
  /// (docs/abi.md), during run(). Default: stdout.
  void setConsole(std::function<void(std::string_view)> Sink);

  /// Whether the build supports observers (CMake's VORION_OBSERVERS).
  static bool canBeObserved();

  /// Attaches observers to the following runs, which then use one host thread.
  /// They are notified in this order, and do not change results.
  void setObservers(std::vector<Observer *> Observers);

  /// Attaches observers of the clock (timing/common/TimeObserver.h, internal to
  /// this library) to the following runs. No effect without a clock.
  void setTimeObservers(std::vector<TimeObserver *> Observers);

  /// Sets the mode of the clock, if there is one, for the following runs;
  /// initially On. A change completes pending rasterizer commands in the timing
  /// model.
  void setClocking(Clocking Of);

  /// \name Commands of the host, for the clock of a machine with DMA engines
  /// They change nothing but times, and nothing while the clock is off. Not
  /// during a run.
  /// @{

  /// The host sends the command of a copy; returns its number, or 0 if nobody
  /// times it.
  uint64_t copies(const HostCopy &Copy, CommandOrder Order);
  /// The order of the next run's launch. Without a call it waits for all
  /// commands before it.
  void orderLaunch(CommandOrder Order);
  /// The number of the last copy or launch; 0 if there was none.
  uint64_t lastCommand() const;
  /// The host waits until all copies have ended. This time belongs to no run.
  void settle();
  /// @}

  /// Wall-clock limit of a run, which then stops with Outcome::LimitReached; 0
  /// for no limit. Checked every few thousand instructions of a core, every few
  /// thousand Gaussians of a rasterizer, and while waiting for a debugger.
  void setWatchdog(double Seconds);

  /// Stops the current run with Outcome::LimitReached. May be called from any
  /// thread or an observer.
  void requestStop();

  /// Whether a stop of the current run was requested, or the watchdog has
  /// expired. May be called from any thread.
  bool mustStop() const;

  /// The raster CSR window of docs/abi.md as the host sees it (lane 0 of a CSR
  /// that every lane has); not during a run. nullopt or false for a core or CSR
  /// that is not there or is read-only. A command started here is complete when
  /// the call returns.
  std::optional<uint32_t> readRasterCsr(unsigned Core, unsigned Csr);
  bool writeRasterCsr(unsigned Core, unsigned Csr, uint32_t Value);

  /// \name Functional state between runs
  /// The complete functional state. A machine with the same configuration
  /// continues identically from it; the state of the clock is separate. Not
  /// during a run.
  /// @{

  /// Global memory, and the stacks in their interleaved host layout.
  std::vector<std::span<std::byte>> memory() const;
  /// The writable segments of the loaded image, concatenated.
  std::vector<std::byte> imageData() const;
  /// False if the size does not match.
  bool setImageData(std::span<const std::byte> Data);
  /// State of rasterizers and Raster Agents; empty while a command is pending.
  std::optional<std::vector<std::byte>> rasterState() const;
  /// False if the state does not fit the machine.
  bool setRasterState(std::span<const std::byte> State);
  /// @}

private:
  Machine();
  struct Impl;
  std::unique_ptr<Impl> PImpl;
};

} // namespace vorion::isasim
