#include "observe/gdb/GdbServer.h"

#include "core/Core.h"
#include "core/HostFp.h"
#include "core/Rounding.h"
#include "observe/Tool.h"
#include "observe/gdb/Call.h"
#include "observe/gdb/Connection.h"
#include "observe/gdb/Target.h"
#include "vorion/isasim/Machine.h"

#include <bit>
#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <set>
#include <vector>

namespace vorion::isasim {

namespace {

using namespace gdb;

/// Signals as gdb numbers them (its include/gdb/signals.def).
enum Signal : unsigned {
  SigInt = 2,
  SigIll = 4,
  SigTrap = 5,
  SigSegv = 11,
  SigSys = 12 ///< a call needs the rest of the machine, which stands still
};

/// Instructions between two looks at whether the debugger wants a stop.
constexpr unsigned PollEvery = 4096;

/// A hexadecimal number at the front of \p Text, which is taken off with the
/// separator behind it.
uint32_t takeHex(std::string_view &Text) {
  uint32_t Value = 0;
  const auto R =
      std::from_chars(Text.data(), Text.data() + Text.size(), Value, 16);
  Text.remove_prefix(static_cast<size_t>(R.ptr - Text.data()));
  if (!Text.empty())
    Text.remove_prefix(1);
  return Value;
}

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

class GdbServer final : public Observer {
public:
  GdbServer() = default;
  /// For a debugger that is connected already.
  explicit GdbServer(int Socket) : WasConnected(true), StopNext(true) {
    Peer.adopt(Socket);
  }
  ~GdbServer() override {
    if (Peer.isOpen())
      Peer.send(fmt::format("W{:02x}", ExitStatus & 0xFF));
  }
  Expected<unsigned> listen(unsigned Port) { return Peer.listen(Port); }

