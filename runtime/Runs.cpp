// The runs of a device: what a launch needs in memory, the thread that a run
// has, and the run's result.
#include "Device.h"
#include "vorion/RunCounters.h" // generated from intrinsics/Counters.td
#include "vorion/support/Diagnostics.h"
#include "vorion_abi.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

using namespace vorion;
using namespace vorion::runtime;

static_assert(VX_MEM_ALIGNMENT == isasim::LaunchAlignment);

namespace {

/// Console text of a run that is kept, in bytes: a guest that writes forever
/// must not take the host's memory.
constexpr std::size_t ConsoleBytes = std::size_t{1} << 20;

/// The parts of a launch in the order in which they are allocated.
constexpr std::pair<uint64_t isasim::LaunchParts::*, const char *>
    LaunchPartNames[] = {{&isasim::LaunchParts::Block, "the launch block"},
                         {&isasim::LaunchParts::Print, "the print buffer"},
                         {&isasim::LaunchParts::Args, "the arguments"},
                         {&isasim::LaunchParts::Context,
                          "the memory for values saved across barriers"}};

bool hasLocalArgs(const isasim::Kernel &K) {
  return std::ranges::any_of(K.Args, [](const isasim::KernelArg &Arg) {
    return Arg.Kind == VX_ARG_LOCAL;
  });
}

isasim::LaunchShape shapeOf(const isasim::Kernel &K,
                            const vx_launch_params &P) {
  isasim::LaunchShape S{.WorkDim = P.work_dim};
  std::ranges::copy(P.num_groups, S.NumGroups.begin());
  std::ranges::copy(P.local_size, S.LocalSize.begin());
  std::ranges::copy(P.global_offset, S.GlobalOffset.begin());
  if (P.local_bytes != 0)
    S.LocalBytes = P.local_bytes;
  else if (!hasLocalArgs(K))
    S.LocalBytes = K.LocalBytes;
  if (P.part_of) {
    isasim::WholeRange &R = S.PartOf.emplace();
    std::ranges::copy(P.part_of->enqueued_size, R.EnqueuedSize.begin());
    std::ranges::copy(P.part_of->groups_before, R.GroupsBefore.begin());
    std::ranges::copy(P.part_of->all_groups, R.AllGroups.begin());
    std::ranges::copy(P.part_of->global_size, R.GlobalSize.begin());
  }
  return S;
}

vx_outcome outcomeOf(isasim::Outcome End) {
  switch (End) {
  case isasim::Outcome::Done:
    return VX_OUTCOME_DONE;
  case isasim::Outcome::GuestFailed:
    return VX_OUTCOME_EXIT;
  case isasim::Outcome::Trap:
    return VX_OUTCOME_FAULT;
  case isasim::Outcome::Hang:
    return VX_OUTCOME_HANG;
  case isasim::Outcome::LimitReached:
    return VX_OUTCOME_LIMIT;
  }
  __builtin_unreachable();
}

} // namespace

void Device::clockRuns(bool On) {
  Machine->setClocking(On ? isasim::Clocking::On : isasim::Clocking::Off);
}

void Device::setProfiled(bool Profiled) {
  Lock Held(Mutex);
  waitForRun(Held);
  if (OnlyProfiled)
    clockRuns(Profiled);
}

void Device::keepConsole(std::string_view Text) {
  const std::size_t Kept =
      std::min(Text.size(), ConsoleBytes - ConsoleText.size());
  ConsoleText += Text.substr(0, Kept);
  ConsoleDropped += Text.size() - Kept;
}

void Device::forget(const LoadedImage *Image) {
  Lock Held(Mutex);
  waitForRun(Held);
  if (Current == Image)
    Current = nullptr;
}

void Device::nameBuffers(const isasim::Kernel &Kernel, const void *Args) {
  if (!Watch->observes())
    return;
  for (const isasim::KernelArg &Arg : Kernel.Args) {
    if (Arg.Kind != VX_ARG_GLOBAL)
      continue;
    uint32_t Address = 0;
    std::memcpy(&Address, static_cast<const std::byte *>(Args) + Arg.Offset,
                sizeof(Address));
    Watch->bufferNamed(Address,
                       fmt::format("buffer '{}' of {}", Arg.Name, Kernel.Name));
  }
  // Else vx_image_place_locals has said it.
  if (!hasLocalArgs(Kernel))
    Watch->localUsed(Kernel.LocalBytes);
}

void Device::makeCurrent(LoadedImage &Image) {
  if (Current == &Image)
    return;
  if (Current)
    Current->saveFrom(*Machine);
  Image.restoreInto(*Machine);
  Current = &Image;
}

Failure Device::holdStacks(const isasim::Launch &Planned) {
  const uint64_t Bytes = Planned.bytesUnderStacks();
  if (Bytes == 0)
    return {};
  UnderStacks = Memory.allocate(Bytes, Allocator::End::High);
  if (UnderStacks == Planned.stacksBegin())
    return {};
  return {VX_ERROR_MEMORY,
          fmt::format("cannot allocate stacks at {:#x}: expected the last {} "
                      "bytes of device memory to be free",
                      Planned.stacksBegin(), Bytes)};
}

