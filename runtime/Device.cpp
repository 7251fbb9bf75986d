#include "Device.h"
#include "vorion/RunCounters.h" // generated from intrinsics/Counters.td
#include "vorion/isasim/MemoryMap.h"
#include "vorion/support/Diagnostics.h"
#include "vorion_abi.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fmt/format.h>
#include <set>

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
                          "the memory that a kernel keeps across barriers"}};

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

/// A program may end without closing its devices, as one of OpenCL does. What
/// watches them has its last word then.
class OpenDevices {
public:
  void add(Device *D) {
    const std::lock_guard Held(Mutex);
    Open.insert(D);
  }
  void remove(Device *D) {
    const std::lock_guard Held(Mutex);
    Open.erase(D);
  }
  void lastWords() {
    const std::lock_guard Held(Mutex);
    for (Device *D : Open)
      D->lastWord();
  }

private:
  std::mutex Mutex;
  std::set<Device *> Open;
};

/// Is never destroyed: a program's static objects may close devices late.
OpenDevices &openDevices() {
  static OpenDevices *const All = [] {
    std::atexit([] { openDevices().lastWords(); });
    return new OpenDevices();
  }();
  return *All;
}

} // namespace

Device::Device(std::unique_ptr<isasim::Machine> TheMachine,
               std::unique_ptr<isasim::Session> TheWatch, bool OnlyProfiled)
    : Machine(std::move(TheMachine)), Watch(std::move(TheWatch)),
      ConfigText(isasim::toJson(Machine->config())),
      OnlyProfiled(OnlyProfiled) {
  for (const isasim::AddressRange &Part :
       isasim::globalRanges(Machine->config()))
    Memory.add(Part.Base, Part.Bytes);
  clockRuns(!OnlyProfiled);
  Machine->setConsole([this](std::string_view Text) { keepConsole(Text); });
  openDevices().add(this);
}

void Device::keepConsole(std::string_view Text) {
  const std::size_t Kept =
      std::min(Text.size(), ConsoleBytes - ConsoleText.size());
  ConsoleText += Text.substr(0, Kept);
  ConsoleDropped += Text.size() - Kept;
}

Device::~Device() {
  Lock Held(Mutex);
  waitForRun(Held);
  if (Runner.joinable())
    Runner.join();
  Held.unlock();
  openDevices().remove(this);
  lastWord();
}

void Device::lastWord() {
  const Lock Held(Mutex);
  // A run that the program has not waited for is not over.
  if (Running)
    return;
  if (const Expected<Success> Came = Watch->finished(); !Came)
    reportError("vorion", Came.error());
}

void Device::clockRuns(bool On) {
  Machine->setClocking(On ? isasim::Clocking::On : isasim::Clocking::Off);
}

void Device::waitForRun(Lock &Held) {
  Ended.wait(Held, [this] { return !Running; });
}

void Device::waitIfObserved(Lock &Held) {
  if (Watch->observes())
    waitForRun(Held);
}

vx_device_info Device::info() {
  const isasim::Config &C = Machine->config();
  const Lock Held(Mutex);
  vx_device_info Info{};
  Info.clusters = C.Clusters;
  Info.sockets = C.sockets();
  Info.cores = C.cores();
  Info.warps = C.WarpsPerCore;
  Info.lanes = C.LanesPerWarp;
  Info.barriers = C.Barriers;
  Info.rasterizers = C.sockets(); // one a socket
  Info.stack_bytes = C.StackBytes;
  Info.local_base = VX_LOCAL_BASE;
  Info.local_bytes = C.LocalBytes;
  Info.global_base = VX_GLOBAL_BASE;
  Info.global_bytes = isasim::globalBytes(C);
  Info.free_bytes = Memory.freeBytes();
  Info.largest_free_bytes = Memory.largestFree();
  Info.max_group_items = isasim::MaxGroupItems;
  Info.clock_mhz = C.Timing.ClockMhz;
  return Info;
}

Failure Device::allocateLocked(uint64_t Size, const char *What,
                               Allocator::End From, uint32_t &Address) {
  // What is asked for and cannot be had fails below.
  const auto Found = Memory.allocate(Size + Watch->guardBytes(), From);
  if (!Found)
    return {VX_ERROR_MEMORY,
            fmt::format("no room for {} of {} bytes: {} of {} bytes of device "
                        "memory are free, {} in one piece",
                        What, Size, Memory.freeBytes(),
                        isasim::globalBytes(Machine->config()),
                        Memory.largestFree())};
  // Global memory has addresses of 32 bits.
  Address = static_cast<uint32_t>(*Found);
  Watch->allocated(Address, Size, What);
  return {};
}

