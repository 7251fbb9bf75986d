/// Builds programs and runs kernels sequentially, and records times and
/// counters.
#pragma once

#include "device/BuildRecord.h"
#include "device/CompileNotice.h"
#include "device/Device.h"
#include "device/Launch.h"
#include "device/Program.h"
#include "device/Stage.h"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace vorion::splat {

/// Built programs by source and options, shared by launchers of a device.
using ProgramCache = std::map<std::pair<std::string, std::string>, cl::Program>;

/// The sums over all launches of a kernel in a stage.
struct KernelReport {
  std::string Name;
  unsigned Launches = 0;
  double Seconds = 0; ///< host wall time from launch to end
  std::optional<KernelCounters> Counters;
  std::optional<TimeReport> Time; ///< sum over the launches, if all have one
};

/// The work of a stage.
struct StageReport {
  Stage Kind;
  double Seconds = 0; ///< host wall time, including copies and compilation
  std::vector<KernelReport> Kernels;
  unsigned Copies = 0; ///< between host and device
  uint64_t CopiedBytes = 0;
};

/// A copy from the device that was begun. Keeps the buffer.
struct PendingRead {
  std::string What; ///< for errors
  cl::Buffer From;
  cl::Event Done;
  const float *At = nullptr; ///< null if there is nothing to read
  uint64_t Words = 0;
};

/// Runs kernels synchronously. After the first error, all further calls do
/// nothing, so that callers check \c failure() only before they use data that
/// was read back. Not thread-safe.
class Launcher {
public:
  /// \p Listener, if set, is called with the name of each stage at its start.
  /// \p Folder, if not empty, has the kernel sources in place of the embedded
  /// ones. \p Shared, if set, caches built programs, and must outlive the
  /// launcher.
  Launcher(const Device &D, std::string Folder,
           std::function<void(std::string_view)> Listener,
           ProgramCache *Shared = nullptr);

  const std::optional<Error> &failure() const { return Failure; }
  /// Sets the error to \p E, unless there is one.
  void fail(Error E) {
    if (!Failure)
      Failure = std::move(E);
  }
  /// The compiler's messages if \c build failed.
  const std::string &buildLog() const { return BuildLog; }

  /// Whether subsequent kernels are profiled (Device::queue()); initially not.
  void setProfiled(bool P) { Profiled = P; }

  /// Starts a stage, which must precede all other work.
  void beginStage(Stage Kind);
  /// The number of stages.
  std::size_t stages() const { return Stages.size(); }
  /// Ends the last stage and returns all stages.
  std::vector<StageReport> takeStages();

  /// Builds \p Spec, which replaces the program of the same file.
  void build(const ProgramSpec &Spec);

  /// Whether \p Spec has been built and run on this computer, in this process
  /// or before.
  bool wasBuilt(const ProgramSpec &Spec) const;
  /// Records that the built programs have run.
  void recordBuilds() const;

  /// Runs a kernel of a built program with \p Global work-items in groups of \p
  /// Local, and waits for it.
  template <KernelLaunch Kernel>
  void run(const cl::NDRange &Global, const cl::NDRange &Local,
           const Kernel &Launch) {
    if (Failure)
      return;
    cl_int Status = CL_SUCCESS;
    cl::Kernel K(Programs.at(Launch.ProgramFile), Launch.KernelName, &Status);
    std::apply(
        [&](const auto &...Arguments) {
          cl_uint Index = 0;
          (set(K, Index, Arguments, Status), ...);
        },
        Launch.arguments());
    if (Status != CL_SUCCESS) {
      Failure =
          clError(std::string("preparing kernel ") + Launch.KernelName, Status);
      return;
    }
    launch(K, Launch.KernelName, Global, Local);
  }

  /// Sets the remedy in messages about insufficient device memory; the default
  /// is "a smaller scene or picture".
  void setRemedy(std::string Text) { Remedy = std::move(Text); }
  /// \p What names the buffer in errors ("Gaussians").
  cl::Buffer allocate(std::string_view What, uint64_t Bytes);
  void write(std::string_view What, const cl::Buffer &To, const void *From,
             uint64_t Bytes);
  /// Reads from byte \p Offset of \p From on.
  void read(std::string_view What, void *To, const cl::Buffer &From,
            uint64_t Bytes, uint64_t Offset = 0);

