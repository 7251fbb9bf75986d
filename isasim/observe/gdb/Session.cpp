#include "observe/gdb/Session.h"

#include "core/Core.h"
#include "core/HostFp.h"
#include "core/Rounding.h"
#include "vorion/isasim/Machine.h"

#include <bit>
#include <fmt/format.h>

namespace vorion::isasim::gdb {

namespace {

/// Instructions between two looks at whether the debugger wants a stop.
constexpr unsigned PollEvery = 4096;

unsigned signalOf(TrapCause Cause) {
  switch (Cause) {
  case TrapCause::FetchFault:
  case TrapCause::LoadFault:
  case TrapCause::StoreFault:
  case TrapCause::MisalignedFetch:
  case TrapCause::MisalignedLoad:
  case TrapCause::MisalignedStore:
    return SigSegv;
  case TrapCause::Breakpoint:
  case TrapCause::EnvironmentCall:
    return SigTrap;
  default:
    return SigIll;
  }
}

} // namespace

Session::~Session() {
  if (Peer.isOpen())
    Peer.send(fmt::format("W{:02x}", ExitStatus & 0xFF));
}

void Session::runBegins(const RunStart &R) {
  Lanes.begin(R);
  Peer.stopWaitingWhen([M = R.Device] { return M->mustStop(); });
  if (!WasConnected) {
    WasConnected = Peer.accept();
    StopNext = WasConnected;
  }
  Stepping = nullptr;
  // gdb reads the symbols of another program if it is told of it.
  const bool IsFirst = !Program;
  EntersProgram = !IsFirst && Program != R.Program && KnowsPrograms;
  Program = R.Program;
}

void Session::fetch(const Step &S) {
  if (!Peer.isOpen())
    return;
  if (++Fetches % PollEvery == 0 && Peer.interrupted())
    return stop(S.State, S.LaneMask, SigInt, "");
  if (std::exchange(EntersProgram, false))
    stop(S.State, S.LaneMask, SigTrap,
         fmt::format("exec:{};", toHex(programPath())));
  const bool Steps = Stepping == &S.State;
  if (Steps && std::exchange(CallBegins, false))
    return;
  const bool IsHit = Breakpoints.contains(S.Pc);
  if (!StopNext && !IsHit && (!Steps || isSteppedLaneOff(S.LaneMask)))
    return;
  StopNext = false;
  std::string Why;
  std::swap(Why, WatchReason);
  const ThreadId Watcher = std::exchange(WatchThread, 0);
  stop(S.State, S.LaneMask, SigTrap, Why, Watcher);
  if (IsHit)
    offerToOthers(S);
}

void Session::commit(const Commit &C) {
  if (!Peer.isOpen() || !C.Access || Watched.empty())
    return;
  for (uint32_t Left = C.LaneMask; Left; Left &= Left - 1) {
    const uint32_t At = C.Access->Addresses[std::countr_zero(Left)];
    for (const Watchpoint &W : Watched)
      if (At < W.Address + W.Bytes && W.Address < At + C.Access->Bytes &&
          (C.Access->What == MemoryAccess::Load ? W.Reads : W.Writes)) {
        // gdb expects to be told behind the instruction.
        Stepping = &C.State;
        Stepped = 0;
        // Of several lanes, the one that the user looks at.
        const ThreadId T =
            Lanes.threadOf(C.State, unsigned(std::countr_zero(Left)));
        if (!WatchReason.empty() && T != Current)
          continue;
        WatchThread = T;
        WatchReason = fmt::format("{}:{:x};",
                                  !W.Reads    ? "watch"
                                  : !W.Writes ? "rwatch"
                                              : "awatch",
                                  W.Address);
      }
  }
}

void Session::trap(const Trap &T) {
  if (!Peer.isOpen())
    return;
  const ThreadId First = Current;
  Current = 0;
  for (ThreadId Id = 1; Id <= Lanes.numThreads() && !Current; ++Id) {
    const WarpState &S = *Lanes.warpOf(Id);
    if (S.Owner->id() == T.Core && S.WarpId == T.Warp &&
        Lanes.laneOf(Id) == T.Lane)
      Current = Id;
  }
  Current = Current ? Current : First;
  serve(signalOf(T.Cause), "");
}

void Session::runEnds(const RunResult &R) {
  // Those that wait for a machine that is gone must not ask it.
  Peer.stopWaitingWhen([] { return false; });
  ExitStatus = R.End == Outcome::Done          ? 0
               : R.End == Outcome::GuestFailed ? 1
               : R.End == Outcome::Trap        ? 4
                                               : 5;
}

bool Session::isSteppedLaneOff(uint32_t Active) const {
  return Stepped && !StepsOver && !(Active >> Lanes.laneOf(Stepped) & 1);
}

void Session::stop(WarpState &S, uint32_t Mask, unsigned Reason,
                   const std::string &More, ThreadId Cause) {
  // Stay with the thread that the user looks at, if it is of this warp and
  // no other is the cause.
  const bool IsOver = StepsOver && Stepping == &S && Current == Stepped;
  if (Cause)
    Current = Cause;
  else if (!IsOver && (!Lanes.isActive(Current) || Lanes.warpOf(Current) != &S))
    Current = Lanes.threadOf(S, static_cast<unsigned>(std::countr_zero(Mask)));
  // Flags and rounding mode are the host's unit's as long as it runs.
  S.Fflags |= HostFp::takeFlags();
  serve(Reason, More);
  setFrm(&S, S.Frm);
}

void Session::offerToOthers(const Step &S) {
  const uint32_t Behind = S.Pc + 4;
  uint32_t Left = S.LaneMask & ~(1U << Lanes.laneOf(Current));
  for (; Left && !UserLooks && Peer.isOpen() && stepsOverBreakpoint() &&
         !Breakpoints.contains(Behind);
       Left &= Left - 1) {
    Lanes.showPc(Stepped, Behind);
    serve(SigTrap, "");
    if (UserLooks || !Breakpoints.contains(S.Pc))
      break;
    stop(S.State, S.LaneMask, SigTrap, "",
         Lanes.threadOf(S.State, unsigned(std::countr_zero(Left))));
  }
  Lanes.showOwnPcs();
}

bool Session::stepsOverBreakpoint() const {
  return StepsOver && Stepping && Stepped == Current;
}

std::string Session::stopReply() const {
  return fmt::format("T{:02x}{}thread:{:x};core:{:x};", StopSignal, StopDetail,
                     Current, Lanes.coreOf(Current));
}

void Session::tellStop(unsigned Reason, const std::string &More) {
  StopSignal = Reason;
  StopDetail = More;
  Stepping = nullptr;
  UserLooks = false;
  if (Waiting)
    Peer.send(stopReply());
  Waiting = false;
}

void Session::serve(unsigned Reason, const std::string &More) {
  tellStop(Reason, More);
  while (!Waiting) {
    const std::optional<std::string> Packet = Peer.receive();
    if (!Packet || answer(*Packet))
      break;
    while (Waiting && !Calls.empty() && !Calls.back()->isRunning())
      runCall();
  }
  // Gone in the middle of a call: the guest goes on as if there had been
  // none.
  while (!Peer.isOpen() && !Calls.empty() && !Calls.back()->isRunning())
    endCall(true);
}

void Session::endCall(bool UndoWrites) {
  Calls.back()->end(UndoWrites);
  Calls.pop_back();
  ReturnTo.reset();
  Lanes.takeWrites();
  RestoresRegisters = true;
}

void Session::resume(ThreadId Step) {
  if (Lanes.warpOf(Step)) {
    Stepping = Lanes.warpOf(Step);
    Current = Stepped = Step;
    const uint32_t Pc = Lanes.readRegister(Step, PcNumber).value_or(0);
    StepsOver = Lifted.contains(Pc) && !Breakpoints.contains(Pc);
  }
  Lifted.clear();
  Waiting = true;
  if (beginsCall())
    beginCall();
  ReturnTo.reset();
  CallEntry.reset();
  Lanes.takeWrites();
}

bool Session::beginsCall() const {
  constexpr uint32_t MostArguments = 1 << 16;
  if (!ReturnTo || ReturnTo->first != Current)
    return false;
  for (const std::shared_ptr<Call> &C : Calls)
    if (C->returnsWith(Current, ReturnTo->second))
      return false;
  return ReturnTo->second - Lanes.readRegister(Current, SpNumber).value_or(0) <
         MostArguments;
}

/// The pc is the warp's, and moves with all of its lanes: only calls write it,
/// first to go to the function and at last to go back.
bool Session::movePc(uint32_t Pc) {
  if (!Calls.empty() && !beginsCall() && Calls.back()->endsWith(Current, Pc)) {
    endCall(false);
    return true;
  }
  if (!Calls.empty() && Calls.back()->returnsWith(Current, Pc)) {
    Calls.back()->goBack();
    return true;
  }
  if (CallEntry) { // it has changed its mind
    CallEntry.reset();
    Lanes.showOwnPcs();
  }
  if (Lanes.readRegister(Current, PcNumber) == Pc)
    return true;
  if (!beginsCall())
    return false;
  CallEntry = Pc;
  Lanes.showPc(Current, Pc);
  return true;
}

void Session::beginCall() {
  const uint32_t Entry =
      CallEntry.value_or(*Lanes.readRegister(Current, PcNumber));
  Calls.push_back(std::make_shared<Call>(Lanes, Current, Entry,
                                         ReturnTo->second, Lanes.takeWrites()));
}

void Session::runCall() {
  // It may be ended while it runs.
  const std::shared_ptr<Call> Running = Calls.back();
  CallBegins = true;
  const Call::Pause Why =
      Running->run([this] { return Lanes.device().mustStop(); });
  CallBegins = false;
  switch (Why) {
  case Call::Pause::Returned:
    return tellStop(SigTrap, "");
  case Call::Pause::Trapped:
    return tellStop(signalOf(Running->cause()), "");
  case Call::Pause::Stuck:
    return tellStop(SigSys, "");
  case Call::Pause::Ended:
    return; // the debugger has let the machine go on
  }
}

} // namespace vorion::isasim::gdb
