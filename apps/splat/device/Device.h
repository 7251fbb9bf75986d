/// The OpenCL device that renders.
#pragma once

#include "device/DeviceOptions.h"
#include "device/OpenCl.h"
#include "device/TimeReport.h"
#include "splat/KernelCounters.h" // generated from intrinsics/Counters.td

#include <CL/cl_vorion.h>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace vorion::splat {

/// Loads the OpenCL platforms into the process, which takes longer than opening
/// a device. Device::open() loads them if necessary.
void loadPlatforms();

/// The end of messages about a possibly incomplete installation.
inline constexpr std::string_view SeeDoctor =
    "(run splat doctor for a diagnosis)";

/// An opened device with its context and its in-order queues.
class Device {
public:
  /// Opens the first device whose name contains \p Wanted. If \p Wanted is
  /// empty, opens the first Vorion device, or otherwise the first device. The
  /// error lists the devices, or the reason why a Vorion platform has none. \p
  /// Options apply only to that platform.
  static Expected<Device> open(const std::string &Wanted,
                               const DeviceOptions &Options = {});

  const cl::Context &context() const { return Context; }
  /// \p Profiled: the queue whose kernels are timed if VORION_TIME is
  /// "profiled". Commands on one queue must have completed before commands are
  /// enqueued on the other.
  const cl::CommandQueue &queue(bool Profiled = false) const {
    return Profiled ? ProfiledQueue : Queue;
  }
  /// A queue whose commands wait for their events alone, for copies beside
  /// kernels.
  const cl::CommandQueue &copyQueue() const { return CopyQueue; }
  const cl::Device &handle() const { return Handle; }
  /// The options that it was opened with.
  const DeviceOptions &options() const { return Options; }
  /// The platform's message about the last failed command; empty if there is
  /// none, and after the first call.
  std::string takeMessage() const;

  const std::string &name() const { return Name; }
  /// Versions of device, driver and platform.
  std::string version() const;
  /// Whether it has a rasterizer and counters (extension cl_vorion).
  bool isVorion() const { return EventInfo != nullptr; }
  unsigned computeUnits() const { return ComputeUnits; }
  /// Work-groups that run concurrently, for a kernel that does not use the
  /// rasterizer.
  unsigned groupsAtOnce() const { return ComputeUnits * WarpsPerCore; }
  /// Work-items that a core executes in lockstep, with ordered accesses to
  /// local memory (docs/abi.md); 1 for a device without a specified order.
  unsigned lanes() const { return Lanes; }
  /// Whether copies can overlap kernels in simulated time.
  bool copiesOverlap() const { return CopiesOverlap; }
  uint64_t globalBytes() const { return GlobalBytes; }
  uint64_t largestAllocation() const { return LargestAllocation; }

  /// The counters of a completed kernel; empty if the device has none.
  std::optional<KernelCounters> counters(const cl::Event &Event) const;
  /// The simulated time of a completed kernel; empty without the clock. An
  /// Error if the report is malformed.
  Expected<std::optional<TimeReport>> timeReport(const cl::Event &Event) const;

  /// A check of the first report; an error ends the run.
  using TimeCheck = std::function<Expected<Success>(const TimeReport &)>;
  /// Launchers call \p Check with their first report.
  void setTimeCheck(TimeCheck Check) { CheckTime = std::move(Check); }
  const TimeCheck &timeCheck() const { return CheckTime; }

private:
  struct Messages;
  Device();

  DeviceOptions Options;
  std::shared_ptr<Messages> Received; ///< before the context, which sends
                                      ///< messages to it
  cl::Device Handle;
  cl::Context Context;
  cl::CommandQueue Queue, ProfiledQueue, CopyQueue;
  std::string Name;
  unsigned ComputeUnits = 1, WarpsPerCore = 1, Lanes = 1;
  bool CopiesOverlap = false;
  uint64_t GlobalBytes = 0, LargestAllocation = 0;
  clGetEventInfoVORION_fn EventInfo = nullptr;
  TimeCheck CheckTime;
};

} // namespace vorion::splat
