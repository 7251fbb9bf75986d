#include "observe/gdb/Call.h"

#include "core/Core.h"
#include "core/Exec.h"
#include "core/Warps.h"

#include <cstring>
#include <utility>

namespace vorion::isasim::gdb {

Call::Call(Target &LanesIn, ThreadId T, uint32_t EntryIn, uint32_t ReturnToIn,
           std::vector<RegisterWrite> WrittenIn)
    : Lanes(LanesIn), Lane(T), Warp(*Lanes.warpOf(T)), Saved(Warp),
      Entry(EntryIn), ReturnTo(ReturnToIn), Written(std::move(WrittenIn)) {
  Lanes.showOwnPcs();
  PcBefore = Lanes.readRegister(T, PcNumber).value_or(0);
  setMask(&Warp, 1U << Lanes.laneOf(T));
  Warp.WholeMask = 0; // a barrier is not for one lane: it traps
  Warp.Trace = nullptr;
  Warp.Next = Warp.Owner->find(Entry);
  Lanes.showPc(Lane, Entry);
}

void Call::goBack() {
  raise(&Warp, static_cast<uint32_t>(TrapCause::FetchFault), Lanes.laneOf(Lane),
        ReturnTo);
  Warp.Moved = Running;
  IsBack = true;
  Lanes.showPc(Lane, ReturnTo);
}

Call::Pause Call::run(const std::function<bool()> &MustStop) {
  constexpr uint64_t LongestStretch = 1 << 12;
  Lanes.showOwnPcs();
  Running = true;
  if (!IsBack)
    Warp.Why = Stop::Ready;
  while (!Over && Warp.Why == Stop::Ready && !MustStop())
    Warp.Owner->runApart(Warp, execTable(true), LongestStretch);
  Running = false;
  if (Over) {
    Warp.Fflags = Saved.Fflags; // the host's unit still had the call's
    return Pause::Ended;
  }
  if (Warp.Why != Stop::Trapped)
    return Pause::Stuck;
  const bool NoCode = cause() == TrapCause::FetchFault;
  if (NoCode && Warp.FaultAddress == ReturnTo) {
    Lanes.showPc(Lane, ReturnTo);
    return Pause::Returned;
  }
  if (NoCode && Warp.Next == Warp.Owner->find(Entry))
    Lanes.showPc(Lane, Entry);
  return Pause::Trapped;
}

void Call::end(bool UndoWrites) {
  if (!UndoWrites)
    std::memcpy(Saved.Registers, Warp.Registers, sizeof(Warp.Registers));
  Warp = Saved;
  // Handlers that are running it must not go on where the call was.
  Warp.Moved = Running;
  Over = true;
  Lanes.showOwnPcs();
  if (UndoWrites)
    Target::undo(std::exchange(Written, {}));
}

} // namespace vorion::isasim::gdb