  /// \name The same in mapped memory, without a second copy
  /// @{
  /// \p Fill must write all of the first \p Words of \p To.
  void writeInPlace(std::string_view What, const cl::Buffer &To, uint64_t Words,
                    const std::function<void(std::span<float>)> &Fill);
  /// \p Use reads the first \p Words of \p From.
  void readInPlace(std::string_view What, const cl::Buffer &From,
                   uint64_t Words,
                   const std::function<void(std::span<const float>)> &Use);
  /// The same in two steps. What is run between them does not wait for the
  /// copy, and must not change the buffer.
  PendingRead startReading(std::string_view What, const cl::Buffer &From,
                           uint64_t Words);
  void finishReading(const PendingRead &Read,
                     const std::function<void(std::span<const float>)> &Use);
  /// @}

  /// Ends an untimed section, such as an upload: later kernels do not wait for
  /// its copies.
  void settle();

  /// Peak size of the buffers from \c allocate.
  uint64_t mostBytes() const { return MostBytes; }
  const Device &device() const { return Dev; }

private:
  /// Null if progress is not reported.
  std::unique_ptr<CompileNotice>
  noticeOf(const std::string &What, std::function<bool()> IsCompiling) const;

  /// Sets argument \p Index of \p K and increments the index, unless \p Status
  /// is an error. \p Status receives the error of OpenCL.
  /// @{
  template <typename T>
  static void set(cl::Kernel &K, cl_uint &Index, const Argument<T> &A,
                  cl_int &Status) {
    if (Status == CL_SUCCESS)
      Status = K.setArg(Index++, A.value());
  }
  template <typename T>
  static void set(cl::Kernel &K, cl_uint &Index, const ArgumentByChoice<T> &A,
                  cl_int &Status) {
    if (A)
      set(K, Index, *A, Status);
  }
  /// @}
  void launch(const cl::Kernel &K, const std::string &Name,
              const cl::NDRange &Global, const cl::NDRange &Local);
  /// The errors of a failed call and of a failed launch of kernel \p Name;
  /// launchError() prints the platform's message.
  Error memoryError(std::string_view What, cl_int Status) const;
  Error launchError(const std::string &Name, cl_int Status) const;
  void account(KernelReport Report);
  /// Maps \p Words of \p B, whose contents are lost, during \p Use.
  cl_int mapped(const cl::Buffer &B, uint64_t Words,
                const std::function<void(std::span<float>)> &Use);
  /// What commands wait for that are enqueued now: all before them but copies
  /// that were begun, on whichever queue.
  const std::vector<cl::Event> *before() const {
    return Last.empty() ? nullptr : &Last;
  }
  void setLast(const cl::Event &E) { Last.assign(1, E); }
  /// Records the status of a copy of \p What; \p Way is "to" or "from".
  void checkCopy(std::string_view What, std::string_view Way, cl_int Status);
  void countCopy(uint64_t Bytes);
  void endStage();
  Expected<std::string> sourceOf(const ProgramSpec &Spec) const;
  /// The key of the program from \p Source with \p Options in the build record.
  std::string keyOf(const std::string &Source,
                    const std::string &Options) const;

  const Device &Dev;
  std::string KernelFolder;
  std::function<void(std::string_view)> Progress;
  std::set<std::string> Started; ///< kernels, by name
  ProgramCache *Shared;
  std::map<std::string, cl::Program> Programs;
  BuildRecord Record;
  std::vector<std::string> BuiltKeys;
  std::optional<Error> Failure;
  std::string BuildLog;
  bool Profiled = false;
  std::vector<cl::Event> Last; ///< of the last command, if there was one
  bool TimeChecked = false;    ///< Device::timeCheck()
  std::vector<StageReport> Stages;
  std::chrono::steady_clock::time_point StageStart;
  std::string Remedy = "a smaller scene or picture";
  uint64_t MostBytes = 0;
  /// Shared with the buffers, which may outlive the launcher.
  std::shared_ptr<std::atomic<uint64_t>> InUse =
      std::make_shared<std::atomic<uint64_t>>(0);
};

} // namespace vorion::splat
