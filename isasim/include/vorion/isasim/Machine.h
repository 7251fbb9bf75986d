/// The simulated device: cores, rasterizers, memory. One object is one device
/// that is loaded and run any number of times; memory keeps its contents
/// between runs. Not thread-safe: one call at a time (a run uses host threads
/// of its own inside).
#pragma once

#include "vorion/isasim/Config.h"
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

/// What the clock does in a run.
enum class Clocking {
  Off,    ///< the run takes no time, and leaves the clock's caches as they were
  WarmUp, ///< it goes on, but nobody is told: no RunResult::Time, no observer
  On,
};

class Machine {
public:
  /// A machine of the given shape; errors: validate(), or the host has no
  /// address space for its memory.
  static Expected<std::unique_ptr<Machine>> create(const Config &C);
  ~Machine();
  Machine(const Machine &) = delete;
  Machine &operator=(const Machine &) = delete;

  const Config &config() const;

  /// Puts \p Program into the image range in place of what was there: read-only
  /// and initialised data are written, .bss is zeroed. Loading the image that
  /// is already loaded resets its data.
  void load(std::shared_ptr<const Image> Program);
  /// The loaded image, or nullptr.
  const std::shared_ptr<const Image> &image() const;

  /// The host's view of [Address, Address + Bytes) in global memory, or nullptr
  /// if the range is not all global memory. Valid as long as the machine. Not
  /// to be used during a run, except on memory that the program does not touch.
  std::byte *hostPointer(uint32_t Address, uint64_t Bytes);
  /// Copies from or to global memory, the image or the stacks; false if the
  /// range is not mapped or crosses from one region to another.
  bool read(uint32_t Address, std::span<std::byte> To) const;
  bool write(uint32_t Address, std::span<const std::byte> From);
  bool fill(uint32_t Address, uint64_t Bytes, std::byte Value);

  /// Resets all cores and runs the loaded image from its entry point with
  /// mscratch = \p LaunchBlock (0 for none) until all warps have ended or the
  /// run fails. Local memory starts zeroed; rasterizers keep their CSRs from
  /// one run to the next, and are reset by a run that traps, hangs or reaches
  /// its limit. Without an image the result is a fetch fault.
  RunResult run(uint32_t LaunchBlock = 0);

  /// Receives what the program writes to the console word, complete lines
  /// in core order (docs/abi.md), during run(). Default: stdout.
  void setConsole(std::function<void(std::string_view)> Sink);

  /// Whether the build has what reports to observers (CMake's
  /// VORION_OBSERVERS).
  static bool canBeObserved();

  /// The observers, told in this order, see every event of the following runs,
  /// which then use one host thread. They change no result.
  void setObservers(std::vector<Observer *> Observers);

  /// The observers of the clock (timing/common/TimeObserver.h, for those of
  /// this library) watch it in the following runs. Without a clock nothing
  /// happens.
  void setTimeObservers(std::vector<TimeObserver *> Observers);

  /// Whether the clock, where there is one, goes on in the following runs; it
  /// is On from the beginning. When it is turned off or on, rasterizers'
  /// commands that are under way are done with for it.
  void setClocking(Clocking Of);

  /// Ends a run that takes longer, with Outcome::LimitReached; 0 for no limit.
  /// Looked at every few thousand instructions of a core, every few thousand
  /// Gaussians of a rasterizer, and while a debugger is waited for.
  void setWatchdog(double Seconds);

  /// Ends the run in progress likewise. From any thread, or an observer.
  void requestStop();

  /// Whether the run in progress has been asked to end, or has taken longer
  /// than the watchdog allows. From any thread.
  bool mustStop() const;

  /// The raster CSR window of docs/abi.md as the host sees it (lane 0 of a CSR
  /// that every lane has); not during a run. nullopt or false for a core or CSR
  /// that is not there or is read-only. A command that is started here has been
  /// executed when the call returns.
  std::optional<uint32_t> readRasterCsr(unsigned Core, unsigned Csr);
  bool writeRasterCsr(unsigned Core, unsigned Csr, uint32_t Value);

  /// \name What a run leaves to the next
  /// All that function knows. A machine of the same shape that is given it goes
  /// on as this one does; the clock has state of its own. Not during a run.
  /// @{

  /// Global memory, and the stacks as they lie on the host.
  std::vector<std::span<std::byte>> memory() const;
  /// The writable segments of the loaded image, one behind the other.
  std::vector<std::byte> imageData() const;
  /// False if these have another size.
  bool setImageData(std::span<const std::byte> Data);
  /// Of rasterizers and Raster Agents; none while a command is under way.
  std::optional<std::vector<std::byte>> rasterState() const;
  /// False if it is no state of such a machine.
  bool setRasterState(std::span<const std::byte> State);
  /// @}

private:
  Machine();
  struct Impl;
  std::unique_ptr<Impl> PImpl;
};

} // namespace vorion::isasim
