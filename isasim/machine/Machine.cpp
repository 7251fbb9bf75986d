#include "machine/MachineImpl.h"
#include "vorion/isasim/Observer.h"
#include "vorion/isasim/TrapCause.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <ctime>
#include <fmt/format.h>

namespace vorion::isasim {

bool isTranslatorWanted(Engine E) {
  return E == Engine::Translator || E == Engine::TranslatorAvx2;
}

VectorUnit unitOf(Engine E) {
  const VectorUnit Best = Translator::unitOfHost();
  switch (E) {
  case Engine::Interpreter:
    return VectorUnit::None;
  case Engine::TranslatorAvx2:
    return std::min(Best, VectorUnit::Avx2);
  default:
    return Best;
  }
}

Machine::Machine() = default;
Machine::~Machine() = default;

Expected<std::unique_ptr<Machine>> Machine::create(const Config &C) {
  if (Expected<Success> Ok = validate(C); !Ok)
    return Ok.error();
  if (isTranslatorWanted(C.Runs) && !Translator::isThere())
    return Error{
        "configuration",
        fmt::format("engine is the translator, expected 'auto' or "
                    "'interpreter' on this host: the translator needs {}",
                    Translator::needs()),
        ExitCode::Usage};
  Expected<std::unique_ptr<Memory>> Mem = Memory::create(C);
  if (!Mem)
    return Mem.error();
  std::unique_ptr<Machine> M(new Machine());
  M->PImpl = std::make_unique<Impl>(C, std::move(*Mem));
  return M;
}

const Config &Machine::config() const { return PImpl->Shape; }

void Machine::load(std::shared_ptr<const Image> Program) {
  PImpl->Program = std::move(Program);
  PImpl->Storage->load(*PImpl->Program);
}

const std::shared_ptr<const Image> &Machine::image() const {
  return PImpl->Program;
}

std::byte *Machine::hostPointer(uint32_t Address, uint64_t Bytes) {
  return PImpl->Storage->global(Address, Bytes);
}

bool Machine::read(uint32_t Address, std::span<std::byte> To) const {
  return PImpl->access(Address, To.size(),
                       [&](std::byte *At, size_t Offset, size_t Bytes) {
                         std::memcpy(To.data() + Offset, At, Bytes);
                       });
}

bool Machine::write(uint32_t Address, std::span<const std::byte> From) {
  return PImpl->access(Address, From.size(),
                       [&](std::byte *At, size_t Offset, size_t Bytes) {
                         std::memcpy(At, From.data() + Offset, Bytes);
                       });
}

bool Machine::fill(uint32_t Address, uint64_t Bytes, std::byte Value) {
  return PImpl->access(Address, Bytes, [&](std::byte *At, size_t, size_t Part) {
    std::memset(At, static_cast<int>(Value), Part);
  });
}

RunResult Machine::run(uint32_t LaunchBlock) {
  RunResult R;
  if (!PImpl->Program) {
    R.End = Outcome::Trap;
    R.Fault.Cause = TrapCause::FetchFault;
    R.Report = "no program is loaded\n";
    return R;
  }
  PImpl->Budget.beginRun();
  const std::clock_t CpuBegin = std::clock();
  const RasterCounters Before = PImpl->Raster.counters();
  VxLaunch Launch{};
  const bool HasLaunch = LaunchBlock != 0;
  if (HasLaunch)
    read(LaunchBlock, std::as_writable_bytes(std::span(&Launch, 1)));
  const RunMemory Memory = PImpl->memoryFor(LaunchBlock, Launch);
  if (const Expected<Success> Ok = PImpl->Storage->beginRun(Memory); !Ok) {
    PImpl->Budget.endRun();
    R.End = Outcome::LimitReached;
    R.Report = Ok.error().What + "\n";
    return R;
  }
  PImpl->resetCores(LaunchBlock, Launch);
  PImpl->Watcher.tell([&](Observer &O) {
    O.runBegins({PImpl->Shape, PImpl->Program, LaunchBlock,
                 HasLaunch ? &Launch : nullptr, PImpl->Cores, this,
                 Memory.StackBytes, Memory.Stacks});
  });
  do {
    PImpl->runCores();
    ++R.SyncPoints;
    // A trap of the round comes before what others would do at its end.
    if (PImpl->findTrap(R))
      break;
    PImpl->atSyncPoint();
    PImpl->takeTime();
  } while (!PImpl->decideEnd(R));
  PImpl->Budget.endRun();
  PImpl->flushConsole(true);
  PImpl->count(R);
  PImpl->endTime(R);
  if (R.End == Outcome::Done && R.ExitCode != 0)
    R.End = Outcome::GuestFailed;
  R.Raster = PImpl->Raster.counters() - Before;
  if (R.End != Outcome::Done && R.End != Outcome::GuestFailed)
    PImpl->resetRasterizers();
  R.HostSeconds = PImpl->Budget.secondsSoFar();
  R.HostCpuSeconds =
      static_cast<double>(std::clock() - CpuBegin) / CLOCKS_PER_SEC;
  PImpl->Watcher.tell([&](Observer &O) { O.runEnds(R); });
  PImpl->Storage->endRun();
  return R;
}

void Machine::setConsole(std::function<void(std::string_view)> Sink) {
  PImpl->Console = std::move(Sink);
}

bool Machine::canBeObserved() { return VORION_OBSERVERS; }

void Machine::setObservers(std::vector<Observer *> Observers) {
  assert((Observers.empty() || canBeObserved()) &&
         "this build has no observers");
  PImpl->Watcher.Observers = std::move(Observers);
  PImpl->chooseLog();
}

void Machine::setTimeObservers(std::vector<TimeObserver *> Observers) {
  PImpl->TimeObservers = std::move(Observers);
  PImpl->tellTimeObservers();
}

void Machine::setWatchdog(double Seconds) {
  PImpl->Budget.setWatchdog(Seconds);
}

void Machine::requestStop() { PImpl->Budget.requestStop(); }

bool Machine::mustStop() const { return PImpl->Budget.mustStop(); }

void Machine::setClocking(Clocking Of) {
  if (!PImpl->Time || PImpl->Mode == Of)
    return;
  const bool Before = PImpl->isClocked();
  PImpl->Mode = Of;
  PImpl->tellTimeObservers();
  if (PImpl->isClocked() == Before)
    return;
  PImpl->Time->reset();
  PImpl->chooseLog();
}

uint64_t Machine::copies(const HostCopy &Copy, CommandOrder Order) {
  return PImpl->isClocked() ? PImpl->Time->copies(Copy, std::move(Order)) : 0;
}

void Machine::orderLaunch(CommandOrder Order) {
  if (PImpl->isClocked())
    PImpl->Time->orderLaunch(std::move(Order));
}

uint64_t Machine::lastCommand() const {
  return PImpl->Time ? PImpl->Time->lastCommand() : 0;
}

void Machine::settle() {
  if (PImpl->isClocked())
    PImpl->Time->settle();
}

std::optional<uint32_t> Machine::readRasterCsr(unsigned Core, unsigned Csr) {
  return PImpl->Raster.hostRead(Core, Csr);
}

bool Machine::writeRasterCsr(unsigned Core, unsigned Csr, uint32_t Value) {
  return PImpl->Raster.hostWrite(Core, Csr, Value);
}

std::vector<std::span<std::byte>> Machine::memory() const {
  return PImpl->Storage->kept();
}

std::vector<std::byte> Machine::imageData() const {
  std::vector<std::byte> Data;
  for (const Image::Segment &S : PImpl->Program->segments()) {
    if (!S.Writable)
      continue;
    const size_t At = Data.size();
    Data.resize(At + S.MemBytes);
    [[maybe_unused]] const bool Read =
        read(S.Address, std::span(Data).subspan(At));
    assert(Read && "a segment of the loaded image is readable by the host");
  }
  return Data;
}

bool Machine::setImageData(std::span<const std::byte> Data) {
  uint64_t Bytes = 0;
  for (const Image::Segment &S : PImpl->Program->segments())
    Bytes += S.Writable ? S.MemBytes : 0;
  if (Bytes != Data.size())
    return false;
  for (const Image::Segment &S : PImpl->Program->segments()) {
    if (!S.Writable)
      continue;
    [[maybe_unused]] const bool Wrote =
        write(S.Address, Data.first(S.MemBytes));
    assert(Wrote && "a segment of the loaded image is writable by the host");
    Data = Data.subspan(S.MemBytes);
  }
  return true;
}

std::optional<std::vector<std::byte>> Machine::rasterState() const {
  return PImpl->Raster.state();
}

bool Machine::setRasterState(std::span<const std::byte> State) {
  return PImpl->Raster.setState(State);
}

} // namespace vorion::isasim
