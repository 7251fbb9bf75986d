/// One machine, who holds its memory, and the run in progress.
#pragma once

#include "Allocator.h"
#include "Failure.h"
#include "LoadedImage.h"
#include "vorion/isasim/Launch.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Session.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

namespace vorion::runtime {

/// Implements vorion/runtime.h, whose thread rule it keeps: one lock guards all
/// state, and a run holds \c Running instead of the lock, so that allocation
/// goes on beside it. Arguments that are pointers have been checked for NULL.
class Device {
public:
  /// \p OnlyProfiled: a clock goes on in profiled runs only.
  Device(std::unique_ptr<isasim::Machine> Machine,
         std::unique_ptr<isasim::Session> Watch, bool OnlyProfiled);
  ~Device();
  Device(const Device &) = delete;
  Device &operator=(const Device &) = delete;

  vx_device_info info();
  const std::string &configText() const { return ConfigText; }

  Failure allocate(uint64_t Size, uint32_t &Address);
  /// Memory with the initial values of what \p K of \p Image uses.
  Failure allocateVariables(const LoadedImage &Image, const isasim::Kernel &K,
                            uint32_t &Address);
  Failure release(uint32_t Address);
  Failure copyIn(uint32_t To, const void *From, uint64_t Size);
  Failure copyOut(void *To, uint32_t From, uint64_t Size);
  Failure copyWithin(uint32_t To, uint32_t From, uint64_t Size);
  Failure fill(uint32_t To, const void *Pattern, uint32_t PatternSize,
               uint64_t Size);
  Failure hostPointer(uint32_t Address, uint64_t Size, void **To);

  /// Tells observers what the host did through hostPointer().
  Failure hostWrote(uint32_t Address, uint64_t Size);
  Failure hostRead(uint32_t Address, uint64_t Size);
  /// Tells them how much local memory the next run's kernel has.
  void localUsed(uint64_t Bytes);

  /// \name Commands of the clock (vorion/runtime.h)
  /// @{
  Failure beginCommand(isasim::CommandOrder Order);
  Failure endCommand(uint64_t &Number);
  Failure copied(const isasim::HostCopy &Copy);
  Failure settle();
  /// @}

  /// Whether the next runs are profiled.
  void setProfiled(bool Profiled);

  /// Waits for the run in progress and forgets the image if it is loaded.
  void forget(const LoadedImage *Image);

  Failure start(LoadedImage &Image, uint32_t Kernel,
                const vx_launch_params &Params, const void *Args,
                uint32_t ArgsBytes);
  Failure startMain(LoadedImage &Image);
  Failure wait(vx_result &Result);

  const isasim::Config &config() const { return Machine->config(); }

  /// Says what of the session never came, unless a run is in progress.
  void lastWord();

private:
  using Lock = std::unique_lock<std::mutex>;
  using Notice = void (isasim::Session::*)(uint32_t, uint64_t);

  void waitForRun(Lock &Held);
  bool timesCopies() const;
  void timeCopy(isasim::HostCopy::Kind What, uint32_t Address, uint64_t Bytes,
                uint32_t From = 0);
  /// Observers hear of what the host does between runs only.
  void waitIfObserved(Lock &Held);
  void clockRuns(bool On);
  void keepConsole(std::string_view Text);
  Failure allocateLocked(uint64_t Size, const char *What, Allocator::End From,
                         uint32_t &Address, uint64_t Below = UINT64_MAX);
  /// Whether \p Address lies in the I/O window (docs/abi.md, "Memory map").
  bool isRasterWindow(uint32_t Address) const;
  /// Calls Use(core, csr, offset) for each word of a range of the window, until
  /// it returns false.
  template <typename Function>
  Failure forRasterCsrs(uint32_t Address, uint64_t Size, Function Use);
  Failure globalRange(uint32_t Address, uint64_t Size, std::byte **Bytes);
  Failure tellHost(Notice What, uint32_t Address, uint64_t Size);
  void freeRunMemory();
  void nameBuffers(const isasim::Kernel &Kernel, const void *Args);
  Failure holdStacks(const isasim::Launch &Planned);
  Failure prepare(const isasim::Launch &Planned, uint32_t Variables,
                  std::span<const std::byte> Args);
  void makeCurrent(LoadedImage &Image);
  void launch(Lock &Held, LoadedImage &Image, const std::string &Name,
              uint32_t LaunchBlock);
  void finish(isasim::RunResult Run);

  std::unique_ptr<isasim::Machine> Machine;
  std::unique_ptr<isasim::Session> Watch;
  std::string ConfigText;
  const bool OnlyProfiled;

  std::mutex Mutex;
  std::condition_variable Ended;
  Allocator Memory;
  /// Of the command that was begun, and the last before it.
  std::optional<isasim::CommandOrder> Order;
  uint64_t LastBefore = 0;
  LoadedImage *Current = nullptr; ///< the image in the machine
  isasim::LaunchParts InUse;      ///< addresses of the run's parts
  /// Where memory begins that the run's stacks cover, if they cover any.
  std::optional<uint64_t> UnderStacks;
  bool Running = false;
  bool HasStarted = false;
  std::thread Runner; ///< joined before the next run and at the end

  // The last run's result.
  isasim::RunResult Last;
  isasim::Printed Print;
  std::string ConsoleText, TimeText;
  std::string BugText; ///< of an exception out of the simulator, else empty
  uint64_t ConsoleDropped = 0;
};

} // namespace vorion::runtime