Failure Device::allocate(uint64_t Size, uint32_t &Address) {
  Lock Held(Mutex);
  waitIfObserved(Held);
  return allocateLocked(Size, "buffer", Allocator::End::Low, Address);
}

Failure Device::allocateVariables(const LoadedImage &Image,
                                  const isasim::Kernel &K, uint32_t &Address) {
  Lock Held(Mutex);
  waitForRun(Held);
  uint32_t Start = 0;
  // A driver does this when a launch begins: see prepare().
  if (Failure Failed = allocateLocked(isasim::bytesFor(K.Variables),
                                      "the variables of program scope",
                                      Allocator::End::High, Start))
    return Failed;
  isasim::writeVariables(*Machine, *Watch, Image.program(), K,
                         isasim::placeOf(K.Variables, Start));
  Address = Start;
  return {};
}

Failure Device::release(uint32_t Address) {
  Lock Held(Mutex);
  waitIfObserved(Held);
  if (Address && !Memory.release(Address))
    return badArgument(
        fmt::format("{:#x} is not the address of an allocation", Address));
  Watch->released(Address);
  return {};
}

Failure Device::globalRange(uint32_t Address, uint64_t Size,
                            std::byte **Bytes) {
  *Bytes = Machine->hostPointer(Address, Size);
  if (*Bytes)
    return {};
  std::string Ranges;
  for (const auto &[Base, Length] : isasim::globalRanges(Machine->config()))
    if (Length)
      Ranges += fmt::format("{}[{:#x}, +{:#x})", Ranges.empty() ? "" : " or ",
                            Base, Length);
  return badArgument(fmt::format("[{:#x}, +{:#x}) is not all global memory, "
                                 "expected a range in {}",
                                 Address, Size, Ranges));
}

bool Device::isRasterWindow(uint32_t Address) {
  return Address >= VX_IO_RASTER && Address < VX_GLOBAL_BASE;
}

template <typename Function>
Failure Device::forRasterCsrs(uint32_t Address, uint64_t Size, Function Use) {
  if (Address % 4 || Size % 4 || Size > VX_GLOBAL_BASE - Address)
    return badArgument(fmt::format(
        "[{:#x}, +{:#x}), expected whole aligned words of the I/O window, "
        "[{:#x}, {:#x})",
        Address, Size, VX_IO_RASTER, VX_GLOBAL_BASE));
  for (uint32_t Offset = 0; Offset != Size; Offset += 4) {
    const uint32_t At = Address + Offset - VX_IO_RASTER;
    const uint32_t Csr = VX_CSR_VR_STATUS + At % VX_IO_RASTER_STRIDE / 4;
    if (!Use(At / VX_IO_RASTER_STRIDE, Csr, Offset))
      return badArgument(fmt::format(
          "no such access to {:#x} of the I/O window, expected a raster CSR of "
          "one of {} cores, not read-only if it is written",
          Address + Offset, Machine->config().cores()));
  }
  return {};
}

Failure Device::copyIn(uint32_t To, const void *From, uint64_t Size) {
  Lock Held(Mutex);
  waitForRun(Held);
  if (isRasterWindow(To))
    return forRasterCsrs(To, Size, [&](unsigned Core, unsigned Csr, auto At) {
      uint32_t Value = 0;
      std::memcpy(&Value, static_cast<const std::byte *>(From) + At, 4);
      return Machine->writeRasterCsr(Core, Csr, Value);
    });
  std::byte *Bytes = nullptr;
  if (Failure Failed = globalRange(To, Size, &Bytes))
    return Failed;
  std::memcpy(Bytes, From, Size);
  Watch->hostWrote(To, Size);
  return {};
}

Failure Device::copyOut(void *To, uint32_t From, uint64_t Size) {
  Lock Held(Mutex);
  waitForRun(Held);
  if (isRasterWindow(From))
    return forRasterCsrs(From, Size, [&](unsigned Core, unsigned Csr, auto At) {
      const auto Value = Machine->readRasterCsr(Core, Csr);
      if (Value)
        std::memcpy(static_cast<std::byte *>(To) + At, &*Value, 4);
      return Value.has_value();
    });
  std::byte *Bytes = nullptr;
  if (Failure Failed = globalRange(From, Size, &Bytes))
    return Failed;
  std::memcpy(To, Bytes, Size);
  Watch->hostRead(From, Size);
  return {};
}

