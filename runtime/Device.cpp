// A device from its beginning to its end, and what the host does with its
// memory. Runs.cpp has the runs.
#include "Device.h"
#include "OpenDevices.h"
#include "vorion/isasim/MemoryMap.h"
#include "vorion/support/Diagnostics.h"
#include "vorion_abi.h"

#include <cstring>
#include <fmt/format.h>

using namespace vorion;
using namespace vorion::runtime;

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
  OpenDevices::all().add(this);
}

Device::~Device() {
  Lock Held(Mutex);
  waitForRun(Held);
  if (Runner.joinable())
    Runner.join();
  Held.unlock();
  OpenDevices::all().remove(this);
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
  Info.global_base = isasim::globalBase(C);
  Info.global_bytes = isasim::globalBytes(C);
  Info.free_bytes = Memory.freeBytes();
  Info.largest_free_bytes = Memory.largestFree();
  Info.max_group_items = isasim::MaxGroupItems;
  Info.clock_mhz = C.Timing.ClockMhz;
  Info.dma_engines = timesCopies() ? C.Timing.Host.DmaEngines : 0;
  return Info;
}

Failure Device::allocateLocked(uint64_t Size, const char *What,
                               Allocator::End From, uint32_t &Address,
                               uint64_t Below) {
  // What is asked for and cannot be had fails below.
  const auto Found = Memory.allocate(Size + Watch->guardBytes(), From, Below);
  if (!Found)
    return {VX_ERROR_MEMORY,
            fmt::format("cannot allocate {} of {} bytes: {} of {} bytes of "
                        "device memory are free, {} contiguous",
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
  // A driver does this when a launch begins: see prepare(). In front of the
  // image, if there is room, since large stacks need the end of the memory
  // behind it.
  for (const uint64_t Below : {uint64_t{VX_IMAGE_BASE}, UINT64_MAX}) {
    Failure Failed = allocateLocked(isasim::bytesFor(K.Variables),
                                    "the program-scope variables",
                                    Allocator::End::High, Start, Below);
    if (Failed && Below == UINT64_MAX)
      return Failed;
    if (!Failed)
      break;
  }
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
  return badArgument(fmt::format(
      "[{:#x}, +{:#x}) is not inside global memory, expected a range in {}",
      Address, Size, Ranges));
}

bool Device::isRasterWindow(uint32_t Address) const {
  return Address >= VX_IO_RASTER &&
         Address < isasim::globalBase(Machine->config());
}

template <typename Function>
Failure Device::forRasterCsrs(uint32_t Address, uint64_t Size, Function Use) {
  const uint32_t End = isasim::globalBase(Machine->config());
  if (Address % 4 || Size % 4 || Size > End - Address)
    return badArgument(fmt::format(
        "[{:#x}, +{:#x}), expected whole aligned words of the I/O window, "
        "[{:#x}, {:#x})",
        Address, Size, VX_IO_RASTER, End));
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
  timeCopy(isasim::HostCopy::Kind::ToDevice, To, Size);
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
  timeCopy(isasim::HostCopy::Kind::FromDevice, From, Size);
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
  timeCopy(isasim::HostCopy::Kind::OnDevice, To, Size, From);
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
  timeCopy(isasim::HostCopy::Kind::Fill, To, Size);
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

bool Device::timesCopies() const {
  const isasim::TimingConfig &T = Machine->config().Timing;
  return T.Enabled && T.Host.DmaEngines != 0;
}

/// The caller has the lock, and there is no run.
void Device::timeCopy(isasim::HostCopy::Kind What, uint32_t Address,
                      uint64_t Bytes, uint32_t From) {
  if (timesCopies())
    Machine->copies({What, Address, From, Bytes},
                    Order.value_or(isasim::CommandOrder{
                        .After = {Machine->lastCommand()}, .HostAfter = {}}));
}

Failure Device::beginCommand(isasim::CommandOrder New) {
  if (!timesCopies())
    return {};
  Lock Held(Mutex);
  waitForRun(Held);
  LastBefore = Machine->lastCommand();
  for (const auto *Numbers : {&New.After, &New.HostAfter})
    for (const uint64_t Number : *Numbers)
      if (Number > LastBefore)
        return badArgument(
            fmt::format("command {} has not been begun, expected a number from "
                        "vx_command_end",
                        Number));
  Order = std::move(New);
  return {};
}

Failure Device::endCommand(uint64_t &Number) {
  Number = 0;
  if (!timesCopies())
    return {};
  Lock Held(Mutex);
  waitForRun(Held);
  Order.reset();
  if (const uint64_t Sent = Machine->lastCommand(); Sent != LastBefore)
    Number = Sent;
  return {};
}

Failure Device::copied(const isasim::HostCopy &Copy) {
  if (!timesCopies())
    return {};
  Lock Held(Mutex);
  waitForRun(Held);
  std::byte *Bytes = nullptr;
  if (Failure Failed = globalRange(Copy.Address, Copy.Bytes, &Bytes))
    return Failed;
  timeCopy(Copy.What, Copy.Address, Copy.Bytes, Copy.From);
  return {};
}

Failure Device::settle() {
  if (!timesCopies())
    return {};
  Lock Held(Mutex);
  waitForRun(Held);
  Machine->settle();
  return {};
}