  void runBegins(const RunStart &R) override {
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

  void fetch(const Step &S) override {
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

  void commit(const Commit &C) override {
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

  void trap(const Trap &T) override {
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

  void runEnds(const RunResult &R) override {
    // Those that wait for a machine that is gone must not ask it.
    Peer.stopWaitingWhen([] { return false; });
    ExitStatus = R.End == Outcome::Done          ? 0
                 : R.End == Outcome::GuestFailed ? 1
                 : R.End == Outcome::Trap        ? 4
                                                 : 5;
  }

private:
  struct Watchpoint {
    uint32_t Address, Bytes;
    bool Reads, Writes;
    bool operator==(const Watchpoint &) const = default;
  };

  /// Whether a step is not done yet, since its lane does not run on: it waits
  /// for the other side of a branch, or for lanes that stay in a loop.
  bool isSteppedLaneOff(uint32_t Active) const {
    return Stepped && !StepsOver && !(Active >> Lanes.laneOf(Stepped) & 1);
  }

  /// \p S is running.
  void stop(WarpState &S, uint32_t Mask, unsigned Reason,
            const std::string &More, ThreadId Cause = 0) {
    // Stay with the thread that the user looks at, if it is of this warp and
    // no other is the cause.
    const bool IsOver = StepsOver && Stepping == &S && Current == Stepped;
    if (Cause)
      Current = Cause;
    else if (!IsOver &&
             (!Lanes.isActive(Current) || Lanes.warpOf(Current) != &S))
      Current =
          Lanes.threadOf(S, static_cast<unsigned>(std::countr_zero(Mask)));
    // Flags and rounding mode are the host's unit's as long as it runs.
    S.Fflags |= HostFp::takeFlags();
    serve(Reason, More);
    setFrm(&S, S.Frm);
  }

  /// gdb has looked at a breakpoint at \p S for one lane, and goes on without
  /// the user's having seen it, as where a condition does not hold or a
  /// breakpoint is another thread's: the other active lanes stop there, too,
  /// one after the other. Meanwhile those it was done with are behind it in
  /// gdb's eyes, though the warp runs only when it has been offered to all.
  void offerToOthers(const Step &S) {
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

  /// Whether the debugger has just let one lane go over the breakpoint that it
  /// stands at.
  bool stepsOverBreakpoint() const {
    return StepsOver && Stepping && Stepped == Current;
  }

  std::string stopReply() const {
    return fmt::format("T{:02x}{}thread:{:x};core:{:x};", StopSignal,
                       StopDetail, Current, Lanes.coreOf(Current));
  }

  void tellStop(unsigned Reason, const std::string &More) {
    StopSignal = Reason;
    StopDetail = More;
    Stepping = nullptr;
    UserLooks = false;
    if (Waiting)
      Peer.send(stopReply());
    Waiting = false;
  }

  /// Answers the debugger until it lets the machine go on. Calls that it makes
  /// run in here, and stops within them come back to here.
  void serve(unsigned Reason, const std::string &More) {
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

  bool movePc(uint32_t Pc);
  void beginCall();
  void runCall();
  void endCall(bool UndoWrites) {
    Calls.back()->end(UndoWrites);
    Calls.pop_back();
    ReturnTo.reset();
    Lanes.takeWrites();
    RestoresRegisters = true;
  }

  void resume(ThreadId Step) {
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

  /// Whether the debugger has made the current lane return to its stack, which
  /// is how it calls functions: its breakpoint lies there. Where a call that
  /// has ended was made within another one, that one's address is put back.
  bool beginsCall() const {
    constexpr uint32_t MostArguments = 1 << 16;
    if (!ReturnTo || ReturnTo->first != Current)
      return false;
    for (const std::shared_ptr<Call> &C : Calls)
      if (C->returnsWith(Current, ReturnTo->second))
        return false;
    return ReturnTo->second -
               Lanes.readRegister(Current, SpNumber).value_or(0) <
           MostArguments;
  }

  /// Whether the debugger has gone.
  bool answer(std::string_view Packet);
  void answerMemory(std::string_view Packet);
  void answerRegister(std::string_view Packet);
  void answerPoint(std::string_view Packet);
  void answerQuery(std::string_view Packet);
  void answerTransfer(std::string_view Packet);
  void answerContinue(std::string_view Packet);
  std::string threadList() const;
  std::string programPath() const;

  void reply(bool Done) { Peer.send(Done ? "OK" : "E01"); }

  Connection Peer;
  Target Lanes;
  std::vector<std::shared_ptr<Call>> Calls; ///< each made while the last stood
  bool CallBegins = false; ///< its first instruction is not a step's end
  /// What the debugger has put into a thread's ra since the machine last ran.
  std::optional<std::pair<ThreadId, uint32_t>> ReturnTo;
  std::optional<uint32_t> CallEntry; ///< what it has put into the pc then
  /// A call has ended, and registers after the pc are still being put back.
  bool RestoresRegisters = false;
  bool WasConnected = false, StopNext = false;
  bool Waiting = false; ///< gdb waits for the machine to stop
  /// gdb shows the last stop: only then it asks which threads there are.
  bool UserLooks = false;
  const WarpState *Stepping = nullptr;
  ThreadId Stepped = 0; ///< whose step it is; 0: any lane's of the warp
  /// The step is over a breakpoint that is lifted for it: it ends behind one
  /// instruction, so that the breakpoint is back for the lanes that run.
  bool StepsOver = false;
  ThreadId Current = 1; ///< of the last stop, or the one that gdb chose
  unsigned StopSignal = SigTrap;
  std::string StopDetail, WatchReason;
  ThreadId WatchThread = 0;             ///< which has touched what is watched
  std::shared_ptr<const Image> Program; ///< that runs
  bool KnowsPrograms = false; ///< gdb wants to be told of other programs
  bool EntersProgram = false; ///< it has not been told of this one
  std::set<uint32_t> Breakpoints;
  std::set<uint32_t> Lifted; ///< breakpoints, since the machine stopped
  std::vector<Watchpoint> Watched;
  unsigned Fetches = 0, ExitStatus = 0;
};

void GdbServer::answerMemory(std::string_view Packet) {
  const bool Writes = Packet[0] == 'M';
  Packet.remove_prefix(1);
  const uint32_t Address = takeHex(Packet), Bytes = takeHex(Packet);
  if (Writes)
    return reply(Lanes.writeMemory(Current, Address, fromHex(Packet)));
  constexpr uint32_t MostBytes = 4096;
  const std::string Read =
      Lanes.readMemory(Current, Address, std::min(Bytes, MostBytes));
  Peer.send(Read.empty() && Bytes ? "E14" : toHex(Read));
}

void GdbServer::answerRegister(std::string_view Packet) {
  const bool Writes = Packet[0] == 'P';
  Packet.remove_prefix(1);
  const uint32_t Number = takeHex(Packet);
  if (!Writes) {
    const auto Value = Lanes.readRegister(Current, Number);
    return Peer.send(Value ? toHex({reinterpret_cast<const char *>(&*Value), 4})
                           : "E01");
  }
  const std::string Bytes = fromHex(Packet);
  uint32_t Value = 0;
  if (Bytes.size() == sizeof(Value))
    std::memcpy(&Value, Bytes.data(), sizeof(Value));
  if (Bytes.size() != sizeof(Value))
    return reply(false);
  if (Number == PcNumber)
    return reply(movePc(Value));
  if (Number == RaNumber)
    ReturnTo = {Current, Value};
  reply(Lanes.writeRegister(Current, Number, Value));
  if (RestoresRegisters)
    Lanes.takeWrites();
}

/// The pc is the warp's, and moves with all of its lanes: only calls write it,
/// first to go to the function and at last to go back.
bool GdbServer::movePc(uint32_t Pc) {
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

void GdbServer::beginCall() {
  const uint32_t Entry =
      CallEntry.value_or(*Lanes.readRegister(Current, PcNumber));
  Calls.push_back(std::make_shared<Call>(Lanes, Current, Entry,
                                         ReturnTo->second, Lanes.takeWrites()));
}

void GdbServer::runCall() {
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

void GdbServer::answerPoint(std::string_view Packet) {
  const bool Sets = Packet[0] == 'Z';
  const char Kind = Packet.size() > 1 ? Packet[1] : ' ';
  Packet.remove_prefix(std::min<size_t>(3, Packet.size()));
  const uint32_t Address = takeHex(Packet), Bytes = takeHex(Packet);
  if (Kind == '0' || Kind == '1') {
    if (Sets)
      Breakpoints.insert(Address);
    else if (Breakpoints.erase(Address) != 0)
      Lifted.insert(Address);
    return reply(true);
  }
  if (Kind < '2' || Kind > '4')
    return Peer.send("");
  const Watchpoint W{Address, Bytes, Kind != '2', Kind != '3'};
  if (Sets)
    Watched.push_back(W);
  else
    std::erase(Watched, W);
  reply(true);
}

std::string GdbServer::threadList() const {
  std::string Text = "<?xml version=\"1.0\"?><threads>";
  for (ThreadId T = 1; T <= Lanes.numThreads(); ++T)
    if (Lanes.isAlive(T) || T == Current)
      Text += fmt::format("<thread id=\"{:x}\" core=\"{}\">{}</thread>", T,
                          Lanes.coreOf(T), Lanes.describe(T));
  return Text + "</threads>";
}

std::string GdbServer::programPath() const {
  char *Path = realpath(Program->name().c_str(), nullptr);
  std::string Text = Path ? Path : "";
  std::free(Path);
  return Text;
}

/// "qXfer:OBJECT:read:ANNEX:OFFSET,LENGTH".
void GdbServer::answerTransfer(std::string_view Packet) {
  std::string Document;
  if (Packet.starts_with("qXfer:features:read:target.xml:"))
    Document = Target::description();
  else if (Packet.starts_with("qXfer:threads:read::")) {
    Document = threadList();
    UserLooks = true;
    Lanes.showOwnPcs();
  } else if (Packet.starts_with("qXfer:exec-file:read:"))
    Document = programPath();
  else
    return Peer.send("");
  Packet.remove_prefix(Packet.rfind(':') + 1);
  const size_t Offset = takeHex(Packet), Length = takeHex(Packet);
  if (Offset >= Document.size())
    return Peer.send("l");
  const std::string Part = Document.substr(Offset, Length);
  Peer.send((Offset + Part.size() == Document.size() ? "l" : "m") + Part);
}

void GdbServer::answerQuery(std::string_view Packet) {
  if (Packet.starts_with("qSupported")) {
    KnowsPrograms = Packet.find("exec-events+") != std::string_view::npos;
    return Peer.send("PacketSize=4000;QStartNoAckMode+;vContSupported+;"
                     "exec-events+;qXfer:features:read+;"
                     "qXfer:threads:read+;qXfer:exec-file:read+");
  }
  if (Packet.starts_with("qXfer:"))
    return answerTransfer(Packet);
  if (Packet == "QStartNoAckMode") {
    reply(true);
    return Peer.stopAcknowledging();
  }
  if (Packet == "qC")
    return Peer.send(fmt::format("QC{:x}", Current));
  // An existing process: gdb lets it run on when it leaves.
  if (Packet.starts_with("qAttached"))
    return Peer.send("1");
  Peer.send("");
}

/// "vCont;ACTION[:THREAD]...": the first step decides, else all go on.
void GdbServer::answerContinue(std::string_view Packet) {
  if (Packet == "vCont?")
    return Peer.send("vCont;c;C;s;S");
  ThreadId Step = 0;
  while (!Packet.empty()) {
    const size_t End = std::min(Packet.size(), Packet.find(';', 1));
    std::string_view Action = Packet.substr(0, End);
    Packet.remove_prefix(End);
    if (!Action.starts_with(";s") && !Action.starts_with(";S"))
      continue;
    const size_t Colon = Action.find(':');
    Action.remove_prefix(std::min(Action.size(), Colon));
    Action.remove_prefix(Action.empty() ? 0 : 1);
    if (!Step)
      Step = Action.empty() ? Current : takeHex(Action);
  }
  resume(Step);
}

bool GdbServer::answer(std::string_view Packet) {
  RestoresRegisters &= Packet.starts_with('P');
  switch (Packet.empty() ? '\0' : Packet[0]) {
  case '?':
    Peer.send(stopReply());
    break;
  case 'g':
    Peer.send(toHex(Lanes.registers(Current)));
    break;
  case 'p':
  case 'P':
    answerRegister(Packet);
    break;
  case 'm':
  case 'M':
    answerMemory(Packet);
    break;
  case 'Z':
  case 'z':
    answerPoint(Packet);
    break;
  case 'q':
  case 'Q':
    answerQuery(Packet);
    break;
  case 'H': {
    std::string_view Number = Packet.substr(std::min<size_t>(2, Packet.size()));
    const ThreadId T = Number.starts_with('-') ? 0 : takeHex(Number);
    if (T && !Lanes.warpOf(T)) {
      reply(false);
      break;
    }
    if (T && Packet[1] == 'g')
      Current = T;
    reply(true);
    break;
  }
  case 'T': {
    std::string_view Number = Packet.substr(1);
    reply(Lanes.isAlive(takeHex(Number)));
    break;
  }
  case 'c':
    resume(0);
    break;
  case 's':
    resume(Current);
    break;
  case 'v':
    if (Packet.starts_with("vCont"))
      answerContinue(Packet.size() > 5 && Packet[5] == '?' ? Packet
                                                           : Packet.substr(5));
    else
      Peer.send("");
    break;
  case 'D':
    reply(true);
    Peer.close();
    return true;
  case 'k':
    Lanes.device().requestStop();
    Peer.close();
    return true;
  default:
    Peer.send("");
  }
  return false;
}

} // namespace

std::unique_ptr<Observer> serveGdb(int Socket) {
  return std::make_unique<GdbServer>(Socket);
}

Expected<std::unique_ptr<Observer>>
startGdbServer(unsigned Port,
               const std::function<void(std::string_view)> &Say) {
  auto Server = std::make_unique<GdbServer>();
  const Expected<unsigned> Got = Server->listen(Port);
  if (!Got)
    return Got.error();
  Say(fmt::format("gdb: waiting on port {0}; connect with: gdb-multiarch "
                  "PROGRAM -ex 'target remote 127.0.0.1:{0}'",
                  *Got));
  return std::unique_ptr<Observer>(std::move(Server));
}

namespace {

class GdbTool : public Tool {
public:
  explicit GdbTool(std::unique_ptr<Observer> ServerIn)
      : Server(std::move(ServerIn)) {}
  std::vector<Observer *> observers() override { return {Server.get()}; }
  bool changesRuns() const override { return true; }

private:
  std::unique_ptr<Observer> Server;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &To) {
  unsigned Port = 0;
  const char *End = Text.data() + Text.size();
  const auto Read = std::from_chars(Text.data(), End, Port);
  if (Read.ec != std::errc() || Read.ptr != End || Port > 65535)
    return Error{"", fmt::format("gdb port '{}', expected 0 to 65535", Text),
                 ExitCode::Usage};
  auto Server = startGdbServer(Port, To.Report);
  if (!Server)
    return Server.error();
  return std::unique_ptr<Tool>(std::make_unique<GdbTool>(std::move(*Server)));
}

} // namespace

const ToolKind tools::Gdb{.Make = make};

} // namespace vorion::isasim