Failure Device::prepare(const isasim::Launch &Planned, uint32_t Variables,
                        std::span<const std::byte> Args) {
  if (Failure Failed = holdStacks(Planned))
    return Failed;
  for (const auto &[Part, What] : LaunchPartNames) {
    uint32_t Address = 0;
    // Away from the program's buffers: these are allocated while launches
    // begin and end, and their addresses, on which time depends, must not
    // depend on which came first.
    if (const uint64_t Bytes = Planned.bytes().*Part)
      if (Failure Failed =
              allocateLocked(Bytes, What, Allocator::End::High, Address))
        return Failed;
    InUse.*Part = Address;
  }
  InUse.Variables = Variables;
  Planned.write(*Machine, *Watch, InUse, Args);
  return {};
}

void Device::finish(isasim::RunResult Run) {
  TimeText = Run.Time ? isasim::toJson(*Run.Time) : std::string();
  Last = std::move(Run);
  Print = InUse.Block ? isasim::printedBy(*Machine, InUse) : isasim::Printed();
}

void Device::freeRunMemory() {
  for (const auto &[Part, What] : LaunchPartNames)
    if (const auto Address = static_cast<uint32_t>(InUse.*Part)) {
      Memory.release(Address);
      Watch->released(Address);
    }
  InUse = {};
  if (UnderStacks)
    Memory.release(*UnderStacks);
  UnderStacks.reset();
}

void Device::launch(Lock &Held, LoadedImage &Image, const std::string &Name,
                    uint32_t LaunchBlock) {
  if (Runner.joinable())
    Runner.join(); // it has ended: Running is false
  makeCurrent(Image);
  if (Order)
    Machine->orderLaunch(*Order);
  Watch->runBegins(Name, LaunchBlock);
  ConsoleText.clear();
  ConsoleDropped = 0;
  BugText.clear();
  // The thread ends only after this call has given up the lock, so Running is
  // set before it is reset; a thread that cannot be had leaves nothing set.
  Runner = std::thread([this, LaunchBlock] {
    isasim::RunResult Run;
    std::string Bug;
    try {
      Run = Machine->run(LaunchBlock);
      if (const Expected<Success> Wrote = Watch->runEnded(Run); !Wrote)
        reportError("vorion", Wrote.error());
    } catch (const std::exception &E) {
      Bug = E.what();
    }
    const Lock Done(Mutex);
    BugText = std::move(Bug);
    finish(std::move(Run));
    freeRunMemory();
    Running = false;
    Ended.notify_all();
  });
  Running = true;
  HasStarted = true;
  Held.unlock();
}

Failure Device::start(LoadedImage &Image, uint32_t Kernel,
                      const vx_launch_params &Params, const void *Args,
                      uint32_t ArgsBytes) {
  const auto &Kernels = Image.program().kernels();
  if (Kernel >= Kernels.size())
    return {VX_ERROR_NOT_FOUND, fmt::format("kernel {} of an image with {}",
                                            Kernel, Kernels.size())};
  const isasim::Kernel &K = Kernels[Kernel];
  const auto Planned = isasim::Launch::plan(K, shapeOf(K, Params), config());
  if (!Planned)
    return failure(Planned.error().Code == ExitCode::LimitReached
                       ? VX_ERROR_MEMORY
                       : VX_ERROR_ARGUMENT,
                   Planned.error());
  if (ArgsBytes != K.ArgsBytes)
    return badArgument(
        fmt::format("{} bytes of packed arguments, expected {} for kernel {}",
                    ArgsBytes, K.ArgsBytes, K.Name));
  if (ArgsBytes && !Args)
    return badArgument("args is NULL, expected the packed arguments");
  const uint32_t Variables = isasim::placeOf(K.Variables, Params.variables);
  if (K.Variables.Bytes != 0 &&
      !Machine->hostPointer(Variables, K.Variables.Bytes))
    return badArgument(fmt::format("variables is {:#x}, expected memory for "
                                   "the program-scope variables of kernel {}",
                                   Params.variables, K.Name));
  Lock Held(Mutex);
  if (Running)
    return {VX_ERROR_BUSY, "a run is in progress"};
  if (Failure Failed =
          prepare(*Planned, Variables,
                  {static_cast<const std::byte *>(Args), ArgsBytes})) {
    freeRunMemory();
    return Failed;
  }
  nameBuffers(K, Args);
  launch(Held, Image, K.Name, static_cast<uint32_t>(InUse.Block));
  return {};
}

Failure Device::startMain(LoadedImage &Image) {
  Lock Held(Mutex);
  if (Running)
    return {VX_ERROR_BUSY, "a run is in progress"};
  launch(Held, Image, "main", 0);
  return {};
}

Failure Device::wait(vx_result &Result) {
  Lock Held(Mutex);
  if (!HasStarted)
    return {VX_ERROR_BUSY, "nothing was started"};
  waitForRun(Held);
  if (!BugText.empty())
    return {VX_ERROR_INTERNAL, "the simulator failed: " + BugText};
  Result = {};
  Result.outcome = outcomeOf(Last.End);
  Result.exit_code = Last.ExitCode;
  Result.report = Last.Report.c_str();
  Result.print_text = Print.Text.c_str();
  Result.print_bytes = Print.Text.size();
  Result.print_dropped = Print.Dropped;
  Result.console_text = ConsoleText.c_str();
  Result.console_bytes = ConsoleText.size();
  Result.console_dropped = ConsoleDropped;
  Result.host_seconds = Last.HostSeconds;
  Result.device_seconds = Last.Time ? static_cast<double>(Last.Time->Cycles) /
                                          1e6 / Last.Time->ClockMhz
                                    : 0;
  Result.time_report = TimeText.c_str();
  Result.counters = toDriver(Last.Total, Last.Raster);
  return {};
}