Failure Device::copyWithin(uint32_t To, uint32_t From, uint64_t Size) {
  Lock Held(Mutex);
  waitForRun(Held);
  std::byte *Target = nullptr, *Source = nullptr;
  if (Failure Failed = globalRange(To, Size, &Target))
    return Failed;
  if (Failure Failed = globalRange(From, Size, &Source))
    return Failed;
  std::memmove(Target, Source, Size);
  Watch->hostRead(From, Size);
  Watch->hostWrote(To, Size);
  return {};
}

Failure Device::fill(uint32_t To, const void *Pattern, uint32_t PatternSize,
                     uint64_t Size) {
  if (PatternSize < 1 || PatternSize > 128)
    return badArgument(
        fmt::format("pattern of {} bytes, expected 1 to 128", PatternSize));
  if (Size % PatternSize)
    return badArgument(
        fmt::format("{} bytes to fill, expected a multiple of the pattern's {}",
                    Size, PatternSize));
  Lock Held(Mutex);
  waitForRun(Held);
  std::byte *Bytes = nullptr;
  if (Failure Failed = globalRange(To, Size, &Bytes))
    return Failed;
  for (uint64_t At = 0; At < Size; At += PatternSize)
    std::memcpy(Bytes + At, Pattern, PatternSize);
  Watch->hostWrote(To, Size);
  return {};
}

Failure Device::hostPointer(uint32_t Address, uint64_t Size, void **To) {
  std::byte *Bytes = nullptr;
  if (Failure Failed = globalRange(Address, Size, &Bytes))
    return Failed;
  *To = Bytes;
  return {};
}

Failure Device::tellHost(Notice What, uint32_t Address, uint64_t Size) {
  std::byte *Bytes = nullptr;
  if (Failure Failed = globalRange(Address, Size, &Bytes))
    return Failed;
  if (!Watch->observes())
    return {};
  Lock Held(Mutex);
  waitForRun(Held);
  (*Watch.*What)(Address, Size);
  return {};
}

Failure Device::hostWrote(uint32_t Address, uint64_t Size) {
  return tellHost(&isasim::Session::hostWrote, Address, Size);
}

Failure Device::hostRead(uint32_t Address, uint64_t Size) {
  return tellHost(&isasim::Session::hostRead, Address, Size);
}

void Device::localUsed(uint64_t Bytes) {
  if (!Watch->observes())
    return;
  Lock Held(Mutex);
  waitForRun(Held);
  Watch->localUsed(Bytes);
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

void Device::setProfiled(bool Profiled) {
  Lock Held(Mutex);
  waitForRun(Held);
  if (OnlyProfiled)
    clockRuns(Profiled);
}

void Device::forget(const LoadedImage *Image) {
  Lock Held(Mutex);
  waitForRun(Held);
  if (Current == Image)
    Current = nullptr;
}

void Device::makeCurrent(LoadedImage &Image) {
  if (Current == &Image)
    return;
  if (Current)
    Current->saveFrom(*Machine);
  Image.restoreInto(*Machine);
  Current = &Image;
}

Failure Device::prepare(const isasim::Launch &Planned, uint32_t Variables,
                        std::span<const std::byte> Args) {
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
}

void Device::launch(Lock &Held, LoadedImage &Image, const std::string &Name,
                    uint32_t LaunchBlock) {
  if (Runner.joinable())
    Runner.join(); // it has ended: Running is false
  makeCurrent(Image);
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
    return badArgument(
        fmt::format("variables is {:#x}, expected memory for the "
                    "variables of program scope of kernel {}",
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
  switch (Last.End) {
  case isasim::Outcome::Done:
    Result.outcome = VX_OUTCOME_DONE;
    break;
  case isasim::Outcome::GuestFailed:
    Result.outcome = VX_OUTCOME_EXIT;
    break;
  case isasim::Outcome::Trap:
    Result.outcome = VX_OUTCOME_FAULT;
    break;
  case isasim::Outcome::Hang:
    Result.outcome = VX_OUTCOME_HANG;
    break;
  case isasim::Outcome::LimitReached:
    Result.outcome = VX_OUTCOME_LIMIT;
    break;
  }
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
