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
/// a device does. Device::open() does it where nobody has.
void loadPlatforms();

/// The end of messages about a possibly incomplete installation.
inline constexpr std::string_view SeeDoctor =
    "(run splat doctor for a diagnosis)";

/// An opened device with its context and its in-order queues.
class Device {
public:
  /// Opens the first device whose name contains \p Wanted, or, where that is
  /// empty, "Vorion", or else the first device there is. The error lists what
  /// was found, or says why a Vorion platform has no device. \p Options are for
  /// that platform alone.
  static Expected<Device> open(const std::string &Wanted,
                               const DeviceOptions &Options = {});

  const cl::Context &context() const { return Context; }
  /// \p Profiled: the one whose kernels are clocked where the option
  /// VORION_TIME is "profiled". What is given to one queue must have ended
  /// before something is given to the other.
  const cl::CommandQueue &queue(bool Profiled = false) const {
    return Profiled ? ProfiledQueue : Queue;
  }
  const cl::Device &handle() const { return Handle; }
  /// What it was opened with.
  const DeviceOptions &options() const { return Options; }
  /// Why the last command failed, in the platform's words; empty where it does
  /// not say. A second call gives nothing.
  std::string takeMessage() const;

  const std::string &name() const { return Name; }
  /// Device and driver version, and the platform's.
  std::string version() const;
  /// Whether it has a rasterizer and counters (extension cl_vorion).
  bool isVorion() const { return EventInfo != nullptr; }
  unsigned computeUnits() const { return ComputeUnits; }
  /// Work-groups that run at the same time, of a kernel without a rasterizer.
  unsigned groupsAtOnce() const { return ComputeUnits * WarpsPerCore; }
  /// Work-items that a core steps together, in order where they meet in local
  /// memory (docs/abi.md); 1 on a device that says nothing of its order.
  unsigned lanes() const { return Lanes; }
  uint64_t globalBytes() const { return GlobalBytes; }
  uint64_t largestAllocation() const { return LargestAllocation; }

  /// The counters of an ended kernel; nothing where the device has none.
  std::optional<KernelCounters> counters(const cl::Event &Event) const;
  /// How long an ended kernel took on the machine; nothing where the device has
  /// no clock or it is off. An Error if the device says what cannot be read.
  Expected<std::optional<TimeReport>> timeReport(const cl::Event &Event) const;

  /// Whether a report fits what is to be made of it: an error ends the run.
  using TimeCheck = std::function<Expected<Success>(const TimeReport &)>;
  /// Launchers ask \p Check for the first report that they get.
  void setTimeCheck(TimeCheck Check) { CheckTime = std::move(Check); }
  const TimeCheck &timeCheck() const { return CheckTime; }

private:
  struct Messages;
  Device();

  DeviceOptions Options;
  std::shared_ptr<Messages> Received; ///< before the context, which tells it
  cl::Device Handle;
  cl::Context Context;
  cl::CommandQueue Queue, ProfiledQueue;
  std::string Name;
  unsigned ComputeUnits = 1, WarpsPerCore = 1, Lanes = 1;
  uint64_t GlobalBytes = 0, LargestAllocation = 0;
  clGetEventInfoVORION_fn EventInfo = nullptr;
  TimeCheck CheckTime;
};

} // namespace vorion::splat
