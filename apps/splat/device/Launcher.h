/// Builds programs and runs kernels one after the other, keeping account.
#pragma once

#include "device/BuildRecord.h"
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
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace vorion::splat {

/// Programs that were built, by source and options, for launchers of one device
/// to share.
using ProgramCache = std::map<std::pair<std::string, std::string>, cl::Program>;

/// What one kernel did over all its launches in a stage.
struct KernelReport {
  std::string Name;
  unsigned Launches = 0;
  double Seconds = 0; ///< host wall time from launch to end
  std::optional<KernelCounters> Counters;
  std::optional<TimeReport> Time; ///< sum over the launches, if all have one
};

/// Consecutive work of one stage.
struct StageReport {
  Stage Kind;
  double Seconds = 0; ///< host wall time, copies and compilation included
  std::vector<KernelReport> Kernels;
  unsigned Copies = 0; ///< between host and device
  uint64_t CopiedBytes = 0;
};

/// Runs kernels to their end, one at a time. The first error sticks: what is
/// asked for afterwards does nothing, so a pipeline is written straight down
/// and asks \c failure() before it uses anything read back. Not thread-safe.
class Launcher {
public:
  /// \p Listener, if set, is told each stage's name as it begins.
  /// \p Folder, if not empty: read kernel sources there rather than from the
  /// program.
  /// \p Shared, if set, has what need not be built again; must outlive this.
  Launcher(const Device &D, std::string Folder,
           std::function<void(std::string_view)> Listener,
           ProgramCache *Shared = nullptr);

  const std::optional<Error> &failure() const { return Failure; }
  /// Makes \p E the error that sticks, unless there is one already.
  void fail(Error E) {
    if (!Failure)
      Failure = std::move(E);
  }
  /// The compiler's messages where \c build failed.
  const std::string &buildLog() const { return BuildLog; }

  /// Whether the kernels that follow are profiled (Device::queue()); not at
  /// first.
  void setProfiled(bool P) { Profiled = P; }

  /// What follows is accounted to a new stage. Begin one first of all.
  void beginStage(Stage Kind);
  /// How many stages there are.
  std::size_t stages() const { return Stages.size(); }
  /// Ends the last stage and gives all of them.
  std::vector<StageReport> takeStages();

  /// Builds \p Spec in place of what was built of the same file.
  void build(const ProgramSpec &Spec);

  /// Whether \p Spec was built on this computer and ran, now or before.
  bool wasBuilt(const ProgramSpec &Spec) const;
  /// Marks what was built as having run.
  void recordBuilds() const;

  /// Runs a kernel of a program that was built, and waits for it: \p Global
  /// work-items in groups of \p Local.
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

  /// What a user can make smaller where the device's memory does not suffice;
  /// "a smaller scene or picture" until then.
  void setRemedy(std::string Text) { Remedy = std::move(Text); }
  /// \p What names the buffer in errors ("Gaussians").
  cl::Buffer allocate(std::string_view What, uint64_t Bytes);
  void write(std::string_view What, const cl::Buffer &To, const void *From,
             uint64_t Bytes);
  /// From byte \p Offset of \p From on.
  void read(std::string_view What, void *To, const cl::Buffer &From,
            uint64_t Bytes, uint64_t Offset = 0);

  /// \name The same where the device has the words: no second copy is made
  /// @{
  /// \p Fill writes the first \p Words of \p To, all of them.
  void writeInPlace(std::string_view What, const cl::Buffer &To, uint64_t Words,
                    const std::function<void(std::span<float>)> &Fill);
  /// \p Use reads the first \p Words of \p From.
  void readInPlace(std::string_view What, const cl::Buffer &From,
                   uint64_t Words,
                   const std::function<void(std::span<const float>)> &Use);
  /// @}

  /// Most bytes of buffers made with \c allocate that were there at once.
  uint64_t mostBytes() const { return MostBytes; }
  const Device &device() const { return Dev; }

private:
  /// Sets argument \p Index of \p K, and counts it, unless \p Status is an
  /// error, which it becomes where OpenCL refuses.
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
  /// Why a launch of kernel \p Name ended with \p Status; says what the
  /// platform tells beside it.
  Error memoryError(std::string_view What, cl_int Status) const;
  Error launchError(const std::string &Name, cl_int Status) const;
  void account(KernelReport Report);
  /// Maps \p Words of \p B for \p Flags while \p Use works with them.
  cl_int mapped(const cl::Buffer &B, cl_map_flags Flags, uint64_t Words,
                const std::function<void(std::span<float>)> &Use);
  /// Keeps what the copy of \p What has ended with; \p Way is "to" or "from".
  void checkCopy(std::string_view What, std::string_view Way, cl_int Status);
  void countCopy(uint64_t Bytes);
  void endStage();
  Expected<std::string> sourceOf(const ProgramSpec &Spec) const;
  /// Of the program made of \p Source with \p Options, for the build record.
  std::string keyOf(const std::string &Source,
                    const std::string &Options) const;

  const Device &Dev;
  std::string KernelFolder;
  std::function<void(std::string_view)> Progress;
  ProgramCache *Shared;
  std::map<std::string, cl::Program> Programs;
  BuildRecord Record;
  std::vector<std::string> BuiltKeys;
  std::optional<Error> Failure;
  std::string BuildLog;
  bool Profiled = false;
  bool TimeChecked = false; ///< Device::timeCheck()
  std::vector<StageReport> Stages;
  std::chrono::steady_clock::time_point StageStart;
  std::string Remedy = "a smaller scene or picture";
  uint64_t MostBytes = 0;
  /// Shared with the buffers, which may outlive this.
  std::shared_ptr<std::atomic<uint64_t>> InUse =
      std::make_shared<std::atomic<uint64_t>>(0);
};

} // namespace vorion::splat
